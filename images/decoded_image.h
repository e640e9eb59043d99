#pragma once
// Image files as linear pixels, read by OpenImageIO.

#include <OpenImageIO/imageio.h>

#include <optional>
#include <string>
#include <vector>

#include "core/texture/image_lookup.h"

namespace kaustik::images {

// What is refused by its header, before memory is taken: images of more pixels than this, and deep ones.
inline constexpr uint64_t kMostImagePixels = uint64_t{1} << 27;

struct DecodedImage {
  OIIO::ImageSpec spec;  // one or three channels: HALF where the file has 8 bits, else FLOAT
  std::vector<unsigned char> pixels;

  size_t row_bytes() const { return static_cast<size_t>(spec.width) * spec.pixel_bytes(); }
};

// The first image of a file, in full, its first channel or R, G and B. Integers are decoded by the encoding,
// by default as sRGB; numbers that are not finite become zero. Nothing, with a sentence in `error` that names
// the file, where it cannot be read. Thread-safe; makes no threads.
std::optional<DecodedImage> decode_image(const std::string& path, const ImageEncoding& encoding,
                                         std::string& error);

}  // namespace kaustik::images
