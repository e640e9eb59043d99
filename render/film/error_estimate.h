#pragma once
// Error of a picture of several passes, estimated from the passes alone.
//
// Noise: passes are independent renders, so the spread of their means gives the standard error of the overall
// mean. (Their camera samples are stratified against each other, so that estimate is slightly too large.)
// Bias: that of the photon maps' kernels, measured with a second gather at half the radius
// (photon/estimate/radiance_estimate.h). The measurement is noisy, so it is averaged over 3 x 3 pixels and
// the variance of the noise is subtracted from its square; where noise explains all of it, the bias is
// reported as zero.
//
// A pixel's channel is within confidence_factor() sqrt(error^2 + bias^2) of the true value with a probability
// of 90 %. Not detected: light that no pass has found, and anything else that shifts every pass alike
// (--max-bounces, the maps that hybrid paths read).

#include <optional>

#include "render/film/film_totals.h"

namespace kaustik::render {

// Error of one pixel, per channel, in W/(m^2 sr).
struct PixelError {
  Rgb mean{0};
  Rgb error{0};  // standard error of the noise; infinite with fewer than two passes
  Rgb bias{0};   // positive where the picture is too bright; 0 if not measured
};
using ErrorMap = PixelWindow<PixelError>;

ErrorMap estimate_errors(const FilmTotals& totals);

// Copies the estimates to the film's layers error and bias.
void show_errors(const ErrorMap& errors, Film* film);

// The 95 % quantile of Student's t distribution with passes - 1 degrees of freedom, so that 90 % lie within
// it on both sides; infinite for fewer than two passes. Accurate to 0.5 %.
double confidence_factor(uint64_t passes);

// Overall relative error. For each pixel: its 90 % bound divided by its radiance, averaged over the channels,
// where a radiance below a tenth of the picture's mean counts as that tenth. Returns the mean over all
// pixels, or the given quantile in (0, 1]. Pixels with fewer than two passes are not counted; infinite if
// none is left.
double relative_error(const ErrorMap& errors, uint64_t passes, std::optional<double> quantile = {});

}  // namespace kaustik::render
