#pragma once
// The samples of each pixel in two halves, of which one is summed apart. Denoisers learn the noise from what
// two independent halves differ by, and check a filter of one half by the other.
//
// Several planned passes are halved by passes, so that the halves share no photons. A single pass is
// halved by samples; its halves share the photons, and their difference is the noise of camera samples alone.

#include <array>
#include <cstdint>

#include "render/film/exact_sum.h"
#include "render/film/film.h"

namespace kaustik::render {

// The layers that are halved.
constexpr bool in_halves(const LayerRow& row) {
  switch (row.layer) {
    case Layer::kDirect:
    case Layer::kCaustic:
    case Layer::kIndirect:
    case Layer::kDenoisingEmitted:
    case Layer::kDenoisingAlbedo:
    case Layer::kDenoisingNormal:
    case Layer::kDenoisingDepth:
      return true;
    default:
      return false;
  }
}
// The halves hold the numbers of these layers, one after the other. Where a layer's begin:
constexpr size_t half_of(Layer layer) {
  size_t channel = 0;
  for (const LayerRow& row : kLayerTable)
    if (row.layer < layer && in_halves(row)) channel += row.channels.size();
  return channel;
}
inline constexpr size_t kHalfChannels = half_of(Layer(kLayers));

// Calls fn(row, i, c) for channel c of each layer that is halved; i counts the channels of all.
template <class Fn>
void for_each_half_channel(const Fn& fn) {
  for_each_channel(in_halves, fn);
}

// Whether sample `index` of a pass belongs to the half that is summed apart. samples: how many each pixel
// takes before adaptive ones. Up to four samples in a row stay together: every aligned block of 2^k is
// stratified (core/sampling/sampler.h), so that the halves' noise is nearly independent, while that of even
// and odd samples would be opposite.
constexpr bool in_half(uint64_t index, uint64_t samples) {
  const int block = samples >= 8 ? 2 : samples >= 4 ? 1 : 0;
  return (index >> block) & 1;
}

// Whether pass `pass` belongs to that half. samples: of each pixel in a pass. Passes of few samples stay
// together for the same reason. shares: how many passes are planned; with two or more, both halves hold some.
constexpr bool pass_in_half(uint64_t pass, uint64_t shares, uint64_t samples) {
  int block = samples >= 4 ? 0 : samples >= 2 ? 1 : 2;
  while (block > 0 && shares < (uint64_t{2} << block)) --block;
  return (pass >> block) & 1;
}

// Sums over the samples of one half, as PixelSum.
struct HalfSum {
  std::array<double, kHalfChannels> sums{};
  int64_t weight = 0;       // of all samples
  int64_t maps_weight = 0;  // of those that computed what photon maps contribute

  void add(const PixelResult& s, int sample_weight, SampleLight light) {
    for_each_half_channel(
        [&](const LayerRow& row, size_t i, size_t c) { sums[i] += sample_weight * double(row.in(s)[c]); });
    weight += sample_weight;
    maps_weight += light == SampleLight::kAll ? sample_weight : 0;
  }
};
using HalfSums = PixelWindow<HalfSum>;

// How many of the halves' channels come from photon maps.
inline constexpr size_t kHalfMapChannels = [] {
  size_t channels = 0;
  for (const LayerRow& row : kLayerTable)
    if (in_halves(row) && row.from_maps) channels += row.channels.size();
  return channels;
}();

// Exact sums of the half of all passes that is summed apart, as if every sample had computed all light. Those
// of the other half are the sums of all samples less these, except for what comes from maps: samples that
// left it out are made up for in each half by its own samples, and in all by all.
struct HalfTotals {
  std::array<ExactSum, kHalfChannels> sums;
  std::array<ExactSum, kHalfMapChannels> other_maps;  // of the other half
  int64_t weight = 0;
  int64_t unused = 0;  // no padding, since partial results hold the bytes of these totals

  bool operator==(const HalfTotals&) const = default;
};

inline constexpr std::array<std::string_view, 2> kHalfNames = {"half_a", "half_b"};

// Means over the samples of either half.
struct HalfMeans {
  std::array<std::array<float, kHalfChannels>, 2> mean{};
  // The share of each in the weight of all samples; 0 where there are none, or their weights cancel.
  std::array<float, 2> share{};

  // The mean over all samples.
  float of_all(size_t channel) const { return share[0] * mean[0][channel] + share[1] * mean[1][channel]; }
};
using HalfFilm = PixelWindow<HalfMeans>;

}  // namespace kaustik::render
