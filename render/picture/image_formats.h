#pragma once
// Interface to OpenImageIO: reading pictures of any format, writing PNG and JPEG, image textures. It is an
// interface because OpenImageIO brings some 250 libraries, whose loading takes longer than rendering many a
// scene: programs load them on first use (images/loaded.cpp).
// Errors are returned as texts instead of exceptions, so that no exception type has to be the same on both
// sides of the interface.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/texture/image_lookup.h"
#include "render/picture/part_of.h"

namespace kaustik::render {

using Metadata = std::vector<std::pair<std::string, std::string>>;

// A picture as stored in its file, row 0 at the top, the channels of a pixel interleaved. Integer formats are
// scaled to [0, 1] but not decoded from sRGB.
struct ImageNumbers {
  int width = 0, height = 0, channels = 0;
  bool integers = false;
  std::vector<float> values;
  Metadata texts{};              // those of its attributes that kaustik has written
  std::optional<PartOf> part{};  // where the data window is a part of the display window

  size_t count() const { return size_t(width) * size_t(height); }
};

enum class Channels {
  kColour,  // R, G, B if the file names them; otherwise the first three, or the first alone
  kAll      // at most four channels; files with more are refused
};

enum class Encoding { kPng, kJpeg };

// The image textures of a scene.
class TextureImages : public ImageLibrary {
 public:
  // Decodes a file and keeps it. The same file with the same encoding is loaded once. May be called by
  // several threads at once, but not while lookup() is running. memory_left returns the bytes that the
  // process may still take: an image waits until it fits beside those that other threads decode, and one that
  // does not fit even alone is refused by its header.
  virtual ImageResult load(const std::string& path, const ImageEncoding& encoding,
                           const std::function<uint64_t()>& memory_left) = 0;
};

// All functions are thread-safe and make no threads.
class ImageFormats {
 public:
  virtual ~ImageFormats() = default;

  // Version of the library in use, such as "2.4.7".
  virtual std::string version() const = 0;

  // Reads the data window of a file's first picture. On failure returns nothing and sets `error` to the
  // reason. Files whose header announces more than most_pixels, a side of more than 2^16, deep data or no
  // data are refused before memory is allocated.
  virtual std::optional<ImageNumbers> read(const std::string& path, Channels channels, uint64_t most_pixels,
                                           std::string& error) const = 0;

  // Reads one layer of a file's first picture like read(): the channels R, G, B or X, Y, Z whose names begin
  // with the layer's name and a dot (`direct.R`), or else the one channel of that layer. Also fails if there
  // is no such layer; `error` then lists those that there are.
  virtual std::optional<ImageNumbers> read_layer(const std::string& path, const std::string& layer,
                                                 uint64_t most_pixels, std::string& error) const = 0;

  // Both functions make the bytes of a file in memory, so that only write_file() (core/files/pending_file.h)
  // writes to a disk, which may be full: libjpeg would end the process then, and libpng reports nothing. On
  // failure they return nothing and set `error` to the reason.

  // PNG or JPEG of three channels of 8 bits, already encoded in sRGB.
  virtual std::optional<std::string> encode_srgb8(Encoding encoding, int width, int height,
                                                  const std::vector<uint8_t>& pixels,
                                                  const Metadata& metadata, std::string& error) const = 0;
  // PNG of 8 or 16 bits from values in [0, 1].
  virtual std::optional<std::string> encode_numbers(const ImageNumbers& image, int bits,
                                                    std::string& error) const = 0;

  // The sentence with which TextureImages::load() would refuse a file by its header; empty for other files.
  virtual std::string texture_trouble(const std::string& path) const = 0;

  virtual std::shared_ptr<TextureImages> make_textures() const = 0;
};

// Defined by images/loaded.cpp, which loads OpenImageIO when it is first called. Throws
// std::runtime_error if the library cannot be loaded.
const ImageFormats& image_formats();

}  // namespace kaustik::render
