#pragma once
// An oracle for the BVH: tests every ray against every primitive, in double, by textbook formulas that share
// no code with the BVH or with core's intersectors. Slow by design.

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/scene/scene.h"

namespace kaustik::test {

class BruteForce {
 public:
  // Keeps a pointer to scene, which must outlive it.
  explicit BruteForce(const Scene& scene) : scene_(&scene) {}

  struct Nearest {
    double t = std::numeric_limits<double>::infinity();
    uint32_t shape = kNoIndex, primitive = 0;
    bool valid() const { return shape != kNoIndex; }
  };

  // Nearest hit with 0 < t < t_max along o + t d; t is in units of |d|.
  Nearest intersect(const glm::dvec3& o, const glm::dvec3& d,
                    double t_max = std::numeric_limits<double>::infinity()) const {
    Nearest best;
    best.t = t_max;
    for (uint32_t s = 0; s < scene_->shapes.size(); ++s) {
      std::visit([&](const auto& g) { intersect_shape(g, s, o, d, &best); }, scene_->shapes[s].geometry);
    }
    return best;
  }
  Nearest intersect(const Ray& ray) const { return intersect(ray.o, ray.d, ray.t_max); }
  bool occluded(const Ray& ray) const { return intersect(ray).valid(); }

 private:
  static void keep(Nearest* best, double t, uint32_t shape, uint32_t primitive) {
    if (t > 0 && t < best->t) *best = {t, shape, primitive};
  }

  // Intersects in the instance's own space, where t is the same.
  static void intersect_shape(const InstancedMesh& instance, uint32_t shape, const glm::dvec3& o,
                              const glm::dvec3& d, Nearest* best) {
    const LocalRay r = to_local(instance.to_world, o, d);
    intersect_shape(*instance.mesh, shape, r.o, r.d, best);
  }

  // Triangle intersection by Moeller and Trumbore 1997.
  static void intersect_shape(const TriangleMesh& mesh, uint32_t shape, const glm::dvec3& o,
                              const glm::dvec3& d, Nearest* best) {
    for (uint32_t i = 0; i < mesh.indices.size(); ++i) {
      const glm::dvec3 p0 = mesh.P[mesh.indices[i][0]];
      const glm::dvec3 e1 = glm::dvec3(mesh.P[mesh.indices[i][1]]) - p0;
      const glm::dvec3 e2 = glm::dvec3(mesh.P[mesh.indices[i][2]]) - p0;
      const glm::dvec3 q = glm::cross(d, e2);
      const double det = glm::dot(e1, q);
      if (det == 0) continue;
      const double u = glm::dot(o - p0, q) / det;
      const glm::dvec3 r = glm::cross(o - p0, e1);
      const double v = glm::dot(d, r) / det;
      if (u >= 0 && v >= 0 && u + v <= 1) keep(best, glm::dot(e2, r) / det, shape, i);
    }
  }

  struct LocalRay {
    glm::dvec3 o, d;
  };
  // Inverts in double: the stored inverse is float.
  static LocalRay to_local(const Transform& to_world, const glm::dvec3& o, const glm::dvec3& d) {
    const glm::dmat3 inverse = glm::inverse(glm::dmat3(to_world.linear));
    return {inverse * (o - glm::dvec3(to_world.translation)), inverse * d};
  }

  static void intersect_shape(const Sphere& sphere, uint32_t shape, const glm::dvec3& o, const glm::dvec3& d,
                              Nearest* best) {
    const LocalRay r = to_local(sphere.to_world, o, d);
    const double a = glm::dot(r.d, r.d), b = glm::dot(r.o, r.d), c = glm::dot(r.o, r.o) - 1;
    const double discriminant = b * b - a * c;
    if (discriminant < 0) return;
    keep(best, (-b + std::sqrt(discriminant)) / a, shape, 0);
    keep(best, (-b - std::sqrt(discriminant)) / a, shape, 0);
  }

  static void intersect_shape(const Disk& disk, uint32_t shape, const glm::dvec3& o, const glm::dvec3& d,
                              Nearest* best) {
    const LocalRay r = to_local(disk.to_world, o, d);
    if (r.d.z == 0) return;
    const double t = -r.o.z / r.d.z;
    const double radius = std::hypot(r.o.x + t * r.d.x, r.o.y + t * r.d.y);
    if (radius <= 1 && radius >= disk.inner) keep(best, t, shape, 0);
  }

  static bool within_turn(const Quadric& q, const glm::dvec3& p) {
    const double phi = std::atan2(p.y, p.x);
    return q.full_turn() || (phi < 0 ? phi + 2 * std::numbers::pi : phi) <= double(q.phi_max);
  }

  static void intersect_shape(const Quadric& q, uint32_t shape, const glm::dvec3& o, const glm::dvec3& d,
                              Nearest* best) {
    const LocalRay r = to_local(q.to_world, o, d);
    if (q.kind == QuadricKind::kDisk) {
      const glm::dvec3 p = r.o - r.o.z / r.d.z * r.d;
      const double radius = std::hypot(p.x, p.y);
      if (r.d.z != 0 && radius <= 1 && radius >= double(q.inner) && within_turn(q, p))
        keep(best, -r.o.z / r.d.z, shape, 0);
      return;
    }
    const double round = q.kind == QuadricKind::kSphere ? 1 : 0;
    const glm::dvec3 w(1, 1, round);
    const double a = glm::dot(w * r.d, r.d), b = glm::dot(w * r.o, r.d), c = glm::dot(w * r.o, r.o) - 1;
    const double discriminant = b * b - a * c;
    if (discriminant < 0 || a == 0) return;
    for (const double sign : {-1.0, 1.0}) {
      const double t = (-b + sign * std::sqrt(discriminant)) / a;
      const glm::dvec3 p = r.o + t * r.d;
      if (p.z >= double(q.z_min) && p.z <= double(q.z_max) && within_turn(q, p)) keep(best, t, shape, 0);
    }
  }

  const Scene* scene_;
};

}  // namespace kaustik::test
