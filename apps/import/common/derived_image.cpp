#include "apps/import/common/derived_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/files/pending_file.h"
#include "core/spectrum/srgb.h"
#include "render/picture/image_formats.h"

namespace kaustik::gltf {
namespace {

constexpr uint64_t kMostPixels = uint64_t{1} << 28;
// Of four floats, as read and as written.
constexpr uint64_t kBytesOfPixel = 2 * 4 * sizeof(float);

using render::ImageNumbers;

// Channel 0 to 3 (RGBA) of a pixel. A grey image's one channel serves as red, green and blue; a missing alpha
// is 1.
double at(const ImageNumbers& image, size_t pixel, int channel) {
  const int channels = image.channels;
  const bool grey = channels < 3;
  if (channel == 3 && channels != 2 && channels != 4) return 1;
  const int c = channel == 3 ? channels - 1 : grey ? 0 : channel;
  return double(image.values[pixel * static_cast<size_t>(channels) + static_cast<size_t>(c)]);
}

std::optional<ImageNumbers> read(const ReadableFile& file, std::string& error) {
  std::string why;
  std::optional<ImageNumbers> image;
  try {
    image = render::image_formats().read(file.place().string(), render::Channels::kAll,
                                         std::min(kMostPixels, file.room().left() / kBytesOfPixel), why);
  } catch (const FileError& refusal) {
    why = refusal.what();
  }
  if (!image) error = fmt::format("cannot read \"{}\": {}", file.path().string(), why);
  return image;
}

std::optional<std::string> write(const std::filesystem::path& path, const ImageNumbers& image, int bits) {
  std::string why;
  const auto bytes = render::image_formats().encode_numbers(image, bits, why);
  try {
    if (bytes) write_file(path, *bytes);
  } catch (const FileError& error) {
    why = error.what();
  }
  if (why.empty()) return std::nullopt;
  return fmt::format("cannot write \"{}\": {}", path.string(), why);
}

// A function of an image's values. Those of integer images are multiples of 1/65535, as 8 and 16 bits are, so
// that for large images a table takes the place of one or two powers for each value.
class ValueFunction {
 public:
  ValueFunction(const ImageNumbers& image, std::function<double(double)> function)
      : function_(std::move(function)) {
    if (!image.integers || image.values.size() < kSteps) return;
    for (size_t i = 0; i <= kSteps; ++i) table_.push_back(function_(double(i) / double(kSteps)));
  }
  double operator()(double value) const {
    if (table_.empty()) return function_(value);
    return table_[static_cast<size_t>(std::lround(std::clamp(value, 0.0, 1.0) * double(kSteps)))];
  }

 private:
  static constexpr size_t kSteps = 65535;
  std::function<double(double)> function_;
  std::vector<double> table_;
};

}  // namespace

std::optional<std::string> write_tinted(const ReadableFile& from, const std::filesystem::path& to,
                                        const glm::dvec3& factor, double exponent) {
  std::string error;
  const auto image = read(from, error);
  if (!image) return error;
  ImageNumbers out{image->width, image->height, 3, true, {}};
  out.values.resize(3 * image->count());
  for (int c = 0; c < 3; ++c) {
    const ValueFunction tinted(*image, [&](double v) {
      return srgb_from_linear(factor[c] * std::pow(linear_from_srgb(v), exponent));
    });
    for (size_t i = 0; i < image->count(); ++i)
      out.values[3 * i + static_cast<size_t>(c)] = static_cast<float>(tinted(at(*image, i, c)));
  }
  return write(to, out, 8);
}

std::optional<std::string> write_channel(const ReadableFile& from, const std::filesystem::path& to,
                                         int channel, const std::function<double(double)>& map) {
  std::string error;
  const auto image = read(from, error);
  if (!image) return error;
  ImageNumbers out{image->width, image->height, 1, true, {}};
  out.values.reserve(image->count());
  const ValueFunction mapped(*image, [&](double v) { return std::clamp(map(v), 0.0, 1.0); });
  for (size_t i = 0; i < image->count(); ++i)
    out.values.push_back(static_cast<float>(mapped(at(*image, i, channel))));
  return write(to, out, 16);
}

std::optional<ImageMeans> image_means(const ReadableFile& from, std::string& error) {
  const auto image = read(from, error);
  if (!image) return std::nullopt;
  ImageMeans sum;
  const ValueFunction decoded(*image, linear_from_srgb<double>);
  for (size_t i = 0; i < image->count(); ++i) {
    for (int c = 0; c < 4; ++c) {
      const double stored = at(*image, i, c);
      sum.stored[c] += stored;
      if (c < 3) sum.linear[c] += decoded(stored);
    }
  }
  const double count = double(image->count());
  return ImageMeans{sum.linear / count, sum.stored / count};
}

std::optional<glm::dvec3> mean_colour(const ReadableFile& from, bool srgb, std::string& error) {
  const auto means = image_means(from, error);
  if (!means) return std::nullopt;
  return srgb ? means->linear : glm::dvec3(means->stored);
}

}  // namespace kaustik::gltf
