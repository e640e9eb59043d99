#pragma once
// The image files that a scene names: what lights emit, and textures.

#include <filesystem>
#include <mutex>
#include <string>

#include "core/scene/build/builder.h"
#include "render/picture/image_formats.h"

namespace kaustik::pbrt {

// More pixels are refused: 8192 x 8192, 805 MB in memory.
inline constexpr uint64_t kMostLightPixels = uint64_t{1} << 26;

// Any format that render::image_formats() reads, whole; 8 and 16 bit integers are decoded from sRGB. content:
// takes the ContentHash of the file, if it could be read. Thread-safe.
LightImageResult load_light_image(const std::filesystem::path& path, std::string* content = nullptr);

// The textures of a scene. Made with the first of them: a scene without any does not ask for image_formats().
class SceneTextures {
 public:
  // See TextureImages::load. content: as above. Thread-safe.
  ImageResult load(const std::filesystem::path& path, const ImageEncoding& encoding, std::string* content);

  // Null where nothing was loaded.
  std::shared_ptr<const ImageLibrary> library() const { return textures_; }

 private:
  render::TextureImages& textures();

  std::mutex mutex_;  // of making them
  std::shared_ptr<render::TextureImages> textures_;
};

}  // namespace kaustik::pbrt
