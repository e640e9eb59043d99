#include "apps/import/view/camera_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/diagnostics/nearest_name.h"

namespace kaustik {
namespace {

std::string listed(const std::vector<std::string>& names) {
  if (names.empty()) return "the file has no camera";
  constexpr size_t kMostListed = 20;
  std::string text = names.size() == 1 ? "the file has camera" : "the file has the cameras";
  for (size_t i = 0; i < std::min(names.size(), kMostListed); ++i)
    text += fmt::format("{} {}{}", i == 0 ? "" : ",", i + 1,
                        names[i].empty() ? std::string() : fmt::format(" `{}`", names[i]));
  return text + (names.size() > kMostListed ? " and more" : "");
}

}  // namespace

std::optional<size_t> find_camera(const std::vector<std::string>& names, const std::string& asked,
                                  std::string& error) {
  const auto found = std::find(names.begin(), names.end(), asked);
  if (found != names.end()) return static_cast<size_t>(found - names.begin());
  size_t number = 0;
  const char* const end = asked.data() + asked.size();
  const auto [stop, code] = std::from_chars(asked.data(), end, number);
  if (code == std::errc() && stop == end && number >= 1 && number <= names.size()) return number - 1;
  std::vector<std::string_view> named(names.begin(), names.end());
  std::erase(named, "");
  const auto nearest = nearest_name(asked, named);
  error = fmt::format("--camera {}: there is no such camera{}; {}", asked,
                      nearest ? fmt::format("; did you mean `{}`?", *nearest) : "", listed(names));
  return std::nullopt;
}

}  // namespace kaustik
