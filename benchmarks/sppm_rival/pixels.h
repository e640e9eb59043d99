#pragma once
// The state of a pixel in stochastic progressive photon mapping.

#include <atomic>
#include <memory>
#include <optional>

#include "render/camera/shading_point.h"

namespace kaustik::benchmarks::sppm {

// The first cache line holds what photons in reach read and add to.
struct alignas(64) Pixel {
  Point3 p{0};       // of the visible point
  float radius = 0;  // metres
  bool visible = false;
  std::atomic<float> flux[3]{};      // BSDF times flux of this iteration's photons, W/sr
  std::atomic<uint32_t> photons{0};  // their number
  float N = 0;                       // photons kept from all iterations
  Rgb tau{0};                        // their BSDF times flux, W/sr, and times beta

  Rgb Ld{0};    // radiance that needs no photons, summed over the iterations, W/(m^2 sr)
  Rgb beta{0};  // throughput of the camera path to the visible point
  std::optional<render::ShadingPoint> point;

  void add(const Rgb& light) {
    for (int c = 0; c < 3; ++c) flux[c].fetch_add(light[c], std::memory_order_relaxed);
    photons.fetch_add(1, std::memory_order_relaxed);
  }
};

// The share of new photons that is kept.
inline constexpr float kGamma = 2.0f / 3;

// Ends an iteration (Hachisuka and Jensen 2009, section 3.3): with M new photons N' = N + gamma M, R'^2 = R^2
// N' / (N + M), tau' = (tau + flux) R'^2 / R^2.
inline void update(Pixel& pixel) {
  const uint32_t M = pixel.photons.exchange(0, std::memory_order_relaxed);
  if (M == 0) return;
  const float N = pixel.N + kGamma * float(M), shrink = N / (pixel.N + float(M));
  Rgb flux;
  for (int c = 0; c < 3; ++c) flux[c] = pixel.flux[c].exchange(0, std::memory_order_relaxed);
  pixel.tau = (pixel.tau + pixel.beta * flux) * shrink;
  pixel.radius *= std::sqrt(shrink);
  pixel.N = N;
}

// The mean radiance over the iterations.
inline Rgb radiance(const Pixel& pixel, uint32_t iterations) {
  return (pixel.Ld + pixel.tau / (kPi * pixel.radius * pixel.radius)) / float(iterations);
}

}  // namespace kaustik::benchmarks::sppm
