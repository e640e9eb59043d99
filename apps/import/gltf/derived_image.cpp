#include "apps/import/gltf/derived_image.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace kaustik::gltf {
namespace {

constexpr uint64_t kMostPixels = uint64_t{1} << 28;

struct Pixels {
  int width = 0, height = 0, channels = 0;
  std::vector<float> values;

  size_t count() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
  // Grey images have their one channel as red, green and blue, and alpha last.
  double at(size_t pixel, int channel) const {
    const bool grey = channels < 3;
    if (channel == 3 && channels != 2 && channels != 4) return 1;
    const int c = channel == 3 ? channels - 1 : grey ? 0 : channel;
    return double(values[pixel * static_cast<size_t>(channels) + static_cast<size_t>(c)]);
  }
};

std::optional<Pixels> read(const std::filesystem::path& path, std::string& error) {
  const auto in = OIIO::ImageInput::open(path.string());
  if (!in) {
    error = fmt::format("cannot read \"{}\": {}", path.string(), OIIO::geterror());
    return std::nullopt;
  }
  const OIIO::ImageSpec& spec = in->spec();
  const uint64_t pixels = uint64_t(std::max(spec.width, 0)) * uint64_t(std::max(spec.height, 0));
  if (pixels == 0 || pixels > kMostPixels || spec.nchannels < 1 || spec.nchannels > 4) {
    error = fmt::format("cannot read \"{}\": {} x {} pixels of {} channels", path.string(), spec.width,
                        spec.height, spec.nchannels);
    return std::nullopt;
  }
  Pixels out{spec.width, spec.height, spec.nchannels, {}};
  out.values.resize(out.count() * static_cast<size_t>(out.channels));
  if (!in->read_image(0, 0, 0, out.channels, OIIO::TypeDesc::FLOAT, out.values.data())) {
    error = fmt::format("cannot read \"{}\": {}", path.string(), in->geterror());
    return std::nullopt;
  }
  return out;
}

std::optional<std::string> write(const std::filesystem::path& path, const Pixels& image,
                                 OIIO::TypeDesc type) {
  const auto out = OIIO::ImageOutput::create(path.string());
  const OIIO::ImageSpec spec(image.width, image.height, image.channels, type);
  if (out && out->open(path.string(), spec) && out->write_image(OIIO::TypeDesc::FLOAT, image.values.data()) &&
      out->close())
    return std::nullopt;
  return fmt::format("cannot write \"{}\": {}", path.string(), out ? out->geterror() : OIIO::geterror());
}

double linear(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}
double encoded(double v) {
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

}  // namespace

std::optional<std::string> write_tinted(const std::filesystem::path& from, const std::filesystem::path& to,
                                        const glm::dvec3& factor) {
  std::string error;
  const auto image = read(from, error);
  if (!image) return error;
  Pixels out{image->width, image->height, 3, {}};
  for (size_t i = 0; i < image->count(); ++i) {
    for (int c = 0; c < 3; ++c)
      out.values.push_back(static_cast<float>(encoded(factor[c] * linear(image->at(i, c)))));
  }
  return write(to, out, OIIO::TypeDesc::UINT8);
}

std::optional<std::string> write_channel(const std::filesystem::path& from, const std::filesystem::path& to,
                                         int channel, const std::function<double(double)>& map) {
  std::string error;
  const auto image = read(from, error);
  if (!image) return error;
  Pixels out{image->width, image->height, 1, {}};
  for (size_t i = 0; i < image->count(); ++i)
    out.values.push_back(static_cast<float>(std::clamp(map(image->at(i, channel)), 0.0, 1.0)));
  return write(to, out, OIIO::TypeDesc::UINT16);
}

std::optional<glm::dvec3> mean_colour(const std::filesystem::path& from, bool srgb, std::string& error) {
  const auto image = read(from, error);
  if (!image) return std::nullopt;
  glm::dvec3 sum(0);
  for (size_t i = 0; i < image->count(); ++i) {
    for (int c = 0; c < 3; ++c) sum[c] += srgb ? linear(image->at(i, c)) : image->at(i, c);
  }
  return sum / double(image->count());
}

}  // namespace kaustik::gltf
