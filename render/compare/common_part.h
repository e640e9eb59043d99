#pragma once
// Crops compared with their full picture.

#include <optional>

#include "render/picture/image.h"

namespace kaustik::render {

// A rectangle of pixels of a full picture.
struct PixelRectangle {
  int x = 0, y = 0, width = 0, height = 0;
};

// What both pictures show, in pixels of the full picture: the smaller one, which must lie within the other
// one. Nothing unless one of them is a part of a picture whose size the other one, or the picture that the
// other one is a part of, has. Throws std::invalid_argument when neither lies within the other one.
std::optional<PixelRectangle> common_part(const Image& reference, const Image& image);

// The pixels of a rectangle that lies within the picture.
Image cut_to(const Image& image, const PixelRectangle& part);

}  // namespace kaustik::render
