// As in Bvh, Embree sees coordinates divided by a power of two, so that the results are the same at every
// scale.

#include "accel/edge_index.h"

#include <algorithm>
#include <cmath>

#include "accel/embree_handles.h"
#include "core/math/error_bounds.h"

namespace kaustik::accel {

namespace {

constexpr uint32_t kFewEdges = 16;  // up to this many, a linear walk is no slower than a descent of the BVH

bool reaches(const BoundaryEdge& edge, const glm::dvec3& p, double radius) {
  const glm::dvec3 a = glm::dvec3(edge.a) - p, along = glm::dvec3(edge.b) - glm::dvec3(edge.a);
  const double t = std::clamp(-glm::dot(a, along) / glm::dot(along, along), 0.0, 1.0);
  const glm::dvec3 nearest = a + t * along;
  return glm::dot(nearest, nearest) <= radius * radius;
}

}  // namespace

struct EdgeIndex::Impl {
  EmbreeHandles embree;
  float to_embree = 1;
  std::vector<BoundaryEdge> const* edges = nullptr;  // set only while the BVH is built

  void set_scale();
  void build();
  static void bounds(const RTCBoundsFunctionArguments* args);
};

void EdgeIndex::Impl::set_scale() {
  float largest = 0;
  for (const BoundaryEdge& edge : *edges)
    largest = std::max({largest, max_abs_component(edge.a), max_abs_component(edge.b)});
  if (largest > 0 && std::isfinite(largest))
    to_embree = std::ldexp(1.0f, -std::clamp(std::ilogb(largest), -100, 100));
}

void EdgeIndex::Impl::bounds(const RTCBoundsFunctionArguments* args) {
  const auto& impl = *static_cast<const Impl*>(args->geometryUserPtr);
  const BoundaryEdge& edge = (*impl.edges)[args->primID];
  const Point3 lower = impl.to_embree * glm::min(edge.a, edge.b);
  const Point3 upper = impl.to_embree * glm::max(edge.a, edge.b);
  *args->bounds_o = {lower.x, lower.y, lower.z, 0, upper.x, upper.y, upper.z, 0};
}

void EdgeIndex::Impl::build() {
  set_scale();
  embree.open_device();
  embree.scene = rtcNewScene(embree.device);
  check(embree.device, "making the scene of edges");
  RTCGeometry geometry = rtcNewGeometry(embree.device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(edges->size()));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(embree.scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(embree.scene);
  check(embree.device, "building the BVH of edges");
  edges = nullptr;
}

EdgeIndex::EdgeIndex(std::vector<BoundaryEdge> edges) : edges_(std::move(edges)) {
  if (edges_.empty()) return;
  std::stable_sort(edges_.begin(), edges_.end(), [](const BoundaryEdge& a, const BoundaryEdge& b) {
    return a.surface_group < b.surface_group;
  });
  group_begin_.assign(size_t(edges_.back().surface_group) + 2, 0);
  for (const BoundaryEdge& edge : edges_) ++group_begin_[size_t(edge.surface_group) + 1];
  for (size_t g = 1; g < group_begin_.size(); ++g) group_begin_[g] += group_begin_[g - 1];
  impl_ = std::make_unique<Impl>();
  impl_->edges = &edges_;
  impl_->build();
}

EdgeIndex::~EdgeIndex() = default;
EdgeIndex::EdgeIndex(EdgeIndex&&) noexcept = default;
EdgeIndex& EdgeIndex::operator=(EdgeIndex&&) noexcept = default;

size_t EdgeIndex::find(const Point3& p, float radius, uint32_t surface_group, std::span<uint32_t> out) const {
  if (size_t(surface_group) + 1 >= group_begin_.size() || !(radius >= 0)) return 0;
  const uint32_t begin = group_begin_[surface_group], end = group_begin_[surface_group + 1];
  const glm::dvec3 center(p);
  size_t count = 0;
  auto visit = [&](uint32_t i) {
    if (i < begin || i >= end || !reaches(edges_[i], center, double(radius))) return true;
    if (count < out.size()) out[count] = i;
    return ++count <= out.size();
  };
  if (end - begin <= kFewEdges) {
    for (uint32_t i = begin; i < end && visit(i); ++i) continue;
    return count;
  }
  // Slack for Embree, which rounds differences and their squares by a few parts in 2^23.
  constexpr float kSlack = 1 + 0x1p-16f;
  const Point3 scaled = impl_->to_embree * p;
  embree_visit_near(impl_->embree.scene, scaled.x, scaled.y, scaled.z, kSlack * impl_->to_embree * radius,
                    visit);
  count = std::min(count, out.size() + 1);
  std::sort(out.begin(), out.begin() + std::ptrdiff_t(std::min(count, out.size())));
  return count;
}

// An estimate: Embree's BVH takes about two boxes and a reference per edge.
uint64_t EdgeIndex::memory_bytes() const {
  return edges_.size() * (sizeof(BoundaryEdge) + 2 * 6 * sizeof(float) + 2 * sizeof(void*)) +
         group_begin_.size() * sizeof(uint32_t);
}

}  // namespace kaustik::accel
