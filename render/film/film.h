#pragma once
// Films: the image being rendered, with one float layer for each class of paths plus feature layers. Row 0 at
// the top.

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/math/vec.h"
#include "core/memory/memory_pages.h"
#include "core/memory/uninitialised_array.h"
#include "render/film/for_each_pixel.h"

namespace kaustik::render {

enum class Layer {
  kEmitted,
  kDirect,
  kCaustic,
  kIndirect,
  kAlbedo,
  kNormal,
  kDepth,
  kPhotons,
  kError,
  kBias
};
inline constexpr int kLayers = 10;
inline constexpr std::array<std::string_view, kLayers> kLayerNames = {
    "emitted", "direct", "caustic", "indirect", "albedo", "normal", "depth", "photons", "error", "bias"};
inline constexpr std::array<int, kLayers> kLayerChannels = {3, 3, 3, 3, 3, 3, 1, 1, 3, 3};

// Final values of one pixel: means over its samples.
struct PixelResult {
  Rgb emitted{0}, direct{0}, caustic{0}, indirect{0};  // W/(m^2 sr)
  Rgb albedo{0};
  Vector3 normal{0};  // shading normal of the first hit, world
  float depth = 0;    // distance to the first hit in metres; 0 where the ray escapes
  float photons = 0;  // caustic + indirect + direct photons within reach, per query
  // Errors of radiance(), in W/(m^2 sr): the standard error of its noise (infinite if unknown), and the
  // kernels' bias, positive where they make it too bright (render/film/error_estimate.h). A single sample has
  // only the bias.
  Rgb error{0}, bias{0};

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
  glm::dvec3 bias{0};  // of the pass's first sample only
  uint64_t count = 0;
  uint64_t negative = 0;  // number of samples that weigh -1
  uint64_t traced = 0;    // number of samples of kTraced light; if there are any, `negative` is 0

  int64_t weight() const { return static_cast<int64_t>(count) - 2 * static_cast<int64_t>(negative); }
  void add(const PixelResult& s, int sample_weight = 1, SampleLight light = SampleLight::kAll) {
    const double w = sample_weight;
    const auto add3 = [w](glm::dvec3& sum, const glm::vec3& v) { sum += w * glm::dvec3(v); };
    add3(emitted, s.emitted), add3(direct, s.direct), add3(caustic, s.caustic), add3(indirect, s.indirect);
    add3(albedo, s.albedo), add3(normal, s.normal);
    depth += w * double(s.depth), photons += w * double(s.photons);
    bias += s.bias;
    ++count;
    negative += sample_weight < 0;
    traced += light == SampleLight::kTraced;
  }
  // The sums as if every sample had computed all light: what kTraced samples left out is extrapolated from
  // the others.
  PixelSum completed() const {
    PixelSum sum = *this;
    if (traced == 0 || traced == count) return sum;
    const double all = double(count) / double(count - traced);
    sum.caustic *= all, sum.indirect *= all, sum.photons *= all;
    sum.traced = 0;
    return sum;
  }
};

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
    photon::prefer_large_pages(pixels_.data(), pixels_.size() * sizeof(Pixel));
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
  // Done in parallel, since a large film touches many pages.
  void clear() {
    for_each_pixel(width_, height_, [&](int x, int y) { at(x, y) = Pixel{}; });
  }

 private:
  int width_ = 0, height_ = 0;
  int x0_ = 0, y0_ = 0, full_width_ = 0, full_height_ = 0;
  std::vector<Pixel, photon::UninitialisedAllocator<Pixel>> pixels_;
};
// A window of the same position and size, with pixels of another type.
template <class Pixel, class Other>
PixelWindow<Pixel> window_of(const PixelWindow<Other>& like) {
  return {like.width(), like.height(), like.x0(), like.y0(), like.full_width(), like.full_height()};
}

using Film = PixelWindow<PixelResult>;
using FilmSums = PixelWindow<PixelSum>;

}  // namespace kaustik::render
