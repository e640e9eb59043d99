// Reads an image file and decodes its integers; refuses what its header shows to be too large or truncated.

#include "images/decoded_image.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/spectrum/srgb.h"
#include "images/open_image.h"

namespace kaustik::images {

namespace {

double decode(double encoded, const ImageEncoding& encoding) {
  switch (encoding.kind) {
    case ImageEncoding::Kind::kLinear:
      return encoded;
    case ImageEncoding::Kind::kGamma:
      return std::pow(encoded, static_cast<double>(encoding.gamma));
    case ImageEncoding::Kind::kDefault:
    case ImageEncoding::Kind::kSrgb:
      break;
  }
  return linear_from_srgb(encoded);
}

// Decodes integers in 0..steps, which were read as floats from 0 to 1, by way of a table.
void decode_integers(std::vector<float>& values, int steps, const ImageEncoding& encoding) {
  std::vector<float> table(static_cast<size_t>(steps) + 1);
  for (size_t i = 0; i < table.size(); ++i)
    table[i] = static_cast<float>(decode(static_cast<double>(i) / steps, encoding));
  const auto scale = static_cast<float>(steps);
  for (float& v : values) v = table[static_cast<size_t>(std::lround(std::clamp(v, 0.0f, 1.0f) * scale))];
}

// Indices of the channels named R, G and B; without these names the first three channels, or three times the
// first one where there are fewer.
std::array<int, 3> colour_channels(const OIIO::ImageSpec& spec) {
  const std::array<int, 3> named{spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B")};
  if (named[0] >= 0 && named[1] >= 0 && named[2] >= 0) return named;
  return spec.nchannels >= 3 ? std::array{0, 1, 2} : std::array{0, 0, 0};
}

std::string refusal(const OIIO::ImageSpec& spec) {
  if (spec.deep) return "deep images are not supported as textures";
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1)
    return "it has no pixels or is three-dimensional";
  const uint64_t pixels = static_cast<uint64_t>(spec.width) * static_cast<uint64_t>(spec.height);
  if (pixels > kMostImagePixels || spec.nchannels > 64)
    return fmt::format(
        "{} x {} pixels of {} channels are too large: at most {} pixels of 64 channels are supported",
        spec.width, spec.height, spec.nchannels, kMostImagePixels);
  return {};
}

// Whether a PNG file is too short for its number of pixels: deflate compresses to no less than 1/1032.
// OpenImageIO would allocate memory for all pixels before it notices.
bool is_cut_png(const std::string& path, const OIIO::ImageSpec& spec) {
  std::array<char, 26> head{};  // signature, then IHDR with bit depth and colour type
  if (!std::ifstream(path, std::ios::binary).read(head.data(), head.size())) return false;
  const int type = head[25], channels = type == 2 ? 3 : type == 4 ? 2 : type == 6 ? 4 : 1;
  const uint64_t row =
      (static_cast<uint64_t>(spec.width) * static_cast<uint64_t>(head[24] * channels) + 7) / 8;
  constexpr uint64_t kMostPacked = 1032;
  std::error_code none;
  return std::filesystem::file_size(path, none) < row * static_cast<uint64_t>(spec.height) / kMostPacked;
}

// Reads all pixels and keeps the chosen channels. Values that are not finite become zero.
bool read_values(OIIO::ImageInput& in, const std::array<int, 3>& channels, bool grey,
                 std::vector<float>& values, std::string& why) {
  const OIIO::ImageSpec& spec = in.spec();
  const int first = *std::min_element(channels.begin(), channels.end());
  const int end = 1 + *std::max_element(channels.begin(), channels.end());
  const size_t pixels = static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height);
  const size_t read = static_cast<size_t>(end - first), kept = grey ? 1 : 3;
  values.resize(pixels * read);
  if (!read_channels(in, first, end, values.data(), OIIO::AutoStride, why)) return false;
  for (size_t i = 0; i < pixels; ++i) {
    std::array<float, 3> pixel{};
    for (size_t c = 0; c < kept; ++c) {
      const float v = values[i * read + static_cast<size_t>(channels[c] - first)];
      pixel[c] = std::isfinite(v) ? v : 0.0f;
    }
    std::copy_n(pixel.begin(), kept, values.begin() + static_cast<std::ptrdiff_t>(i * kept));
  }
  values.resize(pixels * kept);
  return true;
}

// As read, converted, and in the cache.
constexpr uint64_t kBytesOfNumber = 3 * sizeof(float);

std::string unreadable(const std::string& path, std::string_view why) {
  return fmt::format("cannot read the image \"{}\": {}", path, why);
}

}  // namespace

std::unique_ptr<OIIO::ImageInput> open_texture(const std::string& path, Reads reads, std::string& error) {
  std::string why;
  auto in = open_image(path, reads, {}, why);
  if (in) why = refusal(in->spec());
  if (in && why.empty() && in->format_name() == std::string_view("png") && is_cut_png(path, in->spec()))
    why = "it ends early";
  if (why.empty()) return in;
  error = unreadable(path, why);
  return nullptr;
}

std::optional<DecodedImage> decode_image(const std::string& path, const ImageEncoding& encoding,
                                         DecodingMemory::Part& memory, std::string& error) {
  const auto in = open_texture(path, Reads::kPixels, error);
  if (!in) return std::nullopt;
  const OIIO::ImageSpec spec = in->spec();
  const std::array<int, 3> channels = colour_channels(spec);
  const bool grey = channels[0] == channels[1];
  if (!memory.take(spec.image_pixels() * (grey ? 1 : 3) * kBytesOfNumber)) {
    error = unreadable(
        path, fmt::format("there is no memory left for its {} x {} pixels", spec.width, spec.height));
    return std::nullopt;
  }
  std::vector<float> values;
  std::string why;
  if (!read_values(*in, channels, grey, values, why)) {
    error = unreadable(path, why);
    return std::nullopt;
  }
  const bool bytes = spec.format == OIIO::TypeDesc::UINT8;
  if (bytes || spec.format == OIIO::TypeDesc::UINT16) decode_integers(values, bytes ? 255 : 65535, encoding);

  DecodedImage image;
  const OIIO::TypeDesc type = bytes ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT;
  image.spec = OIIO::ImageSpec(spec.width, spec.height, grey ? 1 : 3, type);
  image.pixels.resize(values.size() * type.size());
  OIIO::convert_pixel_values(OIIO::TypeDesc::FLOAT, values.data(), type, image.pixels.data(),
                             static_cast<int>(values.size()));
  return image;
}

}  // namespace kaustik::images
