#include "apps/import/common/image_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/import/common/scene_files.h"
#include "core/files/content_hash.h"
#include "render/picture/image_io.h"

namespace kaustik::pbrt {

namespace {

constexpr uint64_t kLargestImageFile = uint64_t{1} << 32;

// Of three floats: as read, as kept, and as a distribution of directions.
constexpr uint64_t kBytesOfLightPixel = 40;

// The ContentHash of a file; nothing, with a message in `error`, when it cannot be read.
std::optional<std::string> hash_of(const ReadableFile& file, std::string& error) {
  const auto bytes = read_bytes(file, kLargestImageFile, error);
  if (!bytes) return std::nullopt;
  ContentHash hash;
  hash.add(*bytes);
  return hash.text();
}

class GreyImages final : public ImageLibrary {
 public:
  Rgb lookup(uint32_t /*image*/, const ImageSampling& /*sampling*/, const Point2& /*st*/,
             const Vector2& /*dstdx*/, const Vector2& /*dstdy*/) const override {
    return Rgb(0.5f);
  }
};

}  // namespace

LightImageResult load_light_image(const ReadableFile& file, std::string* content) {
  LightImageResult result;
  const auto hash = hash_of(file, result.error);
  if (!hash) return result;
  if (content) *content = *hash;
  try {
    render::Image image = render::read_image(
        file.place().string(), std::min(kMostLightPixels, file.room().left() / kBytesOfLightPixel));
    result.image = {image.width, image.height, std::move(image.pixels)};
  } catch (const render::ImageError& e) {
    result.error = fmt::format("cannot read {}", e.what());
  }
  return result;
}

render::TextureImages& SceneTextures::textures() {
  const std::lock_guard lock(mutex_);
  if (!textures_) textures_ = render::image_formats().make_textures();
  return *textures_;
}

ImageResult SceneTextures::load(const ReadableFile& file, const ImageEncoding& encoding,
                                std::string* content) {
  ImageResult result;
  const auto hash = hash_of(file, result.error);
  if (!hash) return result;
  *content = *hash;
  const std::string place = file.place().string();
  if (pixels_) return textures().load(place, encoding, [&] { return file.room().left(); });
  result.error = render::image_formats().texture_trouble(place);
  return result;
}

std::shared_ptr<const ImageLibrary> SceneTextures::library() const {
  if (pixels_) return textures_;
  return std::make_shared<GreyImages>();
}

}  // namespace kaustik::pbrt
