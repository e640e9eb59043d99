#include "render/estimators/beam_sampler.h"

#include <algorithm>

namespace kaustik::render {

BeamSampler::BeamSampler(const Scene& scene, const Medium& medium, const Ray& ray, float distance,
                         const Rgb& light)
    : medium_(medium),
      ray_(ray),
      extinction_(medium, light, column_of(medium, ray, 0, distance)),
      distance_(distance) {
  for (const uint32_t i : scene.strongest_lights)
    if (const auto bounds = bounds_of(scene.lights[i])) add(*bounds, ray);
}

void BeamSampler::add(const LightBounds& light, const Ray& ray) {
  const Vector3 to_light = light.box.center() - ray.o;
  Near near{};
  near.along = glm::dot(to_light, ray.d);
  // Within a light's own extent, its distance varies little.
  const float radius2 = 0.25f * length_squared(light.box.diagonal());
  const float beside2 = length_squared(to_light - near.along * ray.d) + radius2;
  // A ray right through a point light: any distance that is small.
  near.beside = std::sqrt(std::max(beside2, 1e-12f * length_squared(to_light)));
  if (!(near.beside > 0)) return;
  // The angle between the ray's ends, as seen from the light: not a difference of two angles, which would
  // cancel for lights that are far away.
  const float b = near.beside, s = -near.along, L = distance_;
  near.angle = L < kInfinity ? std::atan2(b * L, b * b + s * (s + L)) : std::atan2(b, s);
  near.power = light.phi * near.angle / b;
  if (!(near.power > 0) || !(near.power < kInfinity)) return;
  power_ += near.power;
  near_[lights_++] = near;
}

BeamSampler::Sample BeamSampler::sample(const Point2& u) const {
  if (!(opacity() > 0)) return {};
  const bool by_light = lights_ > 0 && u.x < 0.5f;
  const float v = lights_ == 0 ? u.x : std::min(by_light ? 2 * u.x : 2 * u.x - 1, kOneMinusEpsilon);
  float t, column;
  if (by_light) {
    t = sample_lights({v, u.y});
    column = column_of(medium_, ray_, 0, t);
  } else {
    column = extinction_.sample({v, u.y});
    t = place_of(column, medium_, ray_, 0, distance_);
  }
  if (!(t >= 0) || !(t <= distance_) || !(t < kInfinity)) return {};
  // From densities per metre of column density to such per metre.
  const float per_metre = medium_.density_at(ray_.at(t));
  const float of_extinction = per_metre * extinction_.pdf(column);
  const float pdf = lights_ == 0 ? of_extinction : 0.5f * (of_extinction + pdf_lights(t));
  return {t, pdf > 0 ? per_metre * extinction_.scattered(column) / pdf : Rgb(0)};
}

float BeamSampler::sample_lights(const Point2& u) const {
  size_t k = 0;
  float v = u.x * power_;
  for (; k + 1 < lights_ && v >= near_[k].power; ++k) v -= near_[k].power;
  const Near& near = near_[k];
  const float theta = u.y * near.angle, sine = std::sin(theta), cosine = std::cos(theta);
  const float b = near.beside, s = -near.along;
  return std::clamp((b * b + s * s) * sine / (b * cosine - s * sine), 0.0f, distance_);
}

// Lights are chosen in proportion to power times the integral of 1/r^2, so that the mixture's density is the
// sum of power / r^2.
float BeamSampler::pdf_lights(float t) const {
  float sum = 0;
  for (size_t k = 0; k < lights_; ++k) {
    const Near& near = near_[k];
    const float from = t - near.along, r2 = near.beside * near.beside + from * from;
    sum += near.power * near.beside / (near.angle * r2);
  }
  return sum / power_;
}

}  // namespace kaustik::render
