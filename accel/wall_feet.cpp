// Pairs of triangles are found by a tree of boxes (accel/face_tree.h); each pair is then cut exactly.

#include "accel/wall_feet.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <tuple>
#include <utility>

#include "accel/drop_edges.h"
#include "accel/face_tree.h"
#include "core/geometry/triangle_bounds.h"
#include "core/math/error_bounds.h"
#include "core/parallel/parallel.h"

namespace kaustik::accel {
namespace {

constexpr double kTouch = 0x1p-19;  // of the largest coordinate

// The box meets those of triangles that touch this one. Boxes of triangles larger than twice the gap also
// meet where the triangles are of different groups and no farther apart than the gap; among smaller ones
// there would be too many pairs.
BoxedFace boxed(const Face& face, float gap) {
  BoxedFace boxed{{}, 0, &face};
  for (const Point3& p : face.P) boxed.box.add(p);
  const float touch =
      float(kTouch) * std::max(max_abs_component(boxed.box.min), max_abs_component(boxed.box.max));
  boxed.box.min -= touch;
  boxed.box.max += touch;
  if (glm::length(boxed.box.diagonal()) > 2 * gap) boxed.margin = 0.5f * gap;
  return boxed;
}

std::vector<Face> faces_of(const Shape& shape) {
  const TriangleMesh& mesh = *shape.mesh();
  std::vector<Face> faces;
  faces.reserve(mesh.indices.size());
  const auto* const instance = std::get_if<InstancedMesh>(&shape.geometry);
  for (const auto& triangle : mesh.indices) {
    Face face;
    for (size_t i = 0; i < 3; ++i) {
      const Point3& p = mesh.P[triangle[i]];
      face.P[i] = instance ? instance->to_world.point(p) : p;
    }
    face.n = triangle_normal(face.P[1] - face.P[0], face.P[2] - face.P[0]);
    if (face.n == Normal3(0)) continue;
    face.group = shape.surface_group;
    faces.push_back(face);
  }
  return faces;
}

bool is_glass(const Material& material) {
  return std::holds_alternative<Dielectric>(material.typical()) ||
         std::holds_alternative<ThinDielectric>(material.typical());
}

// The part of a segment that parameters from t0 to t1 leave.
struct Segment {
  glm::dvec3 a, b;
  double t0 = 0, t1 = 1;

  // Keeps the part where the distance is above zero; it is da at a and db at b.
  void clip(double da, double db) {
    if (da < 0 && db < 0) t1 = t0 - 1;
    if (da >= 0 && db >= 0) return;
    const double t = da / (da - db);
    (da < 0 ? t0 : t1) = da < 0 ? std::max(t0, t) : std::min(t1, t);
  }
  glm::dvec3 at(double t) const { return glm::mix(a, b, t); }
};

// Heights of a triangle's corners above a plane; those within `touch` are zero.
struct Heights {
  std::array<double, 3> h;

  bool above() const {
    return std::any_of(h.begin(), h.end(), [](double x) { return x > 0; });
  }
  bool below() const {
    return std::any_of(h.begin(), h.end(), [](double x) { return x < 0; });
  }
};

// Where the triangle meets the plane; nothing if it does so in a point or not at all.
std::optional<Segment> section(const Face& wall, const Heights& heights) {
  std::array<glm::dvec3, 4> found;
  size_t count = 0;
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = (i + 1) % 3;
    const double hi = heights.h[i], hj = heights.h[j];
    if (hi == 0) found[count++] = glm::dvec3(wall.P[i]);
    if (hi * hj < 0) found[count++] = glm::mix(glm::dvec3(wall.P[i]), glm::dvec3(wall.P[j]), hi / (hi - hj));
  }
  if (count != 2) return std::nullopt;
  return Segment{found[0], found[1]};
}

// The edge of a triangle on one side of the plane whose ends are at most `gap` away from it while the third
// corner is farther away, moved to the plane along its normal.
std::optional<Segment> below(const Face& wall, const Heights& heights, const glm::dvec3& n, double gap) {
  std::array<glm::dvec3, 3> found;
  size_t count = 0;
  for (size_t i = 0; i < 3; ++i)
    if (std::abs(heights.h[i]) <= gap) found[count++] = glm::dvec3(wall.P[i]) - heights.h[i] * n;
  if (count != 2) return std::nullopt;
  return Segment{found[0], found[1]};
}

// The largest coordinate of both.
float size_of(const Face& floor, const Face& wall) {
  float size = 0;
  for (const Face* face : {&floor, &wall})
    for (const Point3& p : face->P) size = std::max(size, max_abs_component(p));
  return size;
}

// Whether all of the wall is on one side of the floor's plane and farther away than `distance`, with room for
// rounding.
bool is_clear_of(const Face& floor, const Face& wall, float distance) {
  float low = kInfinity, high = -kInfinity;
  for (const Point3& p : wall.P) {
    const float h = glm::dot(p - floor.P[0], floor.n);
    low = std::min(low, h), high = std::max(high, h);
  }
  return low > 2 * distance || high < -2 * distance;
}

std::optional<BoundaryEdge> foot_on(const Face& floor, const Face& wall, float gap) {
  const double touch = kTouch * double(size_of(floor, wall));
  if (is_clear_of(floor, wall, float(touch) + (floor.group == wall.group ? 0 : gap))) return std::nullopt;
  const glm::dvec3 p0(floor.P[0]);
  const glm::dvec3 n = glm::normalize(glm::cross(glm::dvec3(floor.P[1]) - p0, glm::dvec3(floor.P[2]) - p0));
  Heights heights;
  for (size_t i = 0; i < 3; ++i) {
    const double h = glm::dot(glm::dvec3(wall.P[i]) - p0, n);
    heights.h[i] = std::abs(h) <= touch ? 0 : h;
  }
  auto foot = section(wall, heights);
  if (!foot && floor.group != wall.group) foot = below(wall, heights, n, double(gap));
  if (!foot) return std::nullopt;
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 corner(floor.P[i]), along = glm::dvec3(floor.P[(i + 1) % 3]) - corner;
    const glm::dvec3 inward = glm::normalize(glm::cross(n, along));
    foot->clip(glm::dot(foot->a - corner, inward) + touch, glm::dot(foot->b - corner, inward) + touch);
  }
  // What is clipped reaches over the corners by up to two touches on either side.
  if (!((foot->t1 - foot->t0) * glm::length(foot->b - foot->a) > 8 * touch)) return std::nullopt;
  BoundaryEdge edge;
  edge.a = Point3(foot->at(foot->t0));
  edge.b = Point3(foot->at(foot->t1));
  edge.n = Normal3(heights.above() ? n : -n);
  edge.both_sides = heights.above() && heights.below();
  edge.surface_group = floor.group;
  return edge;
}

// The feet of all walls on all floors, in any order; nothing if there are too many pairs of boxes.
std::optional<std::vector<BoundaryEdge>> feet_of(const std::vector<BoxedFace>& floors, const FaceTree& walls,
                                                 float gap) {
  tbb::enumerable_thread_specific<std::vector<BoundaryEdge>> found;
  std::atomic<uint64_t> pairs{0};
  parallel::for_range(tbb::blocked_range<size_t>(0, floors.size()), [&](const auto& range) {
    std::vector<BoundaryEdge>& feet = found.local();
    for (size_t i = range.begin(); i < range.end() && pairs <= kMostWallPairs; ++i)
      pairs += walls.for_each_bent(floors[i], [&](const Face& wall) {
        if (const auto foot = foot_on(*floors[i].face, wall, gap)) feet.push_back(*foot);
      });
  });
  if (pairs > kMostWallPairs) return std::nullopt;
  std::vector<BoundaryEdge> all;
  for (const auto& feet : found) all.insert(all.end(), feet.begin(), feet.end());
  return all;
}

// Whether the foot lies along edges at which the surface ends. The wall may belong to the same group and end
// there itself, so normals are compared.
bool lies_on_end(const BoundaryEdge& foot, const EdgeIndex& ends) {
  const float size = std::max(max_abs_component(foot.a), max_abs_component(foot.b));
  std::array<uint32_t, 16> found;
  const auto ends_at = [&](float t) {
    const Point3 p = glm::mix(foot.a, foot.b, t);
    const size_t count = ends.find(p, 4 * float(kTouch) * size, foot.surface_group, found);
    return count <= found.size() &&
           std::any_of(found.begin(), found.begin() + std::ptrdiff_t(count),
                       [&](uint32_t i) { return std::abs(glm::dot(ends[i].n, foot.n)) > kBendOfOthers; });
  };
  return ends_at(0.5f) && ends_at(0.05f) && ends_at(0.95f);
}

// The shapes with the fewest triangles, in their order.
std::vector<uint32_t> coarse_shapes(const Scene& scene) {
  std::vector<uint32_t> meshes;
  for (uint32_t i = 0; i < scene.shapes.size(); ++i)
    if (scene.shapes[i].mesh()) meshes.push_back(i);
  std::stable_sort(meshes.begin(), meshes.end(), [&](uint32_t a, uint32_t b) {
    return primitive_count(scene.shapes[a]) < primitive_count(scene.shapes[b]);
  });
  uint64_t triangles = 0;
  size_t kept = 0;
  while (kept < meshes.size()) {
    triangles += primitive_count(scene.shapes[meshes[kept]]);
    if (triangles > kMostWallTriangles) break;
    ++kept;
  }
  meshes.resize(kept);
  std::sort(meshes.begin(), meshes.end());
  return meshes;
}

auto order_of(const BoundaryEdge& e) {
  return std::tuple(e.surface_group, e.a.x, e.a.y, e.a.z, e.b.x, e.b.y, e.b.z, e.n.x, e.n.y, e.n.z,
                    e.both_sides);
}

// The triangles of a shape, and what they may be.
struct ShapeFaces {
  std::vector<Face> faces;
  bool floors = false, walls = false;
};

std::vector<ShapeFaces> faces_of(const Scene& scene) {
  const std::vector<uint32_t> shapes = coarse_shapes(scene);
  std::vector<ShapeFaces> found(shapes.size());
  parallel::for_index(size_t{0}, shapes.size(), [&](size_t i) {
    const Shape& shape = scene.shapes[shapes[i]];
    const Material& material = scene.materials[shape.material];
    found[i].floors = material.lobes().diffuse;
    found[i].walls = !shape.has_alpha() && !is_glass(material);
    if (found[i].floors || found[i].walls) found[i].faces = faces_of(shape);
  });
  return found;
}

// The boxes of the faces of shapes of a sort, shape by shape.
std::vector<BoxedFace> boxes_of(const std::vector<ShapeFaces>& shapes, bool ShapeFaces::*sort, float gap) {
  std::vector<size_t> begin{0};
  for (const ShapeFaces& shape : shapes)
    begin.push_back(begin.back() + (shape.*sort ? shape.faces.size() : 0));
  std::vector<BoxedFace> boxes(begin.back());
  parallel::for_index(size_t{0}, shapes.size(), [&](size_t s) {
    const auto of_face = [&](size_t i) { boxes[begin[s] + i] = boxed(shapes[s].faces[i], gap); };
    parallel::for_index(size_t{0}, begin[s + 1] - begin[s], of_face);
  });
  return boxes;
}

}  // namespace

std::vector<BoundaryEdge> find_wall_feet(const Scene& scene, const EdgeIndex& ends, float gap) {
  const std::vector<ShapeFaces> shapes = faces_of(scene);
  auto found = feet_of(boxes_of(shapes, &ShapeFaces::floors, gap),
                       FaceTree(boxes_of(shapes, &ShapeFaces::walls, gap)), gap);
  if (!found) return gap > 0 ? find_wall_feet(scene, ends, 0) : std::vector<BoundaryEdge>{};
  std::vector<BoundaryEdge>& feet = *found;
  drop_edges(&feet, [&](const BoundaryEdge& foot) { return lies_on_end(foot, ends); });
  parallel::sort(feet.begin(), feet.end(),
                 [](const auto& a, const auto& b) { return order_of(a) < order_of(b); });
  feet.erase(std::unique(feet.begin(), feet.end(),
                         [](const auto& a, const auto& b) { return order_of(a) == order_of(b); }),
             feet.end());
  return feet;
}

}  // namespace kaustik::accel
