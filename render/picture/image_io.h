#pragma once
// Reading and writing pictures: EXR with layers and metadata, PNG and JPEG tone-mapped. All but writing EXR
// asks image_formats(), whose std::runtime_error passes through where it cannot be loaded. Not handled: deep
// images, mip levels, spectral or non-Rec. 709 primaries.

#include <stdexcept>
#include <string>
#include <vector>

#include "render/film/film.h"
#include "render/picture/image.h"
#include "render/picture/image_formats.h"
#include "render/picture/tonemap.h"

namespace kaustik::render {

// what() begins with the path.
class ImageError : public std::runtime_error {
 public:
  ImageError(const std::string& path, const std::string& message)
      : std::runtime_error(path + ": " + message), path_(path) {}
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

struct WriteOptions {
  std::vector<Layer> layers;  // EXR only: besides the image itself
  Metadata metadata;          // string attributes: of every format that keeps them
  ToneSettings tone;          // PNG and JPEG only
};

// Layers from names of `--aov`; "all" means every layer, repeated names count once. Throws
// std::invalid_argument naming the unknown layer and the valid ones.
std::vector<Layer> layers_from_names(const std::vector<std::string>& names);

// Throws std::invalid_argument unless path ends in .exr, .png, .jpg or .jpeg (any case). For the command
// line: to fail before rendering.
void check_output_name(const std::string& path);

// By its name: the one format that is written without image_formats().
bool is_exr(const std::string& path);

// Writes a film by the extension of its path. EXR: 32-bit float, channels R G B (total radiance) and for each
// layer `direct.R direct.G direct.B`, `normal.X normal.Y normal.Z`, `depth.Z`, `photons.Y`; a crop becomes
// the data window inside the full display window. PNG, JPEG: 8-bit sRGB. The file appears under its name only
// when it is complete: it is written to a temporary name in the same folder and renamed. Throws ImageError;
// then nothing is left behind and a previous file of that name is untouched.
void write_film(const std::string& path, const Film& film, const WriteOptions& options = {});

// The same for a plain picture (EXR: channels R G B).
void write_image(const std::string& path, const Image& image, const ToneSettings& tone = {},
                 const Metadata& metadata = {});

inline constexpr uint64_t kMostPixelsRead = uint64_t{1} << 30;

// Reads R, G, B (or one grey channel three times) of any format that image_formats() knows, as linear
// floats: integer formats are decoded from sRGB. Only the data window is returned. Throws ImageError, also
// for what ImageFormats::read refuses.
Image read_image(const std::string& path, uint64_t most_pixels = kMostPixelsRead);

}  // namespace kaustik::render
