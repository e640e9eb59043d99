#pragma once
// The images of a scene in OpenImageIO's texture cache.

#include <OpenImageIO/texture.h>

#include <map>
#include <mutex>
#include <vector>

#include "images/decoded_image.h"
#include "images/decoding_memory.h"
#include "render/picture/image_formats.h"

namespace kaustik::images {

// Limit on the decoded size of all images of a scene together, without MIP levels. Further images are refused
// by their headers.
inline constexpr uint64_t kMostImageBytes = uint64_t{8} << 30;

// Holds images as tiles of linear half or float pixels; their MIP levels are made when they are first read.
// The cache has room for all images and starts no threads.
class TextureCache final : public render::TextureImages {
 public:
  TextureCache();
  ~TextureCache() override;
  TextureCache(const TextureCache&) = delete;
  TextureCache& operator=(const TextureCache&) = delete;

  ImageResult load(const std::string& path, const ImageEncoding& encoding,
                   const std::function<uint64_t()>& memory_left) override;

  Rgb lookup(uint32_t image, const ImageSampling& sampling, const Point2& st, const Vector2& dstdx,
             const Vector2& dstdy) const override;
  // The MIP levels, a third of the images.
  uint64_t bytes_to_come() const override { return bytes_ / 3; }

 private:
  struct Key {
    std::string path;
    ImageEncoding encoding;
    auto operator<=>(const Key&) const = default;
  };
  struct Entry {
    OIIO::TextureSystem::TextureHandle* handle = nullptr;
    int channels = 3;
  };
  struct System;

  void add(const DecodedImage& image, const std::string& path, ImageResult* result);

  System& system_;
  DecodingMemory decoding_;
  std::mutex mutex_;  // guards the members below
  std::map<Key, ImageResult> loaded_;
  std::vector<Entry> entries_;
  std::vector<OIIO::ustring> names_;  // names of the images in the cache
  uint64_t bytes_ = 0;
};

}  // namespace kaustik::images
