#pragma once
// How far a picture of several passes is from the truth, judged by its passes alone.
//
// Noise: passes are independent renders, so the spread of their means gives the standard error of the mean
// over all. (Their camera samples are stratified against each other, which makes it a little too large.)
// Bias: that of the photon maps' kernels, measured by reading each map at half the radius as well
// (photon/estimate/radiance_estimate.h). What is measured is noisy. So it is averaged over 3 x 3 pixels, and
// of its square the noise's is subtracted: where the noise explains it all, nothing is left.
//
// A pixel's channel is within confidence_factor() sqrt(error^2 + bias^2) of the truth with a probability of
// 90 %. Not seen: what no pass saw, and whatever else shifts every pass alike (--max-bounces, maps of hybrid
// paths).

#include <optional>

#include "render/film/film_totals.h"

namespace kaustik::render {

// Of one pixel, per channel, W/(m^2 sr).
struct PixelError {
  Rgb mean{0};
  Rgb error{0};  // standard error of the noise; infinite with fewer than two passes
  Rgb bias{0};   // positive where the picture is too bright; 0 where it was not measured
};
using ErrorMap = PixelWindow<PixelError>;

ErrorMap estimate_errors(const FilmTotals& totals);

// Writes the layers error and bias.
void show_errors(const ErrorMap& errors, Film* film);

// The 95 % quantile of Student's distribution with passes - 1 degrees of freedom, so that 90 % lie within it
// on both sides; infinite for fewer than two passes. Within 0.5 % of the exact value.
double confidence_factor(uint64_t passes);

// The 90 % bound of each pixel over its radiance, as a mean over the channels; radiance below a tenth of the
// picture's mean counts as that. Of these the mean over all pixels, or the quantile (in (0, 1]) if there is
// one. Infinite with fewer than two passes; pixels that have fewer do not count.
double relative_error(const ErrorMap& errors, uint64_t passes, std::optional<double> quantile = {});

}  // namespace kaustik::render
