#pragma once
// Films: the image being rendered, with one float layer for each class of paths plus feature layers. Row 0 at
// the top.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/math/vec.h"
#include "core/memory/memory_pages.h"
#include "core/memory/uninitialised_array.h"
#include "render/film/for_each_pixel.h"

namespace kaustik::render {

// Final values of one pixel: means over its samples.
struct PixelResult {
  Rgb emitted{0}, direct{0}, caustic{0}, indirect{0};  // W/(m^2 sr)
  Rgb albedo{0};
  Vector3 normal{0};  // shading normal of the first hit, world
  float depth = 0;    // distance to the first hit in metres; 0 where the ray escapes
  float photons = 0;  // caustic + indirect + direct photons within reach, per query
  // For denoisers. The part of `emitted` that the first hit does not emit, L S+ E: light seen directly has no
  // noise but that of edges. And albedo, normal and depth of what smooth glass and mirrors show, where a
  // chain of delta lobes ends, weighted by the Fresnel factors where it was split; 0 where it escapes. The
  // depth is the length of the chain.
  Rgb denoising_emitted{0};
  Rgb denoising_albedo{0};
  Vector3 denoising_normal{0};
  float denoising_depth = 0;
  // Errors of radiance(), in W/(m^2 sr): the standard error of its noise (infinite if unknown), and the
  // kernels' bias, positive where they make it too bright (render/film/error_estimate.h). A single sample has
  // only the bias.
  Rgb error{0}, bias{0};
  // The parts of direct, caustic and indirect light that media scatter towards the camera, along its ray and
  // the specular chain behind it.
  Rgb media_direct{0}, media_caustic{0}, media_indirect{0};

  Rgb radiance() const { return emitted + direct + caustic + indirect; }
};

// Which light a sample computes. kTraced is what needs rays only: emission, and direct light by light
// samples. What photon maps contribute to a pixel can be left to its other samples.
enum class SampleLight { kAll, kTraced };
inline constexpr size_t kSampleLights = 2;

// Sums over a pass's samples, in double precision. A sample weighs 1, or -1 where the pixel filter is
// negative.
struct PixelSum {
  glm::dvec3 emitted{0}, direct{0}, caustic{0}, indirect{0}, albedo{0}, normal{0};
  double depth = 0, photons = 0;
  glm::dvec3 denoising_emitted{0}, denoising_albedo{0}, denoising_normal{0};
  double denoising_depth = 0;
  glm::dvec3 bias{0};  // of the pass's first sample only
  uint64_t count = 0;
  uint64_t negative = 0;  // number of samples that weigh -1
  uint64_t traced = 0;    // number of samples of kTraced light; if there are any, `negative` is 0

  int64_t weight() const { return static_cast<int64_t>(count) - 2 * static_cast<int64_t>(negative); }
  void add(const PixelResult& s, int sample_weight = 1, SampleLight light = SampleLight::kAll);
  // The factor that makes sums of what comes from maps those of all samples: kTraced samples left it out.
  double completion() const {
    return traced == 0 || traced == count ? 1 : double(count) / double(count - traced);
  }
  // The sums as if every sample had computed all light.
  PixelSum completed() const;
};

// The layers. To add one, add a member to PixelResult and to PixelSum, an enumerator and a row here, and
// write the value where it arises. Sums, totals, EXR channels and `--aov` follow from the row. Those of media
// (kApart) have no member of PixelSum.
enum class Layer {
  kEmitted,
  kDirect,
  kCaustic,
  kIndirect,
  kBias,
  kAlbedo,
  kNormal,
  kDepth,
  kPhotons,
  kDenoisingEmitted,
  kDenoisingAlbedo,
  kDenoisingNormal,
  kDenoisingDepth,
  kError,
  kMediaDirect,
  kMediaCaustic,
  kMediaIndirect
};

// What the numbers of a layer are; decides the unit of their exact sums (film_totals.h).
enum class LayerUnit { kRadiance, kFeature, kDepth, kCount };

enum class LayerMean {
  kSamples,  // the mean over the samples
  kPasses,   // one value per pass, which the error estimate averages (error_estimate.h)
  kApart,    // the mean over the samples, which are summed apart where media scatter (media_sums.h)
  kNone      // not summed: computed by the error estimate
};

class LayerRow {
 public:
  Layer layer;
  std::string_view name;
  std::string_view channels;  // a letter for each number; the EXR channels are `name.X`
  LayerUnit unit;
  LayerMean mean;
  bool from_maps;  // computed from photon maps, so SampleLight::kTraced leaves it out

  constexpr LayerRow(Layer l, std::string_view n, std::string_view c, LayerUnit u, LayerMean m, bool maps,
                     glm::vec3 PixelResult::*value, glm::dvec3 PixelSum::*sum)
      : layer(l), name(n), channels(c), unit(u), mean(m), from_maps(maps), vector_(value), vector_sum_(sum) {}
  constexpr LayerRow(Layer l, std::string_view n, std::string_view c, LayerUnit u, LayerMean m, bool maps,
                     float PixelResult::*value, double PixelSum::*sum)
      : layer(l), name(n), channels(c), unit(u), mean(m), from_maps(maps), number_(value), number_sum_(sum) {}

  // The layer's numbers in a pixel, channels.size() of them.
  const float* in(const PixelResult& p) const { return vector_ ? &(p.*vector_).x : &(p.*number_); }
  float* in(PixelResult& p) const { return vector_ ? &(p.*vector_).x : &(p.*number_); }
  const double* in(const PixelSum& p) const { return vector_ ? &(p.*vector_sum_).x : &(p.*number_sum_); }
  double* in(PixelSum& p) const { return vector_ ? &(p.*vector_sum_).x : &(p.*number_sum_); }
  // Whether PixelSum and PixelTotals hold it.
  constexpr bool summed() const { return mean == LayerMean::kSamples || mean == LayerMean::kPasses; }

 private:
  glm::vec3 PixelResult::*vector_ = nullptr;
  float PixelResult::*number_ = nullptr;
  glm::dvec3 PixelSum::*vector_sum_ = nullptr;
  double PixelSum::*number_sum_ = nullptr;
};

inline constexpr auto kLayerTable = [] {
  using R = PixelResult;
  using S = PixelSum;
  using enum LayerMean;
  constexpr auto kNoSum = static_cast<glm::dvec3 S::*>(nullptr);
  return std::to_array<LayerRow>({
      {Layer::kEmitted, "emitted", "RGB", LayerUnit::kRadiance, kSamples, false, &R::emitted, &S::emitted},
      {Layer::kDirect, "direct", "RGB", LayerUnit::kRadiance, kSamples, false, &R::direct, &S::direct},
      {Layer::kCaustic, "caustic", "RGB", LayerUnit::kRadiance, kSamples, true, &R::caustic, &S::caustic},
      {Layer::kIndirect, "indirect", "RGB", LayerUnit::kRadiance, kSamples, true, &R::indirect, &S::indirect},
      {Layer::kBias, "bias", "RGB", LayerUnit::kRadiance, kPasses, false, &R::bias, &S::bias},
      {Layer::kAlbedo, "albedo", "RGB", LayerUnit::kFeature, kSamples, false, &R::albedo, &S::albedo},
      {Layer::kNormal, "normal", "XYZ", LayerUnit::kFeature, kSamples, false, &R::normal, &S::normal},
      {Layer::kDepth, "depth", "Z", LayerUnit::kDepth, kSamples, false, &R::depth, &S::depth},
      {Layer::kPhotons, "photons", "Y", LayerUnit::kCount, kSamples, true, &R::photons, &S::photons},
      {Layer::kDenoisingEmitted, "denoising_emitted", "RGB", LayerUnit::kRadiance, kSamples, false,
       &R::denoising_emitted, &S::denoising_emitted},
      {Layer::kDenoisingAlbedo, "denoising_albedo", "RGB", LayerUnit::kFeature, kSamples, false,
       &R::denoising_albedo, &S::denoising_albedo},
      {Layer::kDenoisingNormal, "denoising_normal", "XYZ", LayerUnit::kFeature, kSamples, false,
       &R::denoising_normal, &S::denoising_normal},
      {Layer::kDenoisingDepth, "denoising_depth", "Z", LayerUnit::kDepth, kSamples, false,
       &R::denoising_depth, &S::denoising_depth},
      {Layer::kError, "error", "RGB", LayerUnit::kRadiance, kNone, false, &R::error, kNoSum},
      {Layer::kMediaDirect, "media_direct", "RGB", LayerUnit::kRadiance, kApart, false, &R::media_direct,
       kNoSum},
      {Layer::kMediaCaustic, "media_caustic", "RGB", LayerUnit::kRadiance, kApart, true, &R::media_caustic,
       kNoSum},
      {Layer::kMediaIndirect, "media_indirect", "RGB", LayerUnit::kRadiance, kApart, true, &R::media_indirect,
       kNoSum},
  });
}();
static_assert(
    [] {
      for (size_t i = 0; i < kLayerTable.size(); ++i)
        if (kLayerTable[i].layer != Layer(i)) return false;
      return true;
    }(),
    "the rows are in the order of the enumerators");
inline constexpr int kLayers = int(kLayerTable.size());
inline constexpr auto kLayerNames = [] {
  std::array<std::string_view, kLayerTable.size()> names{};
  for (size_t i = 0; i < names.size(); ++i) names[i] = kLayerTable[i].name;
  return names;
}();

// Calls fn(row, i, c) for channel c of each layer that includes(row); i counts the channels of all.
template <class Includes, class Fn>
constexpr void for_each_channel(const Includes& includes, const Fn& fn) {
  size_t i = 0;
  for (const LayerRow& row : kLayerTable)
    for (size_t c = 0; includes(row) && c < row.channels.size(); ++c) fn(row, i++, c);
}

inline void PixelSum::add(const PixelResult& s, int sample_weight, SampleLight light) {
  for (const LayerRow& row : kLayerTable) {
    if (!row.summed()) continue;
    const double w = row.mean == LayerMean::kPasses ? 1 : sample_weight;
    double* const sum = row.in(*this);
    const float* const value = row.in(s);
    for (size_t c = 0; c < row.channels.size(); ++c) sum[c] += w * double(value[c]);
  }
  ++count;
  negative += sample_weight < 0;
  traced += light == SampleLight::kTraced;
}

inline PixelSum PixelSum::completed() const {
  PixelSum result = *this;
  const double all = completion();
  if (all == 1) return result;
  for (const LayerRow& row : kLayerTable) {
    if (!row.from_maps || !row.summed()) continue;
    double* const sum = row.in(result);
    for (size_t c = 0; c < row.channels.size(); ++c) sum[c] *= all;
  }
  result.traced = 0;
  return result;
}

// A window of width x height pixels whose upper left corner is pixel (x0, y0) of an image of full_width x
// full_height pixels. at(x, y) counts from the window's corner.
template <class Pixel>
class PixelWindow {
 public:
  PixelWindow() = default;
  PixelWindow(int width, int height) : PixelWindow(width, height, 0, 0, width, height) {}
  PixelWindow(int width, int height, int x0, int y0, int full_width, int full_height)
      : width_(width),
        height_(height),
        x0_(x0),
        y0_(y0),
        full_width_(full_width),
        full_height_(full_height),
        pixels_(size_t(width) * size_t(height)) {
    prefer_large_pages(pixels_.data(), pixels_.size() * sizeof(Pixel));
    clear();
  }
  int width() const { return width_; }
  int height() const { return height_; }
  int x0() const { return x0_; }
  int y0() const { return y0_; }
  int full_width() const { return full_width_; }
  int full_height() const { return full_height_; }
  Pixel& at(int x, int y) { return pixels_[size_t(y) * size_t(width_) + size_t(x)]; }
  const Pixel& at(int x, int y) const { return pixels_[size_t(y) * size_t(width_) + size_t(x)]; }
  // All pixels as they lie in memory, rows from the top.
  std::span<Pixel> all() { return pixels_; }
  std::span<const Pixel> all() const { return pixels_; }
  // Done in parallel, since a large film touches many pages.
  void clear() {
    for_each_pixel(width_, height_, [&](int x, int y) { at(x, y) = Pixel{}; });
  }

 private:
  int width_ = 0, height_ = 0;
  int x0_ = 0, y0_ = 0, full_width_ = 0, full_height_ = 0;
  std::vector<Pixel, UninitialisedAllocator<Pixel>> pixels_;
};
// A window of the same position and size, with pixels of another type.
template <class Pixel, class Other>
PixelWindow<Pixel> window_of(const PixelWindow<Other>& like) {
  return {like.width(), like.height(), like.x0(), like.y0(), like.full_width(), like.full_height()};
}

using Film = PixelWindow<PixelResult>;
using FilmSums = PixelWindow<PixelSum>;

}  // namespace kaustik::render
