#include "photon/gather/beam_sight.h"

#include <cmath>

#include "core/math/frame.h"
#include "core/math/hash.h"
#include "core/scene/alpha.h"

namespace kaustik::photon {

namespace {

// A hash of the ray that is the same for scenes scaled by powers of two.
uint64_t seed_of(const Scene& scene, const Ray& ray) {
  const float radius = scene.bounds.radius();
  const float scale = radius > 0 && std::isfinite(radius) ? std::ldexp(1.0f, -std::ilogb(radius)) : 1;
  return hash_ray(scale * ray.o, ray.d);
}

}  // namespace

BeamSight::BeamSight(const accel::Bvh& bvh, const Ray& ray, float distance, float radius,
                     const KernelSpec& kernel)
    : bvh_(bvh), ray_(ray), seed_(seed_of(bvh.scene(), ray)) {
  const auto& bounds = bvh.scene().bounds;
  const float behind =
      glm::dot(bounds.center() - ray.o, ray.d) + 0.5f * glm::length(bounds.diagonal()) + radius;
  length_ = std::min(distance, behind);
  if (!(length_ > 0) || !(radius > 0) || !(length_ < kInfinity)) return;
  points_ = int(std::clamp(std::ceil(2 * length_ / radius), 1.0f, float(kMostPoints)));
  // The directions of neighbouring points fill each other's gaps.
  constexpr float kGolden = 0.618034f;
  const float first = unit_number(hash_combine(seed_, ~uint64_t{0}));
  for (int i = 0; i < points_; ++i) {
    const float t = (float(i) + 0.5f) / float(points_) * length_;
    const float turn = std::fmod(first + kGolden * float(i), 1.0f);
    shares_[size_t(i)] = share_at(t, turn, radius, kernel);
  }
}

float BeamSight::share_at(float t, float turn, float radius, const KernelSpec& kernel) const {
  const Frame frame = Frame::from_z(ray_.d);
  const MassWithin mass_within(kernel);
  float sum = 0;
  for (int i = 0; i < kDirections; ++i) {
    const float angle = 2 * kPi * (float(i) + turn) / kDirections;
    const Vector3 d = frame.to_world({std::cos(angle), std::sin(angle), 0});
    const Hit hit = bvh_.intersect(Ray{ray_.at(t), d, radius});
    sum += hit.valid() ? float(mass_within(double(hit.t / radius))) : 1;
  }
  return std::max(sum / kDirections, kLeastShare);
}

float BeamSight::share(float t) const {
  if (points_ == 0 || t > length_) return 1;
  const float at = std::clamp(t / length_ * float(points_) - 0.5f, 0.0f, float(points_ - 1));
  const int i = std::min(int(at), std::max(points_ - 2, 0));
  const float part = at - float(i);
  const float next = shares_[size_t(std::min(i + 1, points_ - 1))];
  return (1 - part) * shares_[size_t(i)] + part * next;
}

bool BeamSight::sees(float t, const Point3& p) const {
  const Point3 from = ray_.at(t);
  const float distance = glm::distance(from, p);
  return !(distance > 0) || !bvh_.occluded(Ray{from, (p - from) / distance, distance});
}

float BeamSight::number(uint32_t block) const {
  return unit_number(hash_combine(seed_, block));
}

}  // namespace kaustik::photon
