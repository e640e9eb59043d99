#pragma once
// The images that lamps emit.

#include <filesystem>
#include <string>

#include "core/scene/builder.h"

namespace kaustik::pbrt {

// More pixels are refused: 8192 x 8192, 805 MB in memory.
inline constexpr uint64_t kMostLightPixels = uint64_t{1} << 26;

// Any format that OpenImageIO reads, whole; 8 and 16 bit integers are decoded from sRGB. content: takes the
// ContentHash of the file, if it could be read. Thread-safe.
LightImageResult load_light_image(const std::filesystem::path& path, std::string* content = nullptr);

}  // namespace kaustik::pbrt
