#pragma once
// A picture as a screen shows it.

#include <array>
#include <cstdint>
#include <vector>

namespace kaustik::app {

// 8-bit sRGB, row 0 on top.
struct Pixels8 {
  using Colour = std::array<uint8_t, 3>;

  int width = 0, height = 0;
  std::vector<Colour> colours;

  Pixels8() = default;
  Pixels8(int w, int h) : width(w), height(h), colours(size_t(w) * size_t(h)) {}
  Colour& at(int x, int y) { return colours[size_t(y) * size_t(width) + size_t(x)]; }
  const Colour& at(int x, int y) const { return colours[size_t(y) * size_t(width) + size_t(x)]; }
};

}  // namespace kaustik::app
