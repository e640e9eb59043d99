#pragma once
// Scenes of random primitives in [-1, 1]^3, moved and scaled, for the ray tests.

#include "core/scene/scene.h"
#include "tests/support/random.h"

namespace kaustik::test {

// to_world = translation(center + offset) * rotation * diagonal(radii), all times scale.
struct Placement {
  float scale = 1;
  Vector3 offset{0};

  Point3 point(const Point3& p) const { return scale * (p + offset); }
  Transform transform(const Vector3& center, const Frame& frame, const Vector3& radii) const {
    glm::dmat4 m(1);
    m[0] = glm::dvec4(glm::dvec3(frame.x) * double(radii.x * scale), 0);
    m[1] = glm::dvec4(glm::dvec3(frame.y) * double(radii.y * scale), 0);
    m[2] = glm::dvec4(glm::dvec3(frame.z) * double(radii.z * scale), 0);
    m[3] = glm::dvec4(glm::dvec3(point(center)), 1);
    return Transform::from_matrix(m);
  }
};

inline void add_triangles(Scene& scene, Random& random, const Placement& place, int count, float size) {
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const Vector3 center = random.in_cube();
    for (int k = 0; k < 3; ++k) mesh.P.push_back(place.point(center + size * random.in_cube()));
    const uint32_t v = 3 * static_cast<uint32_t>(i);
    mesh.indices.push_back({v, v + 1, v + 2});
  }
  Shape shape;
  shape.geometry = std::move(mesh);
  scene.shapes.push_back(std::move(shape));
}

inline void add_spheres(Scene& scene, Random& random, const Placement& place, int count, bool ellipsoids) {
  for (int i = 0; i < count; ++i) {
    const float r = random.uniform(0.02f, 0.3f);
    Vector3 radii(r);
    if (ellipsoids) radii *= Vector3(random.uniform(0.5f, 1), random.uniform(0.5f, 1), 1);
    Shape shape;
    shape.geometry = Sphere{place.transform(random.in_cube(), Frame::from_z(random.direction()), radii)};
    scene.shapes.push_back(std::move(shape));
  }
}

inline void add_disks(Scene& scene, Random& random, const Placement& place, int count) {
  for (int i = 0; i < count; ++i) {
    const Vector3 radii(random.uniform(0.02f, 0.3f));
    Shape shape;
    shape.geometry = Disk{place.transform(random.in_cube(), Frame::from_z(random.direction()), radii),
                          i % 2 == 0 ? 0.0f : random.uniform(0.1f, 0.9f)};
    scene.shapes.push_back(std::move(shape));
  }
}

// Cylinders and parts of spheres and disks in turn.
inline void add_quadrics(Scene& scene, Random& random, const Placement& place, int count) {
  for (int i = 0; i < count; ++i) {
    const float r = random.uniform(0.02f, 0.3f);
    Quadric q;
    q.kind = static_cast<QuadricKind>(i % 3);
    q.z_min = random.uniform(-0.9f, 0);
    q.z_max = random.uniform(0.1f, 0.9f);
    q.inner = q.kind == QuadricKind::kDisk ? random.uniform(0.1f, 0.6f) : 0.0f;
    if (i % 2) q.phi_max = random.uniform(1, 6);
    const Vector3 radii = r * Vector3(random.uniform(0.5f, 1), random.uniform(0.5f, 1), 1);
    q.to_world = place.transform(random.in_cube(), Frame::from_z(random.direction()), radii);
    Shape shape;
    shape.geometry = q;
    scene.shapes.push_back(std::move(shape));
  }
}

// Instances of one mesh of `triangles` triangles in [-size, size]^3, turned, sometimes mirrored, and scaled
// unevenly.
inline void add_instances(Scene& scene, Random& random, const Placement& place, int count, int triangles,
                          float size) {
  Scene own;
  add_triangles(own, random, {size, {0, 0, 0}}, triangles, 0.3f);
  const auto mesh = std::make_shared<const TriangleMesh>(std::get<TriangleMesh>(own.shapes[0].geometry));
  for (int i = 0; i < count; ++i) {
    const float r = random.uniform(0.1f, 0.4f) / size;
    const Vector3 radii = r * Vector3(random.uniform(0.5f, 1), i % 3 ? 0.8f : -0.8f, 1);
    Shape shape;
    shape.geometry =
        InstancedMesh{mesh, bounds_of(own.shapes[0]),
                      place.transform(random.in_cube(), Frame::from_z(random.direction()), radii)};
    scene.shapes.push_back(std::move(shape));
  }
}

inline void finish(Scene& scene) {
  scene.materials.emplace_back(Lambertian{});
  finalize_scene(scene);
}

// A regular icosahedron on the unit sphere whose triangles are split into four, `levels` times.
inline TriangleMesh icosphere(int levels) {
  const float g = 0.5f * (1 + std::sqrt(5.0f));
  TriangleMesh mesh;
  mesh.P = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
            {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (Point3& p : mesh.P) p = glm::normalize(p);
  mesh.indices = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                  {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                  {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::vector<std::array<uint32_t, 3>> finer;
    std::vector<std::pair<std::array<uint32_t, 2>, uint32_t>> known;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const std::array<uint32_t, 2> key{std::min(a, b), std::max(a, b)};
      for (const auto& [edge, vertex] : known)
        if (edge == key) return vertex;
      mesh.P.push_back(glm::normalize(mesh.P[a] + mesh.P[b]));
      known.push_back({key, static_cast<uint32_t>(mesh.P.size() - 1)});
      return known.back().second;
    };
    for (const auto& [a, b, c] : mesh.indices) {
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.indices = std::move(finer);
  }
  return mesh;
}

}  // namespace kaustik::test
