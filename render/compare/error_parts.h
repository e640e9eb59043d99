#pragma once
// Splits the error of an image into variance, which more photons or samples would average out, and bias.
// Needs several images that differ only in their seeds.

#include <cstdint>
#include <optional>
#include <vector>

#include "core/math/vec.h"
#include "render/compare/compare.h"
#include "render/film/film_totals.h"

namespace kaustik::render {

// All errors in units of relMSE: divided by (R^2 + 0.01), averaged over the compared pixels and their three
// channels.
struct ErrorParts {
  uint64_t images = 0;
  uint64_t compared = 0, masked = 0, not_finite = 0;  // pixels; not_finite: in the reference or in any image
  double relmse = 0;                                  // mean of compare().relmse over the images
  // Let m and s^2 be the mean and the sample variance (over n - 1) of a channel over n images. `variance` is
  // the mean of s^2, `bias2` that of (m - R)^2 - s^2 / n. The first is an unbiased estimate of the true
  // variance, the second of the true squared bias plus the squared error of the reference itself; it may be
  // negative where there is little bias. They add up to relmse. Unset for
  // one image.
  std::optional<double> variance, bias2;
};

// Accumulates images one after the other; takes 49 bytes per pixel.
class ErrorPartsSum {
 public:
  // reference must outlive it.
  ErrorPartsSum(const Image& reference, const CompareOptions& options);
  // Throws std::invalid_argument when the size differs from the reference's.
  void add(const Image& image);
  // At least one image must have been added.
  ErrorParts parts() const;

 private:
  struct Moments {
    glm::dvec3 mean{0}, squares{0};  // squares: sum of (I - mean)^2 (Welford 1962)
  };
  const Image& reference_;
  std::vector<bool> masked_, finite_;
  std::vector<Moments> moments_;
  uint64_t images_ = 0;
};

// Noise of a reference: the variance of the mean over a render's passes, in units of relMSE against that
// mean. Estimated from the spread of the passes, so slightly too high where their radii shrink. Nothing for
// one pass.
std::optional<double> relative_noise(const FilmTotals& totals);

}  // namespace kaustik::render
