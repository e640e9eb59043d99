#include "render/denoise/noisy_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string_view>

#include "core/math/hash.h"
#include "render/denoise/plane.h"

namespace kaustik::render {

namespace {

using Channel = const std::vector<float>*;  // null: the file does not have it

// Sets channel c of `values`, for each pixel, by set(x, y, value).
template <class Set>
void for_each_value(const Film& film, Channel channel, const Set& set) {
  for_each_pixel(film.width(), film.height(),
                 [&](int x, int y) { set(x, y, (*channel)[size_t(y) * size_t(film.width()) + size_t(x)]); });
}

Channel find(const ExrChannels& file, std::string_view layer, char letter) {
  return file.find(fmt::format("{}.{}", layer, letter));
}

// Files with the halves of our own samples.
bool has_halves(const ExrChannels& file) {
  bool all = true;
  for (const std::string_view half : kHalfNames) {
    all &= find(file, fmt::format("{}.share", half), 'Y') != nullptr;
    for_each_half_channel([&](const LayerRow& row, size_t, size_t c) {
      all &= find(file, fmt::format("{}.{}", half, row.name), row.channels[c]) != nullptr;
    });
  }
  for (const LayerRow& row : kLayerTable)
    for (const char letter : row.channels)
      if (row.unit == LayerUnit::kRadiance && row.mean == LayerMean::kSamples)
        all &= find(file, row.name, letter) != nullptr;
  return all;
}

void read_halves(const ExrChannels& file, NoisyPicture* picture) {
  for (const LayerRow& row : kLayerTable)
    for (size_t c = 0; c < row.channels.size(); ++c)
      if (const Channel channel = find(file, row.name, row.channels[c]))
        for_each_value(picture->film, channel,
                       [&](int x, int y, float v) { row.in(picture->film.at(x, y))[c] = v; });
  for (size_t h = 0; h < kHalfNames.size(); ++h) {
    for_each_value(picture->film, find(file, fmt::format("{}.share", kHalfNames[h]), 'Y'),
                   [&](int x, int y, float v) { picture->halves.at(x, y).share[h] = v; });
    for_each_half_channel([&](const LayerRow& row, size_t i, size_t c) {
      for_each_value(picture->film,
                     find(file, fmt::format("{}.{}", kHalfNames[h], row.name), row.channels[c]),
                     [&](int x, int y, float v) { picture->halves.at(x, y).mean[h][i] = v; });
    });
  }
}

// A feature, and the layers that may hold it, the best first.
struct Feature {
  Layer layer;
  std::string_view name, letters;
  std::vector<std::string_view> layers;
};
const std::vector<Feature>& features_of_others() {
  static const std::vector<Feature> features = {
      {Layer::kDenoisingAlbedo,
       "albedo",
       "RGB",
       {"denoising_albedo", "Denoising Albedo", "Albedo", "albedo"}},
      {Layer::kDenoisingNormal,
       "normal",
       "XYZ",
       {"denoising_normal", "Denoising Normal", "Ns", "nn", "sh_normal", "Normal", "normal", "N"}},
      {Layer::kDenoisingDepth, "depth", "Z", {"denoising_depth", "Denoising Depth", "Depth", "depth", "P"}}};
  return features;
}

// The channels of a layer, by its name or that with another before it, such as a view layer's.
std::vector<Channel> channels_of(const ExrChannels& file, std::string_view layer, std::string_view letters) {
  std::vector<Channel> channels;
  for (const char letter : letters) {
    const std::string name = layer.empty() ? std::string(1, letter) : fmt::format("{}.{}", layer, letter);
    const auto found = std::find_if(file.names.begin(), file.names.end(), [&](const std::string& other) {
      return other == name || (!layer.empty() && other.ends_with("." + name));
    });
    if (found == file.names.end()) return {};
    channels.push_back(&file.values[size_t(found - file.names.begin())]);
  }
  return channels;
}

std::vector<Channel> first_of(const ExrChannels& file, std::span<const std::string_view> layers,
                              std::string_view letters) {
  for (const std::string_view layer : layers)
    if (std::vector<Channel> channels = channels_of(file, layer, letters); !channels.empty()) return channels;
  return {};
}

// Sets a channel of both halves.
void set_both(Channel channel, size_t to, NoisyPicture* picture) {
  for_each_value(picture->film, channel, [&](int x, int y, float v) {
    // Where nothing is seen, other renderers write an infinite depth.
    const bool far = to == half_of(Layer::kDenoisingDepth) && !std::isfinite(v);
    for (auto& mean : picture->halves.at(x, y).mean) mean[to] = far ? 1e30f : v;
  });
}

void read_features(const ExrChannels& file, NoisyPicture* picture) {
  for (const Feature& feature : features_of_others()) {
    const std::vector<Channel> channels = first_of(file, feature.layers, feature.letters);
    if (channels.empty()) picture->missing.emplace_back(feature.name);
    for (size_t c = 0; c < channels.size(); ++c) set_both(channels[c], half_of(feature.layer) + c, picture);
  }
}

// Estimated standard deviation of a plane's noise.
Plane noise_of(const Plane& values) {
  constexpr int kAround = 3;
  const int width = values.width(), height = values.height();
  const Plane difference = plane_of(width, height, [&](int x, int y) {
    float sum = 0;
    for (int v = -1; v <= 1; ++v)
      for (int u = -1; u <= 1; ++u) {
        const int weight = (u == 0 ? -2 : 1) * (v == 0 ? -2 : 1);
        sum += float(weight) * values.at(std::clamp(x + u, 0, width - 1), std::clamp(y + v, 0, height - 1));
      }
    return std::abs(sum);
  });
  constexpr float kGain = 6;              // standard deviation of `sum` for noise of standard deviation 1
  constexpr float kOfMedian = 1.482602f;  // standard deviation over median of magnitudes, normal distribution
  return plane_of(width, height, [&](int x, int y) {
    std::array<float, (2 * kAround + 1) * (2 * kAround + 1)> around{};
    size_t count = 0;
    for (int v = std::max(y - kAround, 0); v <= std::min(y + kAround, height - 1); ++v)
      for (int u = std::max(x - kAround, 0); u <= std::min(x + kAround, width - 1); ++u)
        if (std::isfinite(difference.at(u, v))) around[count++] = difference.at(u, v);
    if (count == 0) return 0.0f;
    const auto middle = around.begin() + std::ptrdiff_t(count / 2);
    std::nth_element(around.begin(), middle, around.begin() + std::ptrdiff_t(count));
    return kOfMedian / kGain * *middle;
  });
}

// The picture as one class of light, in two halves that differ by its estimated noise.
void read_colours(const std::vector<Channel>& colours, NoisyPicture* picture) {
  const bool albedo =
      std::find(picture->missing.begin(), picture->missing.end(), "albedo") == picture->missing.end();
  const Layer layer = albedo ? Layer::kDirect : Layer::kDenoisingEmitted;
  for (size_t c = 0; c < 3; ++c) {
    Plane values(picture->film.width(), picture->film.height());
    for_each_value(picture->film, colours[c], [&](int x, int y, float v) { values.at(x, y) = v; });
    const Plane noise = noise_of(values);
    for_each_pixel(values.width(), values.height(), [&](int x, int y) {
      const uint64_t key = (uint64_t(y) * uint64_t(values.width()) + uint64_t(x)) * 3 + c;
      const float step = mix64(key + 1) & 1 ? noise.at(x, y) : -noise.at(x, y), value = values.at(x, y);
      HalfMeans& pixel = picture->halves.at(x, y);
      pixel.mean[0][half_of(layer) + c] = value + step;
      pixel.mean[1][half_of(layer) + c] = value - step;
      picture->film.at(x, y).direct[int(c)] = value;
      pixel.share = {0.5f, 0.5f};
    });
  }
}

// Pixels that are not finite are left out: they would spoil all windows that they are in.
void leave_out_unknown(NoisyPicture* picture) {
  for_each_pixel(picture->film.width(), picture->film.height(), [&](int x, int y) {
    HalfMeans& pixel = picture->halves.at(x, y);
    bool finite = is_finite(picture->film.at(x, y).radiance());
    for (const auto& half : pixel.mean)
      for (const float v : half) finite &= std::isfinite(v);
    for (const float share : pixel.share) finite &= share > 0 && share < 1;
    if (!finite) pixel = {};
  });
}

}  // namespace

NoisyPicture noisy_picture(const ExrChannels& file) {
  constexpr std::array<std::string_view, 4> kColours = {"noisy", "Noisy Image", "", "Combined"};
  const bool measured = has_halves(file);
  const std::vector<Channel> colours = first_of(file, kColours, "RGB");
  if (!measured && colours.empty()) throw std::runtime_error("it has no channels R, G and B");
  NoisyPicture picture{Film(file.width, file.height, 0, 0, file.width, file.height),
                       HalfFilm(file.width, file.height, 0, 0, file.width, file.height),
                       measured,
                       {}};
  if (measured) {
    read_halves(file, &picture);
  } else {
    read_features(file, &picture);
    read_colours(colours, &picture);
  }
  leave_out_unknown(&picture);
  return picture;
}

}  // namespace kaustik::render
