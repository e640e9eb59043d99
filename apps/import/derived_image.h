#pragma once
// Images made from others. Each function gives what went wrong, or nothing.

#include <filesystem>
#include <functional>
#include <optional>

#include "core/math/vec.h"

namespace kaustik::gltf {

// Colours, which are sRGB, times a factor in linear light: an sRGB PNG.
std::optional<std::string> write_tinted(const std::filesystem::path& from, const std::filesystem::path& to,
                                        const glm::dvec3& factor);
// One channel (0 to 3) of an image, 1 where there is none, mapped to a grey PNG of 16 bits. Where no pixel
// differs from another the image is still written.
std::optional<std::string> write_channel(const std::filesystem::path& from, const std::filesystem::path& to,
                                         int channel, const std::function<double(double)>& map);
// Of the numbers, decoded first where they are sRGB.
std::optional<glm::dvec3> mean_colour(const std::filesystem::path& from, bool srgb, std::string& error);

}  // namespace kaustik::gltf
