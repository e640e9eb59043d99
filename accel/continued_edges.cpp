// Tells the true ends of a surface from edges behind which it continues although no second triangle shares
// them.

#include "accel/bvh.h"
#include "accel/drop_edges.h"
#include "accel/edge_index.h"

namespace kaustik::accel {

namespace {

constexpr float kStep = 1e-3f;        // relative to the facet's edge or height, whichever is shorter
constexpr float kSameSurface = 0.5f;  // cosine
constexpr int kMaxLayers = 8;         // surfaces of other groups between the probe's start and its end

// Whether there is a facet of the edge's surface group within `reach` of p along the edge's normal.
bool finds_surface(const Bvh& bvh, const BoundaryEdge& edge, const Point3& p, float reach) {
  Ray ray{p + reach * edge.n, -edge.n, 2 * reach};
  for (int layer = 0; layer < kMaxLayers && ray.t_max > 0; ++layer) {
    SurfaceInteraction si;
    if (!bvh.intersect(ray, &si)) return false;
    if (si.surface_group == edge.surface_group && abs_dot(si.n, edge.n) > kSameSurface) return true;
    const Ray next = si.spawn(ray.d);
    ray.t_max -= glm::dot(next.o - ray.o, ray.d);
    ray.o = next.o;
  }
  return false;
}

bool goes_on(const Bvh& bvh, const BoundaryEdge& edge) {
  if (edge.beyond != Normal3(0)) return false;
  const float length = glm::distance(glm::dvec3(edge.a), glm::dvec3(edge.b));
  int found = 0;
  for (const float t : {0.25f, 0.5f, 0.75f}) {
    const Point3 p = edge.a + t * (edge.b - edge.a);
    // The step must be well above the rounding errors of p, of the moved point and of the hit.
    const float resolution = 4 * surface_error(max_abs_component(p), length);
    const float step = std::max(kStep * std::min(length, edge.height), resolution);
    found += finds_surface(bvh, edge, p + step * edge.outward, 2 * step);
  }
  return found >= 2;
}

}  // namespace

std::vector<BoundaryEdge> without_continued(std::vector<BoundaryEdge> edges, const Bvh& bvh,
                                            const std::function<bool()>& go_on) {
  drop_edges(
      &edges, [&](const BoundaryEdge& edge) { return goes_on(bvh, edge); }, go_on);
  if (edges.size() < edges.capacity() / 2) edges.shrink_to_fit();
  return edges;
}

}  // namespace kaustik::accel
