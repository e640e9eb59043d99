#include "apps/import/obj/mtl_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>
#include <vector>

namespace kaustik {
namespace {

constexpr std::string_view kColours[] = {"ka", "kd", "ks", "ke"};
constexpr std::string_view kNumbers[] = {"ns", "ni", "d", "tr", "illum", "pr", "pm"};
constexpr std::string_view kMaps[] = {"map_kd", "map_ke", "map_d", "map_bump", "bump", "norm"};
// Known keywords that have no effect here: dropped without a warning.
constexpr std::string_view kSilent[] = {"tf", "map_ka", "sharpness", "map_aat"};

template <class Names>
bool contains(const Names& names, std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::optional<double> number(const std::string& word) {
  double value = 0;
  const char* const end = word.data() + word.size();
  const char* const begin = word.data() + (word.starts_with('+') ? 1 : 0);
  const auto [at, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || at != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

class Cleaner {
 public:
  Cleaner(const std::filesystem::path& folder, FileWarnings& warnings, MapOptionsOf& options)
      : folder_(folder), warnings_(warnings), options_(options) {}

  // One line rewritten; empty for blank lines, comments and dropped keywords.
  std::string line(const std::string& text) {
    std::istringstream words(text);
    std::string keyword;
    if (!(words >> keyword) || keyword.starts_with('#')) return "";
    std::string rest;
    std::getline(words >> std::ws, rest);
    rest.erase(rest.find_last_not_of(" \t\r") + 1);
    const std::string key = lower(keyword);
    if (key == "newmtl") {
      material_ = rest;
      return "newmtl " + rest;
    }
    if (contains(kMaps, key)) return map(key, rest);
    if (contains(kColours, key) || contains(kNumbers, key)) return values(keyword, key, rest);
    if (!contains(kSilent, key)) say_left_out(keyword);
    return "";
  }

 private:
  void say_left_out(const std::string& keyword) {
    warnings_.say(fmt::format("the material keyword `{}` is ignored", keyword.substr(0, 40)));
  }

  // Rewrites a colour or number. A colour given by one number is grey.
  std::string values(const std::string& keyword, const std::string& key, const std::string& rest) {
    std::istringstream words(rest);
    std::vector<double> found;
    for (std::string word; words >> word;) {
      if (word == "-halo") continue;
      const auto value = number(word);
      if (!value) {
        if (found.empty()) say_left_out(fmt::format("{} {}", keyword, word.substr(0, 40)));
        break;
      }
      found.push_back(*value);
    }
    const bool colour = contains(kColours, key);
    if (colour && found.size() == 1) found.resize(3, found[0]);
    if (found.size() < (colour ? 3 : 1)) return "";
    found.resize(colour ? 3 : 1);
    return fmt::format("{} {}", keyword, fmt::join(found, " "));
  }

  // Rewrites a map. Its options take one word each; -s, -o and -t take up to three numbers, -mm takes two.
  std::string map(const std::string& key, const std::string& rest) {
    MapOptions found;
    size_t at = 0;
    const auto next = [&] {
      const size_t begin = std::min(rest.find_first_not_of(" \t", at), rest.size());
      const size_t end = std::min(rest.find_first_of(" \t", begin), rest.size());
      return std::pair{rest.substr(begin, end - begin), end};
    };
    for (auto [word, end] = next(); word.size() > 1 && word[0] == '-'; std::tie(word, end) = next()) {
      at = end;
      const bool three = word == "-s" || word == "-o" || word == "-t";
      for (size_t i = 0; i < (three ? 3 : word == "-mm" ? 2 : 1); ++i) {
        const auto [value, after] = next();
        const auto v = number(value);
        if (three && !v) break;
        if (three && i < 2) (word == "-s" ? found.scale : word == "-o" ? found.offset : unused_)[i] = *v;
        if (word == "-clamp") found.clamp = value == "on";
        at = after;
      }
    }
    const size_t begin = rest.find_first_not_of(" \t", at);
    const auto file = begin == rest.npos ? std::nullopt : file_of(rest.substr(begin));
    if (!file) return "";
    options_[{material_, key}] = found;
    return fmt::format("{} {}", key == "bump" ? "map_bump" : key, *file);
  }

  std::optional<std::string> file_of(std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    std::error_code ignored;
    if (std::filesystem::is_regular_file(folder_ / name, ignored)) return name;
    const std::string last = name.substr(name.find_last_of('/') + 1);
    if (std::filesystem::is_regular_file(folder_ / last, ignored)) return last;
    // Some programs write the options after the name.
    if (const size_t options = name.find(" -"); options != name.npos) return file_of(name.substr(0, options));
    warnings_.say(fmt::format("there is no file \"{}\": this map is left out", name));
    return std::nullopt;
  }

  const std::filesystem::path& folder_;
  FileWarnings& warnings_;
  MapOptionsOf& options_;
  std::string material_;
  std::array<double, 2> unused_{};
};

}  // namespace

std::string clean_mtl(std::string_view text, const std::filesystem::path& folder, FileWarnings& warnings,
                      MapOptionsOf& options) {
  Cleaner cleaner(folder, warnings, options);
  std::istringstream lines{std::string(text)};
  std::string out;
  for (std::string line; std::getline(lines, line);) {
    std::string clean = cleaner.line(line);
    if (!clean.empty()) out += clean + "\n";
  }
  return out;
}

}  // namespace kaustik
