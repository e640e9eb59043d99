#pragma once
// The exact sum of the films of any number of passes, and what of them an error estimate needs.

#include <array>
#include <cstdint>

#include "core/scene/scene.h"
#include "render/film/exact_sum.h"
#include "render/film/film.h"

namespace kaustik::render {

// The units of a pixel's sums, as exponents of two.
struct ExactUnits {
  int radiance = 0;                     // W/(m^2 sr), over samples
  int square = 0;                       // of the square of a pass's mean radiance
  int depth = 0;                        // metres, over samples
  static constexpr int kFeature = -60;  // albedo, normal: at most 1 each, of at most 2^31 samples
  static constexpr int kPhotons = 0;    // whole numbers
  bool operator==(const ExactUnits&) const = default;
};

// From the lights' radiance (as seen from a thousandth of the scene's size, for those that are points) and
// the scene's size: a scene scaled by a power of two gives the same multiples. A pass's sum of radiance may
// be 2^20 times that of samples that all see the brightest light, and its mean 2^10 times that light's
// radiance, before it is clamped; the units lie 2^75 below the light, also those of squares.
ExactUnits choose_units(const Scene& scene, uint64_t samples_per_pass);

// Where in a pixel's sums the three channels of each begin; depth and photons have one.
enum SumChannel : size_t {
  kEmittedSum = 0,
  kDirectSum = 3,
  kCausticSum = 6,
  kIndirectSum = 9,
  kBiasSum = 12,
  kAlbedoSum = 15,
  kNormalSum = 18,
  kDepthSum = 21,
  kPhotonsSum = 22,
  kSumChannels = 23
};

struct PixelTotals {
  // Over samples, but for bias, of which each pass has one.
  std::array<ExactSum, kSumChannels> sums;
  // Over passes, of the pass's mean R, G and B; of its bias.
  std::array<ExactSum, 3> squares, bias_squares;
  int64_t weight = 0;   // of the valid samples: 1 each, or -1 where the pixel filter is negative
  uint64_t passes = 0;  // that had a valid sample
  bool operator==(const PixelTotals&) const = default;
};

// Units as numbers.
struct PixelUnits {
  std::array<double, kSumChannels> sums;
  double square;
  explicit PixelUnits(const ExactUnits& units);
};

// Values and multiples of the units.
class FilmTotals {
 public:
  FilmTotals() = default;
  // zero: the window.
  FilmTotals(PixelWindow<PixelTotals> zero, const ExactUnits& units)
      : units_(units), pixels_(std::move(zero)) {}

  // Adds one pass. Returns how many sums were clamped or NaN.
  uint64_t add(const FilmSums& pass);
  // Adds other passes of the same window in the same units; std::invalid_argument otherwise.
  void add(const FilmTotals& other);
  // Weighted means over samples; black where there are none, or where their weights cancel.
  Film mean() const;

  const ExactUnits& units() const { return units_; }
  const PixelWindow<PixelTotals>& pixels() const { return pixels_; }
  PixelWindow<PixelTotals>& pixels() { return pixels_; }

 private:
  ExactUnits units_;
  PixelWindow<PixelTotals> pixels_;
};

// The mean that totals of one pass alone have, without them. clamped: is added to.
Film mean_of(const FilmSums& pass, const ExactUnits& units, uint64_t* clamped);

}  // namespace kaustik::render
