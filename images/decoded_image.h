#pragma once
// Image files decoded to linear pixels by OpenImageIO.

#include <OpenImageIO/imageio.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/texture/image_lookup.h"
#include "images/damage.h"
#include "images/decoding_memory.h"

namespace kaustik::images {

// Images of more pixels than this, and deep images, are refused by their header, before memory is allocated.
inline constexpr uint64_t kMostImagePixels = uint64_t{1} << 27;

struct DecodedImage {
  OIIO::ImageSpec spec;  // one or three channels: HALF where the file has 8 bits, FLOAT otherwise
  std::vector<unsigned char> pixels;

  size_t row_bytes() const { return static_cast<size_t>(spec.width) * spec.pixel_bytes(); }
};

// Opens the first image of a file, unless its header shows that it cannot be a texture. Otherwise returns
// null and stores a sentence in `error` that names the file.
std::unique_ptr<OIIO::ImageInput> open_texture(const std::string& path, Reads reads, std::string& error);

// Reads the first image of a file in full: its channels R, G and B, or one grey channel. Integers are decoded
// by `encoding` (sRGB by default); values that are not finite become zero. An image is refused by its header
// if `memory` has no room for it and its copy in the cache. If the file cannot be read,
// returns nothing and stores a sentence in `error` that names the file. Thread-safe; starts no threads.
std::optional<DecodedImage> decode_image(const std::string& path, const ImageEncoding& encoding,
                                         DecodingMemory::Part& memory, std::string& error);

}  // namespace kaustik::images
