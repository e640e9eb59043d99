#pragma once
// The layers of what media scatter along camera rays. They are summed apart, where a scene's media scatter,
// so that the films of other scenes are not larger for them.

#include <array>

#include "render/film/exact_sum.h"
#include "render/film/film.h"

namespace kaustik::render {

constexpr bool is_of_media(const LayerRow& row) {
  return row.mean == LayerMean::kApart;
}
constexpr bool is_media_layer(Layer layer) {
  return is_of_media(kLayerTable[size_t(layer)]);
}

// Calls fn(row, i, c) for channel c of each of these layers; i counts the channels of all.
template <class Fn>
constexpr void for_each_media_channel(const Fn& fn) {
  for_each_channel(is_of_media, fn);
}
inline constexpr size_t kMediaChannels = [] {
  size_t channels = 0;
  for_each_media_channel([&](const LayerRow&, size_t, size_t) { ++channels; });
  return channels;
}();

// Sums over a pass's samples, as PixelSum, which counts them.
struct MediaSum {
  std::array<double, kMediaChannels> sums{};

  void add(const PixelResult& s, int sample_weight) {
    for_each_media_channel(
        [&](const LayerRow& row, size_t i, size_t c) { sums[i] += sample_weight * double(row.in(s)[c]); });
  }
};
using MediaSums = PixelWindow<MediaSum>;

// Exact sums over passes, as PixelTotals, as if every sample had computed all light.
struct MediaTotals {
  std::array<ExactSum, kMediaChannels> sums;

  MediaTotals& operator+=(const MediaTotals& other) {
    for (size_t i = 0; i < kMediaChannels; ++i) sums[i] += other.sums[i];
    return *this;
  }
  bool operator==(const MediaTotals&) const = default;
};

}  // namespace kaustik::render
