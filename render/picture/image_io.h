#pragma once
// Reads and writes pictures: EXR with layers and metadata, PNG and JPEG after tone mapping. Everything but
// writing EXR uses image_formats(), whose std::runtime_error is passed on if it cannot be loaded. Not
// handled: deep images, mip levels, spectral images, primaries other than Rec. 709.

#include <stdexcept>
#include <string>
#include <vector>

#include "render/film/halves.h"
#include "render/picture/exr_file.h"
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
  std::vector<Layer> layers;  // EXR only, in addition to the image itself
  Metadata metadata;          // string attributes, for formats that keep them
  ToneSettings tone;          // PNG and JPEG only
  // The picture, in place of the film's total radiance, which EXR files then hold as the layer `noisy`; of
  // the film's size, or null.
  const Image* picture = nullptr;
  const HalfFilm* halves = nullptr;  // EXR only: written too, if not null
};

// Layers from the names of `--aov`; "all" means every layer, "denoising" those that a denoiser reads, and
// repeated names count once. Throws std::invalid_argument for an unknown layer, with the list of valid ones.
std::vector<Layer> layers_from_names(const std::vector<std::string>& names);

// The total radiance as an image.
inline Image image_of(const Film& film) {
  Image image(film.width(), film.height());
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) image.at(x, y) = film.at(x, y).radiance();
  return image;
}

// Throws std::invalid_argument unless path ends in .exr, .png, .jpg or .jpeg (in any case). Lets the command
// line fail before rendering.
void check_output_name(const std::string& path);

// Whether the path's extension is that of EXR, the one format that is written without image_formats().
bool is_exr(const std::string& path);

// Writes a film in the format that the path's extension names. EXR: 32-bit float, channels R G B (total
// radiance) and for each layer `direct.R direct.G direct.B`, `normal.X normal.Y normal.Z`, `depth.Z`,
// `photons.Y`; a crop becomes the data window inside the full display window. PNG, JPEG: 8-bit sRGB. The file
// is written under a temporary name in the same folder and renamed when complete. Throws ImageError; then no
// file is left behind, and a previous file of that name is unchanged.
void write_film(const std::string& path, const Film& film, const WriteOptions& options = {});

// Writes channels as they are to an EXR file, in the same way.
void write_channels(const std::string& path, const ExrChannels& channels, const Metadata& metadata = {});

// Writes a plain picture like write_film() (EXR: channels R G B).
void write_image(const std::string& path, const Image& image, const ToneSettings& tone = {},
                 const Metadata& metadata = {});

inline constexpr uint64_t kMostPixelsRead = uint64_t{1} << 30;

// Reads R, G, B (or one grey channel three times) in any format that image_formats() knows, as linear floats:
// integer formats are decoded from sRGB. Only the data window is returned, with its place. Throws ImageError,
// also for files that ImageFormats::read() refuses.
Image read_image(const std::string& path, uint64_t most_pixels = kMostPixelsRead);

// Reads one layer of a picture, as write_film() names them: three channels, or one three times. Throws as
// read_image() does; the message for a layer that the file does not have lists those that it has.
Image read_layer(const std::string& path, const std::string& layer, uint64_t most_pixels = kMostPixelsRead);

}  // namespace kaustik::render
