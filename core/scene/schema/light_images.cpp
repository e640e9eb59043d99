// Loads the images of lights, once each, and checks their pixels.

#include "core/scene/schema/light_images.h"

#include <fmt/format.h>

namespace kaustik {
namespace {

std::string pixel_text(const LightImage& image, size_t i) {
  const size_t width = static_cast<size_t>(image.width);
  return fmt::format("pixel ({}, {}), {} {} {}", i % width, i / width, image.pixels[i].x, image.pixels[i].y,
                     image.pixels[i].z);
}

bool negative(const Rgb& c) {
  return c.x < 0 || c.y < 0 || c.z < 0;
}

// Returns false, with an error, if a pixel is not finite; sets negative values to zero, with a warning.
bool check_pixels(const std::string& file, LightImage& image, const SourceLocation& where,
                  DiagnosticList& diagnostics) {
  size_t negatives = 0;
  std::string first;
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    Rgb& c = image.pixels[i];
    if (!is_finite(c)) {
      diagnostics.error(where, fmt::format("\"{}\": {}, is not finite: no light can emit that", file,
                                           pixel_text(image, i)));
      return false;
    }
    if (!negative(c)) continue;
    if (negatives++ == 0) first = pixel_text(image, i);
    c = glm::max(c, Rgb(0));
  }
  if (negatives > 0) {
    diagnostics.warning(where, fmt::format("\"{}\": {} negative pixel{} taken as zero; the first is {}", file,
                                           negatives, negatives == 1 ? "" : "s", first));
  }
  return true;
}

std::shared_ptr<const LightImage> scaled_image(std::shared_ptr<const LightImage> image, const Rgb& factor) {
  if (factor == Rgb(1)) return image;
  LightImage scaled = *image;
  for (Rgb& c : scaled.pixels) c *= factor;
  return std::make_shared<const LightImage>(std::move(scaled));
}

std::shared_ptr<const LightImage> grey_image(const LightImage& image) {
  LightImage grey = image;
  for (Rgb& c : grey.pixels) c = Rgb((c.x + c.y + c.z) / 3);
  return std::make_shared<const LightImage>(std::move(grey));
}

}  // namespace

std::shared_ptr<const LightImage> LightImages::load(const std::string& file, const SourceLocation& where) {
  LightImageResult result =
      load_ ? load_(file, where) : LightImageResult{{}, "image files cannot be read here"};
  if (result.error.empty() && result.image.pixels.empty())
    result.error = fmt::format("\"{}\" has no pixels", file);
  if (!result.error.empty()) {
    diagnostics_.error(where, result.error);
    return nullptr;
  }
  if (!check_pixels(file, result.image, where, diagnostics_)) return nullptr;
  return std::make_shared<const LightImage>(std::move(result.image));
}

std::shared_ptr<const LightImage> LightImages::get(const ParameterReader& parameters, std::string_view name) {
  const std::string file = parameters.text(name);
  const SourceLocation where = parameters.location(name);
  const auto [entry, added] = images_.try_emplace({file, where.file});
  if (added) entry->second = load(file, where);
  return entry->second;
}

std::shared_ptr<const DirectionMap> LightImages::directions(const ParameterReader& parameters,
                                                            std::string_view name, Around around,
                                                            const Rgb& factor) {
  auto image = get(parameters, name);
  if (!image) return nullptr;
  const std::string file = parameters.text(name);
  const bool square = image->width == image->height, twice = image->width == 2 * image->height;
  if (!square) {
    const std::string shape =
        twice ? "" : fmt::format(" although it has {} x {} pixels", image->width, image->height);
    diagnostics_.warning(
        parameters.location(name),
        fmt::format("\"{}\" is read as a latitude-longitude map with +z at the top{}; pbrt-v4 takes "
                    "only square equal-area maps",
                    file, shape));
  }
  const auto layout = square ? DirectionMap::Layout::kEqualArea : DirectionMap::Layout::kLatLong;
  if (around == Around::kLight) return std::make_shared<const DirectionMap>(grey_image(*image), layout);
  return std::make_shared<const DirectionMap>(scaled_image(std::move(image), factor), layout,
                                              DirectionMap::Excess::kSampled);
}

}  // namespace kaustik
