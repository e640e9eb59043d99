#pragma once
// What surfaces hide from a ray in a medium. Photons behind a wall say nothing about the light in front of
// it.

#include <array>

#include "accel/bvh.h"
#include "photon/gather/kernel.h"

namespace kaustik::photon {

// Tells what the points of a ray see across it. All numbers are functions of the ray.
class BeamSight {
 public:
  // ray: of unit direction; distance: its length, metres, may be infinite; radius: of the kernel, metres.
  BeamSight(const accel::Bvh& bvh, const Ray& ray, float distance, float radius, const KernelSpec& kernel);

  // The share of the kernel about the ray's point t that surfaces do not hide: what the estimate there is
  // divided by. It is interpolated between a few points, at which a few rays are traced across the beam.
  float share(float t) const;
  // Whether the ray's point t sees p.
  bool sees(float t, const Point3& p) const;
  // A random number in [0, 1) for this block of photons.
  float number(uint32_t block) const;

 private:
  static constexpr int kMostPoints = 8, kDirections = 4;
  // The estimate is divided by at least so much, lest the noise of few photons becomes bright spots.
  static constexpr float kLeastShare = 1.0f / 16;

  float share_at(float t, float turn, float radius, const KernelSpec& kernel) const;

  const accel::Bvh& bvh_;
  Ray ray_;
  uint64_t seed_;
  float length_ = 0;  // of the part of the ray that has surfaces beside it
  int points_ = 0;
  std::array<float, kMostPoints> shares_;
};

}  // namespace kaustik::photon
