#pragma once
// Every ray of the renderer goes through here: Embree's BVH (3.13 and 4) behind a small header. Robust mode,
// medium build quality. Spheres and disks are exact: user geometry, intersected by core/geometry.

#include <memory>

#include "accel/ray_lanes.h"
#include "core/scene/scene.h"

namespace kaustik::accel {

// How the rays of a packet lie: decides how it goes through the tree, hence its speed.
enum class RayOrder {
  kMixed,      // like nothing but perhaps a common octant of directions
  kNeighbours  // next to each other from one point, as from the camera: they stay together as a bundle
};

// Immutable after construction; every const member may be called from any thread.
class Bvh {
 public:
  // threads: upper bound on build threads, 0 = all. Keeps a pointer to scene, which must outlive it.
  explicit Bvh(const Scene& scene, int threads = 0);
  ~Bvh();
  Bvh(Bvh&&) noexcept;
  Bvh& operator=(Bvh&&) noexcept;

  // Nearest hit with 0 < t < ray.t_max.
  Hit intersect(const Ray& ray) const;
  // True when anything blocks the open segment 0 < t < ray.t_max.
  bool occluded(const Ray& ray) const;
  // Nearest hits of the first `count` rays, in packets: the bits of intersect(), save that of surfaces met at
  // exactly the same distance (a ray through an edge) another may be named, depending on the other rays.
  void intersect(const RayLanes& rays, size_t count, HitLanes* hits, RayOrder order = RayOrder::kMixed) const;
  // Nearest hit as a surface point; false when the ray escapes.
  bool intersect(const Ray& ray, SurfaceInteraction* si) const;

  const Scene& scene() const { return *scene_; }
  uint64_t memory_bytes() const;  // as Embree reports it

 private:
  struct Impl;
  const Scene* scene_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kaustik::accel
