#pragma once
// A picture in memory: linear Rec. 709, row 0 at the top.

#include <optional>
#include <vector>

#include "core/math/vec.h"
#include "render/picture/part_of.h"
#include "render/picture/tonemap.h"

namespace kaustik::render {

struct Image {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;
  std::optional<PartOf> part{};        // of a larger picture; nothing: the picture is whole
  bool for_display = false;            // read from a file of integers, which hold what a screen shows
  std::optional<ToneSettings> tone{};  // for_display: what turned radiance into it, if the file says so

  Image() = default;
  Image(int w, int h, const Rgb& value = Rgb(0))
      : width(w), height(h), pixels(size_t(w) * size_t(h), value) {}
  Rgb& at(int x, int y) { return pixels[size_t(y) * size_t(width) + size_t(x)]; }
  const Rgb& at(int x, int y) const { return pixels[size_t(y) * size_t(width) + size_t(x)]; }
};

}  // namespace kaustik::render
