#pragma once
// Example values of every BSDF. All tests that hold for any BSDF run over them, in scalar code and in lanes.
// A BSDF without examples does not compile: "use of deleted function".

#include <vector>

#include "core/bsdf/bsdf.h"

namespace kaustik::test {

inline const LobeTints kTints(Rgb(0.9f, 0.5f, 0.1f), Rgb(0.2f, 0.6f, 1));
inline const Rgb kCopperEta(0.2f, 0.92f, 1.1f), kCopperK(3.9f, 2.45f, 2.14f);

// The examples should show every set of lobes that the type can have, and its limits.
template <BsdfType B>
std::vector<B> examples() = delete;

template <>
inline std::vector<Lambertian> examples() {
  return {{Rgb(0.2f, 0.5f, 1)}};
}
template <>
inline std::vector<OrenNayar> examples() {
  return {OrenNayar::from_sigma_degrees(Rgb(1), 0), OrenNayar::from_sigma_degrees(Rgb(1), 12),
          OrenNayar::from_sigma_degrees(Rgb(0.9f, 0.5f, 0.1f), 40),
          OrenNayar::from_sigma_degrees(Rgb(1), 90)};
}
template <>
inline std::vector<Dielectric> examples() {
  return {{1.5f},
          {1 / 1.33f},
          {1},
          {1.5f, {0.2f, 0.2f}},
          {1.5f, {0.9f, 0.9f}},
          {1 / 1.33f, {0.3f, 0.15f}},
          {2.4f, {0.7f, 0.7f}},
          {1.5f, {}, kTints},
          {1, {}, kTints},
          {1.5f, {0.2f, 0.2f}, kTints},
          {1 / 1.33f, {0.7f, 0.7f}, kTints}};
}
template <>
inline std::vector<Conductor> examples() {
  return {{kCopperEta, kCopperK},
          {kCopperEta, kCopperK, {0.1f, 0.1f}},
          {kCopperEta, kCopperK, {0.25f, 0.6f}},
          {kCopperEta, kCopperK, {1, 1}}};
}
template <>
inline std::vector<Mirror> examples() {
  return {{Rgb(0.9f)}};
}
template <>
inline std::vector<ThinDielectric> examples() {
  return {{1.5f}, {1}, {1.5f, kTints}, {1.5f, {Rgb(0), Rgb(0.5f)}}};
}
template <>
inline std::vector<DiffuseTransmission> examples() {
  return {{Rgb(0.2f, 0.5f, 0), Rgb(0.7f, 0.5f, 0.1f)}, {Rgb(0.5f), Rgb(0)}, {Rgb(0), Rgb(1)}};
}
template <>
inline std::vector<CoatedDiffuse> examples() {
  return {CoatedDiffuse::from_reflectance(Rgb(0.9f, 0.5f, 0), 1.5f),
          CoatedDiffuse::from_reflectance(Rgb(1), 2.5f), CoatedDiffuse::from_reflectance(Rgb(0.5f), 1),
          CoatedDiffuse::from_reflectance(Rgb(0.9f, 0.5f, 0), 1.5f, {0.2f, 0.2f}),
          CoatedDiffuse::from_reflectance(Rgb(0.9f, 0.5f, 0), 1.5f, {0.7f, 0.5f})};
}

// The relative rounding of f and pdf when they are computed from the directions of a sample: three chained
// float roundings on either side. Overload it for a BSDF that rounds more, with the reason.
template <BsdfType B>
double rounding_of(const B& bsdf) {
  constexpr double kThreeRoundings = 8 * 0x1p-24;
  if constexpr (requires { bsdf.facets; }) {
    // The half vector of microfacets is computed anew from the two directions: its slope is off by a few
    // roundings over the cosines (tests leave out directions near grazing), and D changes by 4 over alpha for
    // each unit of slope.
    const Ggx& facets = bsdf.facets;
    if (!facets.smooth())
      return kThreeRoundings + 64 * 0x1p-24 * 4 / double(std::min(facets.alpha_x, facets.alpha_y));
  }
  return kThreeRoundings;
}
// The half vector of refraction and its Jacobian hold differences that may be small: a thousandth.
inline double rounding_of(const Dielectric& bsdf) {
  return bsdf.facets.smooth() ? 8 * 0x1p-24 : 1e-3;
}
inline double rounding_of(const Bsdf& bsdf) {
  return std::visit([](const auto& b) { return rounding_of(b); }, bsdf);
}

// Samples can end on the wrong side of the surface, where they are lost, and lobes can be much narrower than
// a bin of a chi-square test. Overload these for a BSDF without facets of which the same is true.
template <BsdfType B>
bool loses_samples(const B& bsdf) {
  if constexpr (requires { bsdf.facets; }) return !bsdf.facets.smooth();
  return false;
}
inline bool loses_samples(const Bsdf& bsdf) {
  return std::visit([](const auto& b) { return loses_samples(b); }, bsdf);
}
// albedo() is the mean weight of reflected samples. Rough surfaces state that of the smooth one, and smooth
// dielectrics count transmission, too.
template <BsdfType B>
bool albedo_is_exact(const B& bsdf) {
  return !loses_samples(bsdf);
}
inline bool albedo_is_exact(const Dielectric& /*bsdf*/) {
  return false;
}
inline bool albedo_is_exact(const ThinDielectric& /*bsdf*/) {
  return false;
}
inline bool albedo_is_exact(const Bsdf& bsdf) {
  return std::visit([](const auto& b) { return albedo_is_exact(b); }, bsdf);
}

namespace detail {
template <class... B>
std::vector<Bsdf> examples_of_all(const std::variant<B...>* /*deduces B*/) {
  std::vector<Bsdf> all;
  (([&] {
     for (const B& b : examples<B>()) all.push_back(b);
   })(),
   ...);
  return all;
}
}  // namespace detail

// The examples of all alternatives of Bsdf, in the order of the list.
inline const std::vector<Bsdf>& bsdf_examples() {
  static const std::vector<Bsdf> all = detail::examples_of_all(static_cast<const Bsdf*>(nullptr));
  return all;
}

}  // namespace kaustik::test
