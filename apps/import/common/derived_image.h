#pragma once
// Makes image files from others. The functions `write_...` return an error message, or nothing on success.

#include <filesystem>
#include <functional>
#include <optional>

#include "core/files/read_root.h"
#include "core/math/vec.h"

namespace kaustik::gltf {

// Raises the colours of an sRGB image to `exponent` and multiplies them by `factor` in linear light, and
// writes an sRGB PNG.
std::optional<std::string> write_tinted(const ReadableFile& from, const std::filesystem::path& to,
                                        const glm::dvec3& factor, double exponent = 1);
// Applies `map` to one channel (0 to 3) of an image and writes a 16-bit grey PNG. A missing alpha channel
// counts as 1. Constant results are written too.
std::optional<std::string> write_channel(const ReadableFile& from, const std::filesystem::path& to,
                                         int channel, const std::function<double(double)>& map);
// Means over all pixels of an image.
struct ImageMeans {
  glm::dvec3 linear{0};  // in linear light: sRGB values are decoded first
  glm::dvec4 stored{0};  // of the stored numbers; a missing alpha counts as 1
};
// Nothing, with a message in `error`, when the image cannot be read. The second function returns the mean
// colour, in linear light or as stored.
std::optional<ImageMeans> image_means(const ReadableFile& from, std::string& error);
std::optional<glm::dvec3> mean_colour(const ReadableFile& from, bool srgb, std::string& error);

}  // namespace kaustik::gltf
