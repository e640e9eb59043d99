// Coefficients and albedo of the Oren-Nayar model.

#include "core/bsdf/oren_nayar.h"

namespace kaustik {

OrenNayar OrenNayar::from_sigma_degrees(const Rgb& reflectance, float sigma_degrees) {
  const double sigma = sigma_degrees * std::numbers::pi / 180;
  const double s2 = sigma * sigma;
  const double a = 1 - s2 / (2 * (s2 + 0.33));
  const double b = 0.45 * s2 / (s2 + 0.09);
  OrenNayar bsdf;
  bsdf.A = static_cast<float>(a);
  bsdf.B = static_cast<float>(b);
  const float grazing_albedo = static_cast<float>(a + 0.5 * b);
  bsdf.reflectance = grazing_albedo > 1 ? glm::min(reflectance, Rgb(1 / grazing_albedo)) : reflectance;
  return bsdf;
}

Rgb OrenNayar::albedo() const {
  // Cosine-weighted mean over wo of the directional albedo; the integral of B's term over both hemispheres is
  // 2/3 - 64/(45 pi).
  constexpr float kMean = 2.0f / 3 - 64.0f / 45 * kInvPi;
  return reflectance * (A + B * kMean);
}

}  // namespace kaustik
