#pragma once
// Exact sums of the films of any number of passes, including what error estimates need.

#include <array>
#include <cstdint>

#include "core/scene/scene.h"
#include "render/film/exact_sum.h"
#include "render/film/film.h"
#include "render/film/halves.h"
#include "render/film/media_sums.h"

namespace kaustik::render {

// Units of a pixel's sums, as exponents of two.
struct ExactUnits {
  int radiance = 0;                     // W/(m^2 sr), summed over samples
  int square = 0;                       // for squares of a pass's mean radiance
  int depth = 0;                        // metres, summed over samples
  static constexpr int kFeature = -60;  // albedo and normal: at most 1 in each of at most 2^31 samples
  static constexpr int kPhotons = 0;    // integers
  bool operator==(const ExactUnits&) const = default;
};

// Chooses the units from the scene's size and the radiance of lights and media (for point-like lights, as
// seen from a thousandth of the scene's size), so that a scene scaled by a power of two gives the same
// multiples. Before it is clamped, a pass's sum of radiance may reach 2^20 times that of samples that all see
// the brightest light, and its mean 2^10 times that light's radiance. The units lie 2^75 below that light; so
// do those of squares below its square.
ExactUnits choose_units(const Scene& scene, uint64_t samples_per_pass);

// The totals hold the sums of the layers that are summed, one after the other. Where a layer's begin:
constexpr size_t sum_of(Layer layer) {
  size_t sum = 0;
  for (const LayerRow& row : kLayerTable)
    if (row.layer < layer && row.summed()) sum += row.channels.size();
  return sum;
}
inline constexpr size_t kSumChannels = sum_of(Layer(kLayers));

struct PixelTotals {
  // Summed over samples, except for bias, which each pass measures once.
  std::array<ExactSum, kSumChannels> sums;
  // Summed over passes: squares of the pass's mean R, G and B, and of its bias.
  std::array<ExactSum, 3> squares, bias_squares;
  int64_t weight = 0;   // of the valid samples: 1 each, or -1 where the pixel filter is negative
  uint64_t passes = 0;  // passes with a valid sample
  bool operator==(const PixelTotals&) const = default;
};

// The units as numbers.
struct PixelUnits {
  std::array<double, kSumChannels> sums;
  double square;
  explicit PixelUnits(const ExactUnits& units);
};

// Exact sums of all pixels, with their units.
class FilmTotals {
 public:
  FilmTotals() = default;
  // zero: a window of empty totals.
  FilmTotals(PixelWindow<PixelTotals> zero, const ExactUnits& units)
      : units_(units), pixels_(std::move(zero)) {}

  // Sets all sums to zero.
  void clear() { pixels_.clear(), halves_.clear(), media_.clear(); }
  // Keeps the sums of one half from now on; before the first pass.
  void keep_halves();
  bool has_halves() const { return halves_.width() > 0; }
  // Keeps what media scatter from now on; before the first pass.
  void keep_media();
  bool has_media() const { return media_.width() > 0; }

  // Adds one pass. half: the sums of the half of its samples that is summed apart, or null if that is none;
  // not read without halves. media: what media scatter; must not be null if that is kept. Returns how many
  // sums were clamped or NaN.
  uint64_t add(const FilmSums& pass, const HalfSums* half = nullptr, const MediaSums* media = nullptr);
  // Adds a pass whose samples all belong to that half.
  uint64_t add_as_half(const FilmSums& pass, const MediaSums* media = nullptr);
  // Adds other passes. Throws std::invalid_argument if the window or the units differ, or if only one keeps
  // halves or what media scatter.
  void add(const FilmTotals& other);
  // Weighted means over samples; black where there are no samples or their weights cancel.
  Film mean() const;
  // Means of both halves. Requires has_halves().
  HalfFilm halves() const;

  const ExactUnits& units() const { return units_; }
  const PixelWindow<PixelTotals>& pixels() const { return pixels_; }
  PixelWindow<PixelTotals>& pixels() { return pixels_; }
  const PixelWindow<HalfTotals>& half_pixels() const { return halves_; }
  PixelWindow<HalfTotals>& half_pixels() { return halves_; }
  const PixelWindow<MediaTotals>& media_pixels() const { return media_; }
  PixelWindow<MediaTotals>& media_pixels() { return media_; }

 private:
  // half_of(x, y, all samples): the HalfSum of the pass in a pixel.
  template <class HalfOf>
  uint64_t add_pass(const FilmSums& pass, const MediaSums* media, const HalfOf& half_of);

  ExactUnits units_;
  PixelWindow<PixelTotals> pixels_;
  PixelWindow<HalfTotals> halves_;  // empty if they are not kept
  PixelWindow<MediaTotals> media_;  // likewise
};

// The mean of a single pass, equal to that of totals which hold only this pass. Adds the number of clamped
// sums to *clamped. media: what media scatter, or null.
Film mean_of(const FilmSums& pass, const ExactUnits& units, uint64_t* clamped,
             const MediaSums* media = nullptr);
// The halves of a single pass, likewise.
HalfFilm halves_of(const FilmSums& pass, const HalfSums& half, const ExactUnits& units);

}  // namespace kaustik::render
