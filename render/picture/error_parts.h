#pragma once
// The error of an image taken apart: what more photons or samples would average away, and what stays. Needs
// several images that differ in their seeds alone.

#include <cstdint>
#include <optional>
#include <vector>

#include "core/math/vec.h"
#include "render/film/film_totals.h"
#include "render/picture/compare.h"

namespace kaustik::render {

// All in units of relMSE: over (R^2 + 0.01), mean over the compared pixels and their three channels.
struct ErrorParts {
  uint64_t images = 0;
  uint64_t compared = 0, masked = 0, not_finite = 0;  // pixels; not finite in the reference or in any image
  double relmse = 0;                                  // mean over the images of compare().relmse
  // With m and s^2 the mean and the sample variance (over n - 1) of a channel over n images: the mean of s^2,
  // and of (m - R)^2 - s^2 / n. Both are unbiased, of the true variance and of the true squared bias plus the
  // squared error of the reference itself, so the second may come out below zero where there is little bias.
  // They add up to relmse. Unset for one image.
  std::optional<double> variance, bias2;
};

// Takes one image after the other; 49 bytes a pixel.
class ErrorPartsSum {
 public:
  // reference must outlive it.
  ErrorPartsSum(const Image& reference, const CompareOptions& options);
  // Throws std::invalid_argument when the size is not the reference's.
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

// The variance of the mean over a render's passes, in units of relMSE against that mean: the noise of a
// reference. Estimated from the spread of the passes, so a little too high where their radii shrink. Nothing
// for one pass.
std::optional<double> relative_noise(const FilmTotals& totals);

}  // namespace kaustik::render
