#pragma once
// Loads the image files that a scene names: emission images of lights, and textures.

#include <mutex>
#include <string>

#include "core/files/read_root.h"
#include "core/scene/build/builder.h"
#include "render/picture/image_formats.h"

namespace kaustik::pbrt {

// Emission images with more pixels than this are refused: 8192 x 8192, 805 MB in memory.
inline constexpr uint64_t kMostLightPixels = uint64_t{1} << 26;

// Reads a whole image in any format that render::image_formats() knows; 8- and 16-bit integers are decoded
// from sRGB. `content` receives the ContentHash of the file if it could be read. Thread-safe.
LightImageResult load_light_image(const ReadableFile& file, std::string* content = nullptr);

// The textures of a scene, or, if no pixels are wanted, a grey library in their place, for which files are
// checked by their headers only. The library that holds them is made when the first one is loaded, so a scene
// without textures never asks for image_formats().
class SceneTextures {
 public:
  explicit SceneTextures(bool pixels) : pixels_(pixels) {}

  // See TextureImages::load. `content` receives the ContentHash of the file if it could be read. Thread-safe.
  ImageResult load(const ReadableFile& file, const ImageEncoding& encoding, std::string* content);

  // Null when no texture was loaded.
  std::shared_ptr<const ImageLibrary> library() const;

 private:
  render::TextureImages& textures();

  bool pixels_;
  std::mutex mutex_;  // guards the creation of textures_
  std::shared_ptr<render::TextureImages> textures_;
};

}  // namespace kaustik::pbrt
