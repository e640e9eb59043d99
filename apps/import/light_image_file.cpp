#include "apps/import/light_image_file.h"

#include <fmt/format.h>

#include "apps/import/scene_files.h"
#include "core/content_hash.h"
#include "render/image_io.h"

namespace kaustik::pbrt {

namespace {

constexpr uint64_t kLargestImageFile = uint64_t{1} << 32;

}  // namespace

LightImageResult load_light_image(const std::filesystem::path& path, std::string* content) {
  LightImageResult result;
  if (const auto bytes = read_bytes(path, kLargestImageFile, result.error); bytes && content) {
    ContentHash hash;
    hash.add(*bytes);
    *content = hash.text();
  }
  if (!result.error.empty()) return result;
  try {
    render::Image image = render::read_image(path.string(), kMostLightPixels);
    result.image = {image.width, image.height, std::move(image.pixels)};
  } catch (const render::ImageError& e) {
    result.error = fmt::format("cannot read {}", e.what());
  }
  return result;
}

}  // namespace kaustik::pbrt
