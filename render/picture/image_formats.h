#pragma once
// What OpenImageIO does for us: reading pictures of any format, PNG and JPEG, image textures. It stands
// behind an interface because it brings some 250 libraries, whose loading takes longer than many a scene: the
// program loads it when it is first asked for something (images/loaded.cpp), tests link it
// (images/linked.cpp). Errors are texts, not exceptions, so that no type of ours has to be the same on both
// sides of the border.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/texture/image_lookup.h"

namespace kaustik::render {

using Metadata = std::vector<std::pair<std::string, std::string>>;

// A picture as its file has it, row 0 on top, the channels of a pixel beside each other. Integers are 0 to 1,
// and not decoded.
struct ImageNumbers {
  int width = 0, height = 0, channels = 0;
  bool integers = false;
  std::vector<float> values;

  size_t count() const { return size_t(width) * size_t(height); }
};

enum class Channels {
  kColour,  // R, G, B; else the first three, else the first alone
  kAll      // at most four, more are refused
};

// The image textures of a scene.
class TextureImages : public ImageLibrary {
 public:
  // Decodes a file and keeps it. The same file with the same encoding is one image. May be called from
  // several threads at once, not beside lookup().
  virtual ImageResult load(const std::string& path, const ImageEncoding& encoding) = 0;
};

// Every function is thread-safe and makes no threads.
class ImageFormats {
 public:
  virtual ~ImageFormats() = default;

  // "2.4.7": of the library that is at work.
  virtual std::string version() const = 0;

  // The data window of a file's first picture. Nothing, with the reason in `error`, where it cannot be read;
  // also, before memory is taken, where the header promises more pixels than most_pixels, a side of more than
  // 2^16, deep data or none.
  virtual std::optional<ImageNumbers> read(const std::string& path, Channels channels, uint64_t most_pixels,
                                           std::string& error) const = 0;

  // PNG or JPEG by the extension, three channels of 8 bits that are encoded in sRGB. Why it could not be
  // written; empty when it was.
  virtual std::string write_srgb8(const std::string& path, int width, int height,
                                  const std::vector<uint8_t>& pixels, const Metadata& metadata) const = 0;

  // PNG of 8 or 16 bits, values of 0 to 1. Why it could not be written; empty when it was.
  virtual std::string write_numbers(const std::string& path, const ImageNumbers& image, int bits) const = 0;

  virtual std::shared_ptr<TextureImages> make_textures() const = 0;
};

// Whoever links a program decides how it comes. Throws std::runtime_error where it cannot be loaded.
const ImageFormats& image_formats();

}  // namespace kaustik::render
