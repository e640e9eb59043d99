#pragma once
// Weighted first-order regression in windows of pixels: the filter of the denoiser.
//
// In the window about each pixel p, each target is fitted by an affine function of features and position:
//   t(q) = a + sum_i b_i (f_i(q) - f_i(p)) + c . (q - p),
// by least squares with the weights w(p, q) of NL-means: how much the patches about p and q differ in a
// guide, in units of what its noise explains (Buades and others 2005; Rousselle and others 2012). Each fit
// predicts all pixels of its window, and a pixel becomes the mean of its predictions, with the same weights
// (Bitterli and others 2016, "Nonlinearly Weighted First-order Regression for Denoising Monte Carlo
// Renderings").

#include <array>
#include <vector>

#include "render/denoise/plane.h"

namespace kaustik::render {

inline constexpr int kReach = 5;        // a window has 2 kReach + 1 pixels a side
inline constexpr int kPatchReach = 2;   // a patch has 2 kPatchReach + 1
inline constexpr size_t kFeatures = 7;  // albedo, normal, depth
inline constexpr size_t kTargets = 6;
static_assert(kReach + kPatchReach < Plane::kBorder);

struct RegressionInput {
  std::array<const Plane*, 3> guide, variance;  // and the variance of its noise
  const Plane* noise;                           // the sum of these variances
  std::array<const Plane*, kFeatures> features;
  std::array<const Plane*, kTargets> targets;
  const Plane* inside;  // 1 where pixels are known, else 0, as beyond the picture
};

// A difference of that many standard deviations has a weight of 1 / e.
inline constexpr float kBandwidth = 0.5f;

// Targets as fitted; unchanged where no window gives a value.
using Fitted = std::array<Plane, kTargets>;

class BandSums;  // regression.cpp

// Regressions of pictures of one size, which take their memory once.
class Regression {
 public:
  Regression(int width, int height);
  ~Regression();
  // Valid until the next call.
  const Fitted& fit(const RegressionInput& in);

 private:
  std::vector<BandSums> bands_;
  Fitted fitted_;
};

}  // namespace kaustik::render
