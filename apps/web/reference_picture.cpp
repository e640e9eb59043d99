#include "apps/web/reference_picture.h"

#include <fmt/format.h>

#include "apps/console/exit_error.h"
#include "render/picture/image_io.h"

namespace kaustik::app {

namespace {

// Where the range's upper left pixel lies in the image.
std::optional<std::pair<int, int>> place_in(const render::Image& image, const render::PixelRange& range,
                                            int full_width, int full_height) {
  const bool is_part =
      image.part && image.part->full_width == full_width && image.part->full_height == full_height;
  const int left = is_part ? image.part->x : 0, top = is_part ? image.part->y : 0;
  if (is_part || (image.width == full_width && image.height == full_height)) {
    const bool holds = range.x0 >= left && range.y0 >= top && range.x1 <= left + image.width &&
                       range.y1 <= top + image.height;
    return holds ? std::optional(std::pair(range.x0 - left, range.y0 - top)) : std::nullopt;
  }
  const bool fits = image.width == range.width() && image.height == range.height();
  return fits ? std::optional(std::pair(0, 0)) : std::nullopt;
}

}  // namespace

std::vector<float> read_reference(const std::string& path, const render::PixelRange& range, int full_width,
                                  int full_height) {
  render::Image image;
  try {
    image = render::read_image(path);
  } catch (const render::ImageError& error) {
    throw ExitError(kBadCommandLine, fmt::format("--reference {}", error.what()));
  }
  const auto place = place_in(image, range, full_width, full_height);
  if (!place)
    throw ExitError(kBadCommandLine,
                    fmt::format("--reference {}: it has {} x {} pixels, and the picture {} x {}", path,
                                image.width, image.height, full_width, full_height));
  std::vector<float> values;
  values.reserve(3 * range.pixels());
  for (int y = 0; y < range.height(); ++y)
    for (int x = 0; x < range.width(); ++x)
      for (int c = 0; c < 3; ++c) values.push_back(image.at(place->first + x, place->second + y)[c]);
  return values;
}

}  // namespace kaustik::app
