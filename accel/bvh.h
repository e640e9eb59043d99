#pragma once
// All rays of the renderer are traced here: Embree's BVH (3.13 or 4) behind a small interface, in robust mode
// and with medium build quality. Spheres, disks and other quadrics are exact: user geometry that
// core/geometry intersects.

#include <memory>

#include "accel/ray_lanes.h"
#include "core/scene/scene.h"

namespace kaustik::accel {

// How the rays of a packet are related. It decides how the packet is traversed, and so only the speed.
enum class RayOrder {
  kMixed,      // unrelated, but for an octant of directions that they may share
  kNeighbours  // adjacent rays from one point, such as camera rays, traversed together as a bundle
};

// Immutable after construction; every const member may be called from any thread.
class Bvh {
 public:
  // threads: upper bound on build threads, 0 = all. Keeps a pointer to scene, which must outlive the Bvh.
  // Throws std::runtime_error when Embree fails, for want of memory for example.
  explicit Bvh(const Scene& scene, int threads = 0);
  ~Bvh();
  Bvh(Bvh&&) noexcept;
  Bvh& operator=(Bvh&&) noexcept;

  // Nearest hit with 0 < t < ray.t_max.
  Hit intersect(const Ray& ray) const;
  // True when anything blocks the open segment 0 < t < ray.t_max.
  bool occluded(const Ray& ray) const;
  // Nearest hits of the first `count` rays, traced in packets. The results have the same bits as those of
  // intersect() for single rays, except where surfaces are met at exactly the same distance (a ray through an
  // edge): which of them is named may then depend on the other rays.
  void intersect(const RayLanes& rays, size_t count, HitLanes* hits, RayOrder order = RayOrder::kMixed) const;
  // Nearest hit as a surface point; false when the ray escapes.
  bool intersect(const Ray& ray, SurfaceInteraction* si) const;

  const Scene& scene() const { return *scene_; }
  // The BVH of scene().interfaces, which are no part of this one; null if there are none.
  const Bvh* interfaces() const { return interfaces_.get(); }
  uint64_t memory_bytes() const;  // as Embree reports it

 private:
  struct Impl;
  const Scene* scene_;
  std::unique_ptr<Impl> impl_;
  std::unique_ptr<const Bvh> interfaces_;
};

}  // namespace kaustik::accel
