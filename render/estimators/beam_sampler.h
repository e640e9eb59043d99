#pragma once
// Chooses the point of a camera ray where light that a medium scatters towards the camera is estimated.

#include <array>
#include <optional>

#include "core/light/light.h"
#include "core/medium/free_path.h"
#include "core/scene/scene.h"

namespace kaustik::render {

// Half of the samples of a ray follow the extinction of the medium along the ray, the others the inverse
// squared distance from the lights that have a place (equiangular sampling; Kulla and Fajardo 2012,
// "Importance Sampling Techniques for Path Tracing in Participating Media"), within the cone of a spot or
// projection light. Their density is that of the mixture (balance heuristic).
class BeamSampler {
 public:
  // ray: of unit direction; distance: of what it meets, metres, may be infinite. light: the throughput. The
  // medium and the ray are referred to.
  BeamSampler(const Scene& scene, const Medium& medium, const Ray& ray, float distance, const Rgb& light);

  // Probability that the medium meets the ray's light at all: the greatest possible weight of a sample.
  float opacity() const { return extinction_.opacity(); }

  struct Sample {
    float t = 0;    // metres
    Rgb weight{0};  // sigma_s T / pdf
  };
  // u in [0, 1)^2. The weight is zero where nothing can be chosen.
  Sample sample(const Point2& u) const;

 private:
  // A part of a ray, metres from its start; `end` may be infinite.
  struct Part {
    float begin, end;
  };
  // A light seen from the part of the ray that it can light: at distance `along` of the part's begin and
  // `beside` the ray.
  struct Near {
    Part lit;
    float along, beside;
    float angle;  // between the part's ends, seen from the light
    float power;  // share of the light in the chosen points, times the integral of 1/r^2
  };

  static std::optional<Part> lit_part(const LightBounds& light, const Ray& ray, float distance);
  void add(const LightBounds& light, const Ray& ray);
  float sample_lights(const Point2& u) const;
  float pdf_lights(float t) const;

  const Medium& medium_;
  const Ray& ray_;
  ScatteringPlace extinction_;
  float distance_;
  std::array<Near, kMostStrongLights> near_;
  size_t lights_ = 0;
  float power_ = 0;  // of all of near_
};

}  // namespace kaustik::render
