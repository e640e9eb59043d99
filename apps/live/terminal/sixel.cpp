// The format: DEC STD 070, chapter 9, or https://vt100.net/docs/vt3xx-gp/chapter14.html.

#include "apps/live/terminal/sixel.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace kaustik::app {

namespace {

constexpr std::array<int, 3> kLevels = {6, 7, 6};
constexpr int kColours = kLevels[0] * kLevels[1] * kLevels[2];

// Ordered dithering of 8 x 8 pixels (Bayer 1973): a threshold between 0 and 1, each multiple of 1/64 once,
// moved by 1/128. The bits of x ^ y and y are interleaved from the lowest up.
float threshold(int x, int y) {
  unsigned rank = 0;
  for (int bit = 0; bit < 3; ++bit)
    rank = rank << 2 | (unsigned(x ^ y) >> bit & 1u) << 1 | (unsigned(y) >> bit & 1u);
  return (float(rank) + 0.5f) / 64;
}

int palette_index(const Pixels8::Colour& colour, float threshold) {
  int index = 0;
  for (size_t c = 0; c < 3; ++c)
    index = index * kLevels[c] + int(float(colour[c]) / 255 * float(kLevels[c] - 1) + threshold);
  return index;
}

void append_palette(const std::array<bool, kColours>& used, std::string* bytes) {
  for (int i = 0; i < kColours; ++i) {
    if (!used[size_t(i)]) continue;
    const auto percent = [](int level, int levels) { return (200 * level / (levels - 1) + 1) / 2; };
    fmt::format_to(std::back_inserter(*bytes), "#{};2;{};{};{}", i,
                   percent(i / (kLevels[1] * kLevels[2]), kLevels[0]),
                   percent(i / kLevels[2] % kLevels[1], kLevels[1]), percent(i % kLevels[2], kLevels[2]));
  }
}

// Which of the six pixels of each column have a colour: bit 0 is the uppermost.
using Columns = std::vector<uint8_t>;

void append_run(char sixel, size_t count, std::string* bytes) {
  if (count > 3)
    fmt::format_to(std::back_inserter(*bytes), "!{}{}", count, sixel);
  else
    bytes->append(count, sixel);
}

void append_columns(const Columns& columns, std::string* bytes) {
  size_t end = columns.size();
  while (end > 0 && columns[end - 1] == 0) --end;
  for (size_t x = 0; x < end;) {
    size_t next = x + 1;
    while (next < end && columns[next] == columns[x]) ++next;
    append_run(char(columns[x] + '?'), next - x, bytes);
    x = next;
  }
}

// `indices`: of the palette, one for each pixel of the picture.
void append_band(const std::vector<uint8_t>& indices, int width, int y0, int y1, std::string* bytes) {
  std::vector<Columns> of_colour(kColours);
  for (int y = y0; y < y1; ++y)
    for (int x = 0; x < width; ++x) {
      Columns& columns = of_colour[indices[size_t(y) * size_t(width) + size_t(x)]];
      columns.resize(size_t(width));
      columns[size_t(x)] |= uint8_t(1 << (y - y0));
    }
  bool first = true;
  for (int i = 0; i < kColours; ++i) {
    if (of_colour[size_t(i)].empty()) continue;
    fmt::format_to(std::back_inserter(*bytes), "{}#{}", first ? "" : "$", i);
    append_columns(of_colour[size_t(i)], bytes);
    first = false;
  }
}

}  // namespace

std::string sixel_picture(const Pixels8& pixels) {
  std::vector<uint8_t> indices;
  indices.reserve(pixels.colours.size());
  std::array<bool, kColours> used{};
  for (int y = 0; y < pixels.height; ++y)
    for (int x = 0; x < pixels.width; ++x) {
      indices.push_back(uint8_t(palette_index(pixels.at(x, y), threshold(x % 8, y % 8))));
      used[indices.back()] = true;
    }
  // 1: pixels that are not drawn keep what they show. Then the shape of pixels, 1:1, and the size.
  std::string bytes = fmt::format("\x1bP0;1q\"1;1;{};{}", pixels.width, pixels.height);
  append_palette(used, &bytes);
  for (int y = 0; y < pixels.height; y += kSixelRows) {
    if (y > 0) bytes += '-';
    append_band(indices, pixels.width, y, std::min(y + kSixelRows, pixels.height), &bytes);
  }
  return bytes + "\x1b\\";
}

}  // namespace kaustik::app
