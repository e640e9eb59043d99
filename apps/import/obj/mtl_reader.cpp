#include "apps/import/obj/mtl_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/import/common/find_file.h"
#include "apps/import/common/scene_files.h"
#include "apps/import/obj/obj_text.h"
#include "core/text.h"

namespace kaustik::obj {
namespace {

constexpr std::string_view kColours[] = {"ka", "kd", "ks", "ke", "tf"};
constexpr std::string_view kNumbers[] = {"ns", "ni", "d", "tr", "illum", "pr", "pm"};
// Keywords of maps, and those under which they are kept.
constexpr std::pair<std::string_view, std::string_view> kMaps[] = {
    {"map_kd", "map_kd"},     {"map_ke", "map_ke"}, {"map_emissive", "map_ke"}, {"map_d", "map_d"},
    {"map_opacity", "map_d"}, {"map_bump", "bump"}, {"bump", "bump"},           {"norm", "norm"},
    {"map_kn", "norm"},       {"map_pr", "map_pr"}, {"map_pm", "map_pm"}};
// Known keywords that have no effect here: dropped without a warning.
constexpr std::string_view kSilent[] = {"map_ka", "sharpness", "map_aat"};

bool is_one_of(std::string_view word, std::span<const std::string_view> names) {
  return std::find(names.begin(), names.end(), word) != names.end();
}

const auto* map_of(std::string_view keyword) {
  const auto* const map =
      std::find_if(std::begin(kMaps), std::end(kMaps), [&](const auto& m) { return m.first == keyword; });
  return map == std::end(kMaps) ? nullptr : map;
}

bool is_known(std::string_view keyword) {
  return keyword == "newmtl" || map_of(keyword) || is_one_of(keyword, kColours) ||
         is_one_of(keyword, kNumbers) || is_one_of(keyword, kSilent);
}

// Removes the next line from the front of `text`.
std::string_view next_line(std::string_view& text) {
  const size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == text.npos ? text.size() : end + 1);
  return line;
}

class MtlReader {
 public:
  MtlReader(uint32_t file, std::span<const std::filesystem::path> folders, CountedWarnings& warnings,
            Diagnostics& diagnostics)
      : folders_(folders), warnings_(warnings), diagnostics_(diagnostics), where_{file, 0, 0} {}

  void read_line(std::string_view line) {
    ++where_.line;
    line_ = line;
    Words words(line);
    const std::string_view keyword = words.next();
    if (keyword.empty()) return;
    where_.column = uint32_t(words.column());
    const std::string key = lower_case(keyword);
    if (key == "newmtl") {
      materials_.push_back({std::string(words.rest()), where_, {}, {}, {}});
      return;
    }
    if (materials_.empty()) materials_.push_back({"", where_, {}, {}, {}});
    if (const auto* const map = map_of(key)) return add_map(std::string(map->second), words);
    if (is_one_of(key, kColours) || is_one_of(key, kNumbers)) return add_values(keyword, key, words);
    if (!is_one_of(key, kSilent)) ignore(keyword);
  }

  std::vector<MtlMaterial> take() { return std::move(materials_); }

 private:
  void ignore(std::string_view what) {
    warnings_.say(where_, fmt::format("the material keyword `{}` is ignored", what.substr(0, 80)));
  }

  // A colour given by one number is grey.
  void add_values(std::string_view keyword, const std::string& key, Words& words) {
    glm::dvec3 values(0);
    int count = 0;
    for (std::string_view word = words.next(); !word.empty() && count < 3; word = words.next()) {
      if (word == "-halo") continue;
      const auto value = number_of(word);
      if (!value && count == 0) return ignore(fmt::format("{} {}", keyword, word.substr(0, 40)));
      if (!value || !std::isfinite(*value)) break;
      values[count++] = *value;
    }
    if (count == 0) return;
    if (is_one_of(key, kNumbers))
      materials_.back().numbers[key] = values.x;
    else
      materials_.back().colours[key] = glm::max(count < 3 ? glm::dvec3(values.x) : values, 0.0);
  }

  // Options take one word each; -s, -o and -t take up to three numbers, -mm takes two. Some programs write
  // them after the name.
  void add_map(const std::string& key, Words& words) {
    MtlMap map;
    std::string_view rest = words.rest();
    while (rest.size() > 1 && rest[0] == '-') {
      Words ahead(rest);
      const std::string_view option = ahead.next();
      read_option(option, ahead, map);
      rest = ahead.rest();
    }
    map.where = where_;
    if (!rest.empty()) map.where.column = uint32_t(rest.data() - line_.data()) + 1;
    map.file = find(rest);
    if (const size_t options = rest.find(" -"); !map.file && options != rest.npos)
      map.file = find(trimmed(rest.substr(0, options)));
    if (map.file && map.file->refused())
      refuse(map);
    else if (!map.file && !rest.empty())
      warnings_.say_one_of("missing image", map.where,
                           fmt::format("there is no file \"{}\": this map is left out", rest.substr(0, 200)));
    if (!rest.empty()) materials_.back().maps.insert_or_assign(key, std::move(map));
  }

  std::optional<ReadableFile> find(std::string_view name) const {
    return find_file(diagnostics_.files.root(), std::string(name), folders_);
  }

  // Reports a file that may not be read, which is then one that is missing.
  void refuse(MtlMap& map) {
    std::string error;
    pbrt::read_bytes(*map.file, 0, error);
    diagnostics_.error(map.where, error);
    map.file.reset();
  }

  static void read_option(std::string_view option, Words& words, MtlMap& map) {
    const bool vector = option == "-s" || option == "-o" || option == "-t";
    for (size_t i = 0; i < (vector ? 3u : option == "-mm" ? 2u : 1u); ++i) {
      Words ahead = words;
      const std::string_view word = ahead.next();
      const auto value = number_of(word);
      if (vector && !value) break;
      if (vector && i < 2 && option != "-t") (option == "-s" ? map.scale : map.offset)[i] = *value;
      if (option == "-clamp") map.clamp = lower_case(word) == "on";
      words = ahead;
    }
  }

  std::span<const std::filesystem::path> folders_;
  CountedWarnings& warnings_;
  Diagnostics& diagnostics_;
  std::string_view line_;
  SourceLocation where_;
  std::vector<MtlMaterial> materials_;
};

template <class Map>
const typename Map::mapped_type* value_in(const Map& map, std::string_view keyword) {
  const auto found = map.find(keyword);
  return found == map.end() ? nullptr : &found->second;
}

}  // namespace

std::optional<glm::dvec3> MtlMaterial::colour(std::string_view keyword) const {
  const glm::dvec3* const found = value_in(colours, keyword);
  return found ? std::optional(*found) : std::nullopt;
}

std::optional<double> MtlMaterial::number(std::string_view keyword) const {
  const double* const found = value_in(numbers, keyword);
  return found ? std::optional(*found) : std::nullopt;
}

const MtlMap* MtlMaterial::map(std::string_view keyword) const {
  return value_in(maps, keyword);
}

bool is_mtl(std::string_view text) {
  while (!text.empty()) {
    Words words(next_line(text));
    if (const std::string_view keyword = words.next(); !keyword.empty()) return is_known(lower_case(keyword));
  }
  return true;
}

std::vector<MtlMaterial> read_mtl(uint32_t file, std::span<const std::filesystem::path> folders,
                                  CountedWarnings& warnings, Diagnostics& diagnostics) {
  MtlReader reader(file, folders, warnings, diagnostics);
  std::string_view text = diagnostics.files.text(file);
  while (!text.empty()) reader.read_line(next_line(text));
  return reader.take();
}

}  // namespace kaustik::obj
