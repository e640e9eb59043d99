#pragma once
// The dielectric coat over a diffuse base, as light that arrives through it sees it.

#include "core/bsdf/microfacet/fresnel.h"
#include "core/bsdf/microfacet/rough_coat.h"

namespace kaustik {

// eta: index relative to the outside; alpha: roughness, 0 = smooth. eta = 1: there is no coat.
struct Coat {
  float eta = 1, alpha = 0;
  bool operator==(const Coat&) const = default;
};

// Transmittance of one coat, for many directions from outside.
class CoatTransmittance {
 public:
  explicit CoatTransmittance(const Coat& coat) : coat_(coat) {
    if (coat.alpha > 0) rough_ = RoughTransmittance(coat.alpha, coat.eta);
  }
  // cos_theta in [0, 1].
  float operator()(float cos_theta) const {
    return coat_.alpha > 0 ? rough_(cos_theta) : 1 - fresnel_dielectric(cos_theta, coat_.eta);
  }

 private:
  Coat coat_;
  RoughTransmittance rough_;
};

}  // namespace kaustik
