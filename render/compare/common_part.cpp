#include "render/compare/common_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace kaustik::render {

namespace {

PixelRectangle place_of(const Image& image) {
  if (const auto& part = image.part) return {part->x, part->y, image.width, image.height};
  return {0, 0, image.width, image.height};
}

bool contains(const PixelRectangle& outer, const PixelRectangle& inner) {
  return inner.x >= outer.x && inner.y >= outer.y && inner.x + inner.width <= outer.x + outer.width &&
         inner.y + inner.height <= outer.y + outer.height;
}

std::string text_of(const PixelRectangle& r) {
  return fmt::format("x {} to {}, y {} to {}", r.x, r.x + r.width - 1, r.y, r.y + r.height - 1);
}

}  // namespace

std::optional<PixelRectangle> common_part(const Image& reference, const Image& image) {
  if (!reference.part && !image.part) return std::nullopt;
  const auto full = [](const Image& i) {
    return i.part ? std::pair(i.part->full_width, i.part->full_height) : std::pair(i.width, i.height);
  };
  if (full(reference) != full(image)) return std::nullopt;
  const PixelRectangle r = place_of(reference), i = place_of(image);
  if (contains(r, i)) return i;
  if (contains(i, r)) return r;
  throw std::invalid_argument(
      fmt::format("the pictures are different parts of one of {} x {} pixels, and neither lies within the "
                  "other one: the reference has {}; the image has {}",
                  full(image).first, full(image).second, text_of(r), text_of(i)));
}

Image cut_to(const Image& image, const PixelRectangle& part) {
  const PixelRectangle place = place_of(image);
  Image out(part.width, part.height);
  out.for_display = image.for_display;
  out.tone = image.tone;
  for (int y = 0; y < part.height; ++y) {
    const Rgb* const row = &image.at(part.x - place.x, part.y - place.y + y);
    std::copy(row, row + part.width, &out.at(0, y));
  }
  return out;
}

}  // namespace kaustik::render
