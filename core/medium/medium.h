#pragma once
// Participating media: what fills the space between surfaces.

#include <cstdint>
#include <memory>

#include "core/medium/density_grid.h"

namespace kaustik {

struct Medium {
  Rgb sigma_a{0};  // absorption coefficient, 1/m, not negative
  Rgb sigma_s{0};  // scattering coefficient, 1/m, not negative
  // Mean cosine of the angle by which light is deflected, for the phase function of Henyey and Greenstein; at
  // most kLargestG away from zero.
  float g = 0;
  // Factor on both coefficients that changes from place to place; null: one everywhere.
  std::shared_ptr<const DensityGrid> density = nullptr;
  // Radiance that the medium emits: it is seen where the medium is too deep to be seen through. Each metre
  // adds sigma_a Le.
  Rgb Le{0};

  Rgb sigma_t() const { return sigma_a + sigma_s; }  // extinction coefficient where the density is one, 1/m
  bool scatters() const { return !is_black(sigma_s); }
  bool emits() const { return !is_black(sigma_a * Le); }
  float density_at(const Point3& p) const { return density ? density->at(p) : 1; }
};

// Index into Scene::media. Photons on their way keep it in eight bits (photon/trace/lanes/walk_state.h).
using MediumIndex = uint8_t;
inline constexpr MediumIndex kVacuum = 0;
inline constexpr size_t kMostMedia = 255;  // the vacuum not counted

// The media on the two sides of a surface. `outside` is where its geometric normal points.
struct MediumInterface {
  MediumIndex inside = kVacuum, outside = kVacuum;

  // As in pbrt, a surface with the same medium on both sides lies in whatever medium a ray has come through.
  bool is_transition() const { return inside != outside; }
};

// exp(-sigma * distance) of each channel; the distance may be infinite.
inline Rgb exponential(const Rgb& sigma, float distance) {
  const auto left = [&](float s) { return s > 0 ? std::exp(-s * distance) : 1.0f; };
  return {left(sigma.x), left(sigma.y), left(sigma.z)};
}

// The column density of a part of a ray that lies in the medium: the integral of the density, in metres.
// Where the density is one, that is the part's length. The ray's direction is unit; begin and end are metres
// from its start, of which end may be infinite.
inline float column_of(const Medium& medium, const Ray& ray, float begin, float end) {
  return medium.density ? medium.density->column(ray, begin, end) : end - begin;
}
// The place of the ray, from begin to end, up to which there is that much column density.
inline float place_of(float column, const Medium& medium, const Ray& ray, float begin, float end) {
  return medium.density ? medium.density->place_of(column, ray, begin, end) : begin + column;
}

// The share of light that is neither absorbed nor scattered along a column density, in metres, which may be
// infinite (Beer and Lambert; Pharr 2023, section 11.2).
inline Rgb transmittance(const Medium& medium, float column) {
  return exponential(medium.sigma_t(), column);
}
// That along a part of a ray, see column_of().
inline Rgb transmittance(const Medium& medium, const Ray& ray, float begin, float end) {
  return transmittance(medium, column_of(medium, ray, begin, end));
}

// The radiance that a column density of the medium, in metres, which may be infinite, sends along the ray:
// int sigma_a Le T = Le sigma_a / sigma_t (1 - T) (Pharr 2023, section 14.1.1, for T of one medium).
inline Rgb emitted_radiance(const Medium& medium, float column) {
  Rgb sum(0);
  const Rgb sigma_t = medium.sigma_t();
  for (int c = 0; c < 3; ++c)
    if (medium.sigma_a[c] > 0)
      sum[c] = medium.Le[c] * (medium.sigma_a[c] / sigma_t[c]) * -std::expm1(-sigma_t[c] * column);
  return sum;
}

}  // namespace kaustik
