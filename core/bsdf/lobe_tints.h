#pragma once
// Colours of the reflected and the transmitted lobe of a dielectric.

#include "core/math/vec.h"

namespace kaustik {

// The probabilities with which a sample reflects or transmits light; both zero where it does neither.
struct LobeChances {
  float reflection, transmission;
};

// Factors on what the Fresnel equations reflect and transmit, as of pbrt-v3's coloured glass. They are the
// same in both directions of light, so they keep a BSDF reciprocal.
class LobeTints {
 public:
  LobeTints() = default;
  // Each channel in [0, 1].
  LobeTints(const Rgb& reflectance, const Rgb& transmittance)
      : reflectance_(reflectance),
        transmittance_(transmittance),
        tinted_(reflectance != Rgb(1) || transmittance != Rgb(1)) {}

  // False for plain glass, whose samples all have weight one.
  bool tinted() const { return tinted_; }
  const Rgb& of_lobe(bool transmission) const { return transmission ? transmittance_ : reflectance_; }
  // The chances where the Fresnel equations reflect the share `fresnel`. They are proportional to the largest
  // channel of each lobe, so that no channel of a sample's weight exceeds one.
  LobeChances chances(float fresnel) const {
    if (!tinted_) return {fresnel, 1 - fresnel};
    const float r = fresnel * max_component(reflectance_), t = (1 - fresnel) * max_component(transmittance_);
    if (!(r + t > 0)) return {0, 0};
    return {r / (r + t), 1 - r / (r + t)};
  }
  // The factor on the weight of a sample of a lobe that was chosen with probability `chance`.
  Rgb weight(bool transmission, float fresnel, float chance) const {
    return of_lobe(transmission) * ((transmission ? 1 - fresnel : fresnel) / chance);
  }
  // What both lobes together scatter at normal incidence.
  Rgb albedo(float eta) const {
    const float root = (eta - 1) / (eta + 1), fresnel = root * root;
    return fresnel * reflectance_ + (1 - fresnel) * transmittance_;
  }

 private:
  Rgb reflectance_{1}, transmittance_{1};
  bool tinted_ = false;
};

}  // namespace kaustik
