#include "core/medium/emissive_bodies.h"

#include <algorithm>
#include <cmath>

#include "core/math/frame.h"
#include "core/sampling/warp.h"

namespace kaustik {

void EmissiveBodies::add(const Bounds3& box, const Medium& medium) {
  const float radius = box.radius();
  const float density = medium.density ? medium.density->largest() : 1;
  constexpr float kBrightest = 1e30f;  // so that weights are finite
  const float brightness = std::min(luminance(emitted_radiance(medium, 2 * radius * density)), kBrightest);
  if (!(radius > 0 && radius < kInfinity && brightness > 0)) return;
  const auto is_brighter = [](const Body& a, const Body& b) {
    return a.brightness * a.radius * a.radius > b.brightness * b.radius * b.radius;
  };
  const Body body{box.center(), radius, brightness};
  bodies_.insert(std::upper_bound(bodies_.begin(), bodies_.end(), body, is_brighter), body);
  if (bodies_.size() > kMost) bodies_.pop_back();
}

EmissiveBodies::Cone EmissiveBodies::cone_of(const Body& body, const Point3& p) {
  const Vector3 to_body = body.center - p;
  const float distance2 = length_squared(to_body), radius2 = body.radius * body.radius;
  if (!(distance2 > radius2)) return {};
  const float sin2 = radius2 / distance2;
  return {to_body / std::sqrt(distance2), sin2 / (1 + std::sqrt(1 - sin2))};
}

EmissiveBodies::Sample EmissiveBodies::sample(const Point3& p, float u_body, const Point2& u) const {
  float sum = 0;
  for (const Body& body : bodies_) sum += weight(body, cone_of(body, p));
  float left = u_body * sum;
  for (const Body& body : bodies_) {
    const Cone cone = cone_of(body, p);
    left -= weight(body, cone);
    if (left >= 0 && &body != &bodies_.back()) continue;
    const Vector3 wi = Frame::from_z(cone.axis).to_world(sample_uniform_cone(u, cone.one_minus_cos));
    return {wi, pdf(p, wi)};
  }
  return {};
}

float EmissiveBodies::pdf(const Point3& p, const Vector3& wi) const {
  float sum = 0, density = 0;
  for (const Body& body : bodies_) {
    const Cone cone = cone_of(body, p);
    sum += weight(body, cone);
    // 1 - cosine of the angle to the axis, without cancellation.
    if (0.5f * length_squared(wi - cone.axis) <= cone.one_minus_cos)
      density += weight(body, cone) * uniform_cone_pdf(cone.one_minus_cos);
  }
  return density > 0 ? density / sum : 0;
}

}  // namespace kaustik
