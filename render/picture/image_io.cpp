// Chooses the format from the file name and converts films and images for it.

#include "render/picture/image_io.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <filesystem>

#include "core/files/pending_file.h"
#include "core/spectrum/srgb.h"
#include "core/text.h"
#include "render/picture/exr_file.h"
#include "render/settings/settings.h"

namespace kaustik::render {

namespace {

namespace fs = std::filesystem;

// Not by way of memory, as PNG and JPEG: many layers of a large film are gigabytes, and OpenEXR reports
// failures.
void write_exr(const std::string& path, const ExrPicture& picture, const Metadata& metadata) {
  try {
    PendingFile file(path);
    write_exr_file(file, picture, metadata);
    file.commit();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw ImageError(path, error.what());
  }
}

const LayerRow& row_of(Layer layer) {
  return kLayerTable[size_t(layer)];
}

void write_exr(const std::string& path, const Film& film, const WriteOptions& options) {
  std::vector<std::string> names = {"R", "G", "B"};
  if (options.picture) names.insert(names.end(), {"noisy.R", "noisy.G", "noisy.B"});
  for (const Layer layer : options.layers)
    for (const char channel : row_of(layer).channels)
      names.push_back(fmt::format("{}.{}", row_of(layer).name, channel));
  for (const std::string_view half : kHalfNames) {
    if (!options.halves) continue;
    for_each_half_channel([&](const LayerRow& row, size_t, size_t c) {
      names.push_back(fmt::format("{}.{}.{}", half, row.name, row.channels[c]));
    });
    names.push_back(fmt::format("{}.share.Y", half));
  }
  std::vector<float> pixels;
  pixels.reserve(size_t(film.width()) * size_t(film.height()) * names.size());
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const PixelResult& pixel = film.at(x, y);
      const Rgb total = pixel.radiance();
      if (options.picture) {
        const Rgb& shown = options.picture->at(x, y);
        pixels.insert(pixels.end(), {shown.x, shown.y, shown.z});
      }
      pixels.insert(pixels.end(), {total.x, total.y, total.z});
      for (const Layer layer : options.layers) {
        const float* const values = row_of(layer).in(pixel);
        pixels.insert(pixels.end(), values, values + row_of(layer).channels.size());
      }
      for (size_t h = 0; options.halves && h < kHalfNames.size(); ++h) {
        const HalfMeans& means = options.halves->at(x, y);
        pixels.insert(pixels.end(), means.mean[h].begin(), means.mean[h].end());
        pixels.push_back(means.share[h]);
      }
    }
  // Radiance is noisy down to its last bits: for 512 x 512 pixels zip takes 75 ms to save 6 %, run lengths
  // take 3 ms to save 1 %, and compress an empty background as well. Other layers are smooth.
  const ExrPicture picture{std::move(names), film.x0(),         film.y0(),          film.width(),
                           film.height(),    film.full_width(), film.full_height(), !options.layers.empty(),
                           pixels.data()};
  write_exr(path, picture, options.metadata);
}

void write_exr(const std::string& path, const Image& image, const Metadata& metadata) {
  static_assert(sizeof(Rgb) == 3 * sizeof(float));
  const ExrPicture picture{.channels = {"R", "G", "B"},
                           .width = image.width,
                           .height = image.height,
                           .full_width = image.width,
                           .full_height = image.height,
                           .values = &image.pixels.data()->x};
  write_exr(path, picture, metadata);
}

constexpr std::string_view kExposureKey = "kaustik:exposure", kTonemapKey = "kaustik:tonemap";

// The metadata with what turned radiance into what the file holds.
Metadata with_tone(Metadata metadata, const ToneSettings& tone) {
  metadata.emplace_back(kExposureKey, fmt::format("{}", tone.exposure));
  metadata.emplace_back(kTonemapKey, name_of(tone.tonemap));
  return metadata;
}

void write_srgb8(const std::string& path, const Image& image, const ToneSettings& tone,
                 const Metadata& metadata) {
  std::vector<uint8_t> pixels;
  pixels.reserve(3 * image.pixels.size());
  for (const Rgb& radiance : image.pixels) {
    const auto encoded = to_srgb8(radiance, tone);
    pixels.insert(pixels.end(), encoded.begin(), encoded.end());
  }
  const Encoding encoding = lower_extension(path) == ".png" ? Encoding::kPng : Encoding::kJpeg;
  std::string error;
  const auto bytes = image_formats().encode_srgb8(encoding, image.width, image.height, pixels,
                                                  with_tone(metadata, tone), error);
  if (!bytes) throw ImageError(path, error);
  try {
    write_file(path, *bytes);
  } catch (const FileError& failure) {
    throw ImageError(path, failure.what());
  }
}

// What with_tone() has written, if a file has it.
std::optional<ToneSettings> tone_in(const Metadata& metadata) {
  std::optional<float> exposure;
  std::optional<Tonemap> tonemap;
  for (const auto& [key, value] : metadata) {
    if (float stops = 0; key == kExposureKey &&
                         std::from_chars(value.data(), value.data() + value.size(), stops).ec == std::errc())
      exposure = stops;
    if (key == kTonemapKey) tonemap = tonemap_from_name(value);
  }
  return exposure && tonemap ? std::optional(ToneSettings{*exposure, *tonemap}) : std::nullopt;
}

// An image of three channels, or of the first one three times.
Image image_from(const ImageNumbers& numbers) {
  const size_t channels = size_t(numbers.channels);
  Image image(numbers.width, numbers.height);
  image.part = numbers.part;
  image.for_display = numbers.integers;
  if (numbers.integers) image.tone = tone_in(numbers.texts);
  for (size_t i = 0; i < image.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const float v = numbers.values[i * channels + size_t(channels == 3 ? c : 0)];
      image.pixels[i][c] = numbers.integers ? linear_from_srgb(v) : v;
    }
  return image;
}

}  // namespace

std::vector<Layer> layers_from_names(const std::vector<std::string>& names) {
  std::array<bool, kLayers> wanted{};
  for (const std::string& name : names) {
    const auto found = std::find(kLayerNames.begin(), kLayerNames.end(), name);
    if (name == "all")
      wanted.fill(true);
    else if (name == kDenoisingLayers)
      for (const LayerRow& row : kLayerTable)
        wanted[size_t(row.layer)] |= in_halves(row) || row.layer == Layer::kEmitted;
    else if (found != kLayerNames.end())
      wanted[size_t(found - kLayerNames.begin())] = true;
    else
      throw std::invalid_argument(fmt::format("unknown layer '{}'; there are: {}, denoising, all", name,
                                              fmt::join(kLayerNames, ", ")));
  }
  std::vector<Layer> layers;
  for (int i = 0; i < kLayers; ++i)
    if (wanted[size_t(i)]) layers.push_back(Layer(i));
  return layers;
}

void check_output_name(const std::string& path) {
  const std::string extension = lower_extension(path);
  if (extension != ".exr" && extension != ".png" && extension != ".jpg" && extension != ".jpeg")
    throw std::invalid_argument(path + ": the name must end in .exr, .png, .jpg or .jpeg");
}

bool is_exr(const std::string& path) {
  return lower_extension(path) == ".exr";
}

void write_film(const std::string& path, const Film& film, const WriteOptions& options) {
  check_output_name(path);
  if (is_exr(path))
    write_exr(path, film, options);
  else
    write_srgb8(path, options.picture ? *options.picture : image_of(film), options.tone, options.metadata);
}

void write_channels(const std::string& path, const ExrChannels& channels, const Metadata& metadata) {
  const size_t count = channels.names.size();
  std::vector<float> pixels(count * size_t(channels.width) * size_t(channels.height));
  for (size_t c = 0; c < count; ++c)
    for (size_t i = 0; i < channels.values[c].size(); ++i) pixels[i * count + c] = channels.values[c][i];
  write_exr(path,
            {.channels = channels.names,
             .x0 = channels.x0,
             .y0 = channels.y0,
             .width = channels.width,
             .height = channels.height,
             .full_width = channels.full_width,
             .full_height = channels.full_height,
             .values = pixels.data()},
            metadata);
}

void write_image(const std::string& path, const Image& image, const ToneSettings& tone,
                 const Metadata& metadata) {
  check_output_name(path);
  if (is_exr(path))
    write_exr(path, image, metadata);
  else
    write_srgb8(path, image, tone, metadata);
}

Image read_image(const std::string& path, uint64_t most_pixels) {
  std::string error;
  const auto numbers = image_formats().read(path, Channels::kColour, most_pixels, error);
  if (!numbers) throw ImageError(path, error);
  return image_from(*numbers);
}

Image read_layer(const std::string& path, const std::string& layer, uint64_t most_pixels) {
  std::string error;
  const auto numbers = image_formats().read_layer(path, layer, most_pixels, error);
  if (!numbers) throw ImageError(path, error);
  return image_from(*numbers);
}

}  // namespace kaustik::render
