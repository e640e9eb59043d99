// Colours: ISO 8613-6, 38;2;r;g;b for the character and 48;2;r;g;b for what is behind it, as xterm reads
// them.

#include "apps/live/terminal/half_blocks.h"

#include <fmt/format.h>

#include <iterator>
#include <optional>

namespace kaustik::app {

namespace {

constexpr std::string_view kUpperHalf = "\u2580", kUsualColours = "\x1b[0m";

// Sets one of the two colours of the following characters, unless it is set already.
void set_colour(int which, const Pixels8::Colour& c, std::optional<Pixels8::Colour>* set,
                std::string* bytes) {
  if (*set == c) return;
  fmt::format_to(std::back_inserter(*bytes), "\x1b[{};2;{};{};{}m", which, c[0], c[1], c[2]);
  *set = c;
}

}  // namespace

std::vector<std::string> half_block_lines(const Pixels8& pixels) {
  std::vector<std::string> lines;
  for (int y = 0; y < pixels.height; y += 2) {
    std::string& line = lines.emplace_back();
    std::optional<Pixels8::Colour> upper, lower;
    for (int x = 0; x < pixels.width; ++x) {
      set_colour(38, pixels.at(x, y), &upper, &line);
      if (y + 1 < pixels.height) set_colour(48, pixels.at(x, y + 1), &lower, &line);
      line += kUpperHalf;
    }
    line += kUsualColours;
  }
  return lines;
}

std::string draw_lines(const std::vector<std::string>& lines, const std::vector<std::string>& shown) {
  std::string bytes;
  size_t at = 0;  // the line of the cursor
  for (size_t i = 0; i < lines.size(); ++i) {
    if (i < shown.size() && shown[i] == lines[i]) continue;
    if (i > at) fmt::format_to(std::back_inserter(bytes), "\r\x1b[{}B", i - at);
    bytes += lines[i];
    at = i;
  }
  return bytes;
}

}  // namespace kaustik::app
