#include "apps/sequence/frame_names.h"

#include <fmt/format.h>

#include <regex>
#include <stdexcept>

namespace kaustik::app {

std::string frame_name(const std::string& pattern, uint64_t frame) {
  static const std::regex kNumber("%(0([1-9]))?d");
  const std::sregex_iterator found(pattern.begin(), pattern.end(), kNumber), none;
  if (found == none || std::next(found) != none)
    throw std::invalid_argument(
        fmt::format("`{}`: expected one %d or %04d in place of the frame's number", pattern));
  const std::smatch& match = *found;
  const int digits = match[2].matched ? std::stoi(match[2]) : 1;
  return fmt::format("{}{:0{}}{}", match.prefix().str(), frame, digits, match.suffix().str());
}

}  // namespace kaustik::app
