// Bvh, implemented with Embree. Geometry ids: a triangle mesh has the index of its shape. All spheres
// together are one user geometry, all disks another and all other quadrics a third; their ids follow those of
// the shapes, and their hits name the shape as well. An instanced mesh is an Embree scene of its own, shared
// by all its instances; an instance has the index of its shape.
//
// Embree sees the scene divided by a power of two that brings its largest coordinate into [1, 2): scaling by
// it and back is exact. So Embree's few absolute thresholds (it gives up barycentrics when an area falls
// below 1e-18) have the same effect at every scale of the scene. Coordinates beyond 2^100 are not supported.
//
// Flush-to-zero and denormals-are-zero stay off, although Embree recommends them for speed: they would make
// hits of very small scenes differ from those of their scaled copies. Embree orders the primitives of a leaf,
// so neither the BVH nor the choice between two equally near triangles depends on the number of build
// threads.

#include "accel/bvh.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <deque>
#include <map>
#include <new>
#include <optional>

#include "accel/alpha_filter.h"
#include "accel/embree_handles.h"
#include "accel/quadric_group.h"

namespace kaustik::accel {

namespace {

bool count_memory(void* user, ssize_t bytes, bool /*post*/) {
  static_cast<std::atomic<int64_t>*>(user)->fetch_add(bytes, std::memory_order_relaxed);
  return true;
}

// Up to this many primitives, packets of rays from all over the scene are fastest when traversed coherently;
// in larger scenes their rays soon diverge (measured: docs/decisions/007-photons-walk-in-packets.md).
constexpr uint64_t kFewPrimitives = 64;

uint64_t primitive_count(const std::vector<Shape>& shapes) {
  uint64_t count = 0;
  for (const Shape& shape : shapes) {
    count += kaustik::primitive_count(shape);
  }
  return count;
}

static_assert(kRayLanes % kPacket == 0 && kNoIndex == RTC_INVALID_GEOMETRY_ID);

// Embree accepts tnear <= t <= tfar where we want 0 < t < t_max, so both ends are moved inward to the next
// float. An empty range stays empty.
constexpr float kNear = std::numeric_limits<float>::min();
float far_end(float t_max) {
  return t_max > 0 ? std::bit_cast<float>(std::bit_cast<uint32_t>(t_max) - 1) : -1.0f;
}

// Four floats in one register. Embree loads origin and direction this way, and would stall on floats that
// have just been stored one by one.
using Float4 = float __attribute__((vector_size(16)));
void store4(float* to, Float4 values) {
  std::memcpy(to, &values, sizeof(values));
}

// Largest coordinate that Embree handles: it drops rays with larger ones, and debug builds of it abort on
// them.
constexpr float kFarthest = 1.8e18f;

bool within_reach(Float4 o, Float4 d) {
  const auto inside = (o <= kFarthest) & (o >= -kFarthest) & (d <= kFarthest) & (d >= -kFarthest);
  uint64_t halves[2];
  static_assert(sizeof halves == sizeof inside);
  std::memcpy(halves, &inside, sizeof halves);
  return (halves[0] & halves[1]) == ~uint64_t{0};
}

// Fills an Embree ray. False for rays that are not finite or have a coordinate beyond kFarthest: they meet
// nothing.
bool fill(RTCRay& r, const Ray& ray, float to_embree) {
  static_assert(offsetof(RTCRay, tnear) == 3 * sizeof(float) && offsetof(RTCRay, time) == 7 * sizeof(float));
  const Float4 o = Float4{ray.o.x, ray.o.y, ray.o.z, kNear} * Float4{to_embree, to_embree, to_embree, 1};
  const Float4 d{ray.d.x, ray.d.y, ray.d.z, 0};
  store4(&r.org_x, o);
  store4(&r.dir_x, d);
  r.tfar = far_end(ray.t_max * to_embree);
  r.mask = 0xffffffffu;
  r.id = 0;
  r.flags = 0;
  return within_reach(o, d);
}

RTCScene new_scene(RTCDevice device) {
  RTCScene scene = rtcNewScene(device);
  check(device, "making the scene");
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  return scene;
}

// The power of two whose quotient brings the box's largest coordinate into [1, 2); 1 for boxes without
// extent.
float power_of_two_of(const Bounds3& bounds) {
  if (bounds.empty()) return 1;
  const float largest = std::max(max_abs_component(bounds.min), max_abs_component(bounds.max));
  if (!(largest > 0) || !std::isfinite(largest)) return 1;
  return std::ldexp(1.0f, std::clamp(std::ilogb(largest), -100, 100));
}

}  // namespace

struct Bvh::Impl {
  // The Embree scene of an instanced mesh, divided by a power of two of its own.
  struct OwnScene {
    RTCScene scene = nullptr;
    float scale = 1;

    OwnScene() = default;
    OwnScene(const OwnScene&) = delete;
    OwnScene& operator=(const OwnScene&) = delete;
    ~OwnScene() {
      if (scene) rtcReleaseScene(scene);
    }
  };

  std::atomic<int64_t> bytes{0};
  EmbreeHandles embree;
  float to_scene = 1, to_embree = 1;                               // lengths, as powers of two
  std::array<QuadricGroup, std::variant_size_v<Geometry>> groups;  // by type; those of meshes stay empty
  std::map<const TriangleMesh*, OwnScene> own_scenes;              // one for each instanced mesh
  std::deque<AlphaMesh> alpha_meshes;  // a deque, since Embree keeps pointers to its elements
  bool coherent = false;               // traverse packets of mixed rays coherently
  bool instances = false;              // hits may name an instance

  void open();
  void set_scale(const Bounds3& bounds);
  void add_shapes(const Scene& scene);
  void add_mesh(const Scene& scene, const TriangleMesh& mesh, uint32_t shape);
  void add_instance(const Scene& scene, const InstancedMesh& instance, uint32_t shape);
  RTCGeometry make_geometry(const TriangleMesh& mesh, float scale);
  void add_group(const Scene& scene, QuadricGroup& group, unsigned geometry_id);
  void attach(RTCScene scene, RTCGeometry geometry, unsigned geometry_id);
  void commit(int threads);
  void start_packets(RTCRayHit16* query) const;
  void load_packet(const RayLanes& rays, size_t first, RTCRayHit16* query, int* valid) const;
  void store_packet(const RTCRayHit16& query, size_t first, HitLanes* hits) const;
};

void Bvh::Impl::open() {
  // No "threads=" here: Embree would apply it to the whole process. commit() limits the build alone.
  embree.open_device();
  rtcSetDeviceMemoryMonitorFunction(embree.device, count_memory, &bytes);
  embree.scene = new_scene(embree.device);
}

void Bvh::Impl::attach(RTCScene scene, RTCGeometry geometry, unsigned geometry_id) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, geometry_id);
  rtcReleaseGeometry(geometry);
  check(embree.device, "adding a shape");
}

RTCGeometry Bvh::Impl::make_geometry(const TriangleMesh& mesh, float scale) {
  RTCGeometry geometry = rtcNewGeometry(embree.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // The buffer is Embree's own, which it pads: it reads 16 bytes at each vertex, 4 past the last one.
  auto* vertices = static_cast<Point3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Point3), mesh.P.size()));
  check(embree.device, "copying vertices");
  std::transform(mesh.P.begin(), mesh.P.end(), vertices, [scale](const Point3& p) { return scale * p; });
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices.data(), 0,
                             sizeof(mesh.indices[0]), mesh.indices.size());
  return geometry;
}

void Bvh::Impl::add_mesh(const Scene& scene, const TriangleMesh& mesh, uint32_t shape) {
  if (mesh.indices.empty()) return;
  RTCGeometry geometry = make_geometry(mesh, to_embree);
  if (scene.shapes[shape].has_alpha())
    set_alpha_filter(geometry, &alpha_meshes.emplace_back(AlphaMesh{&scene, shape}));
  attach(embree.scene, geometry, shape);
}

void Bvh::Impl::add_instance(const Scene& scene, const InstancedMesh& instance, uint32_t shape) {
  if (instance.mesh->indices.empty()) return;
  OwnScene& own = own_scenes[instance.mesh.get()];
  if (!own.scene) {
    own.scale = power_of_two_of(instance.local);
    own.scene = new_scene(embree.device);
    RTCGeometry geometry = make_geometry(*instance.mesh, 1 / own.scale);
    if (scene.shapes[shape].has_alpha())
      set_alpha_filter(geometry, &alpha_meshes.emplace_back(AlphaMesh{&scene}));
    attach(own.scene, geometry, 0);
    rtcCommitScene(own.scene);
    check(embree.device, "building the BVH of an instance");
  }
  RTCGeometry geometry = rtcNewGeometry(embree.device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, own.scene);
  const glm::mat3 linear = instance.to_world.linear * (own.scale * to_embree);
  const Vector3 translation = instance.to_world.translation * to_embree;
  const float columns[] = {linear[0].x, linear[0].y,   linear[0].z,   linear[1].x,
                           linear[1].y, linear[1].z,   linear[2].x,   linear[2].y,
                           linear[2].z, translation.x, translation.y, translation.z};
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
  attach(embree.scene, geometry, shape);
  instances = true;
}

void Bvh::Impl::add_group(const Scene& scene, QuadricGroup& group, unsigned geometry_id) {
  if (group.members.empty()) return;
  group.scene = &scene;
  group.to_scene = to_scene;
  group.to_embree = to_embree;
  attach(embree.scene, accel::make_geometry(embree.device, group), geometry_id);
}

void Bvh::Impl::set_scale(const Bounds3& bounds) {
  to_scene = power_of_two_of(bounds);
  to_embree = 1 / to_scene;
}

void Bvh::Impl::add_shapes(const Scene& scene) {
  const std::vector<Shape>& all = scene.shapes;
  const auto shapes = static_cast<uint32_t>(all.size());
  for (uint32_t i = 0; i < shapes; ++i) {
    std::visit(
        [&]<class G>(const G& geometry) {
          if constexpr (std::same_as<G, TriangleMesh>) add_mesh(scene, geometry, i);
          if constexpr (std::same_as<G, InstancedMesh>) add_instance(scene, geometry, i);
          if constexpr (AnalyticShape<G>) groups[all[i].geometry.index()].add(all[i], i);
        },
        all[i].geometry);
  }
  for (unsigned type = 0; type < groups.size(); ++type) add_group(scene, groups[type], shapes + type);
  coherent = primitive_count(all) <= kFewPrimitives;
}

void Bvh::Impl::commit(int threads) {
  std::optional<tbb::global_control> cap;
  if (threads > 0) cap.emplace(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads));
  rtcCommitScene(embree.scene);
  check(embree.device, "building the BVH");
}

Bvh::Bvh(const Scene& scene, int threads) : scene_(&scene), impl_(std::make_unique<Impl>()) {
  try {
    impl_->open();
    impl_->set_scale(scene.bounds);
    impl_->add_shapes(scene);
    impl_->commit(threads);
    if (scene.interfaces) interfaces_ = std::make_unique<const Bvh>(*scene.interfaces, threads);
  } catch (const std::bad_alloc&) {
    throw_embree(RTC_ERROR_OUT_OF_MEMORY, "building the BVH");
  }
}

Bvh::~Bvh() = default;
Bvh::Bvh(Bvh&&) noexcept = default;
Bvh& Bvh::operator=(Bvh&&) noexcept = default;

Hit Bvh::intersect(const Ray& ray) const {
  RTCRayHit query;
  Hit hit;
  if (!fill(query.ray, ray, impl_->to_embree)) return hit;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  embree_intersect(impl_->embree.scene, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
  hit.t = query.ray.tfar * impl_->to_scene;
  hit.uv = {query.hit.u, query.hit.v};
  const unsigned instance = query.hit.instID[0];
  hit.shape = instance == RTC_INVALID_GEOMETRY_ID ? query.hit.geomID : instance;
  hit.primitive = query.hit.primID;
  return hit;
}

// Sets the fields that are the same for all packets.
void Bvh::Impl::start_packets(RTCRayHit16* query) const {
  std::fill_n(query->ray.tnear, kPacket, kNear);
  std::fill_n(query->ray.time, kPacket, 0.0f);
  std::fill_n(query->ray.mask, kPacket, 0xffffffffu);
  std::fill_n(query->ray.id, kPacket, 0u);
  std::fill_n(query->ray.flags, kPacket, 0u);
}

// valid: -1 for rays to trace, 0 for the others; set to 0 for rays with a coordinate beyond kFarthest.
void Bvh::Impl::load_packet(const RayLanes& rays, size_t first, RTCRayHit16* query, int* valid) const {
  float* const o[] = {query->ray.org_x, query->ray.org_y, query->ray.org_z};
  float* const d[] = {query->ray.dir_x, query->ray.dir_y, query->ray.dir_z};
  for (int c = 0; c < 3; ++c) {
    for (size_t i = 0; i < kPacket; ++i) o[c][i] = rays.o[c][first + i] * to_embree;
    std::copy_n(rays.d[c] + first, kPacket, d[c]);
    for (size_t i = 0; i < kPacket; ++i)
      valid[i] &= -int{std::abs(o[c][i]) <= kFarthest} & -int{std::abs(d[c][i]) <= kFarthest};
  }
  // Embree asserts that rays are finite, also in lanes that it is told to leave out.
  for (size_t i = 0; i < kPacket; ++i)
    if (!valid[i])
      for (int c = 0; c < 3; ++c) o[c][i] = 0, d[c][i] = 1;
  std::fill_n(query->ray.tfar, kPacket, far_end(kInfinity));
  std::fill_n(query->hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
  std::fill_n(query->hit.instID[0], kPacket, RTC_INVALID_GEOMETRY_ID);
}

void Bvh::Impl::store_packet(const RTCRayHit16& query, size_t first, HitLanes* hits) const {
  for (size_t i = 0; i < kPacket; ++i) hits->t[first + i] = query.ray.tfar[i] * to_scene;
  std::copy_n(query.hit.u, kPacket, hits->u + first);
  std::copy_n(query.hit.v, kPacket, hits->v + first);
  std::copy_n(query.hit.primID, kPacket, hits->primitive + first);
  std::copy_n(query.hit.geomID, kPacket, hits->shape + first);
  if (!instances) return;
  for (size_t i = 0; i < kPacket; ++i) {
    const unsigned instance = query.hit.instID[0][i];
    if (instance != RTC_INVALID_GEOMETRY_ID) hits->shape[first + i] = instance;
  }
}

void Bvh::intersect(const RayLanes& rays, size_t count, HitLanes* hits, RayOrder order) const {
  const bool coherent = impl_->coherent || order == RayOrder::kNeighbours;
  RTCRayHit16 query;
  alignas(64) int valid[kPacket];
  impl_->start_packets(&query);
  for (size_t first = 0; first < count; first += kPacket) {
    for (size_t i = 0; i < kPacket; ++i) valid[i] = first + i < count ? -1 : 0;
    impl_->load_packet(rays, first, &query, valid);
    embree_intersect(impl_->embree.scene, valid, coherent, &query);
    impl_->store_packet(query, first, hits);
  }
}

bool Bvh::occluded(const Ray& ray) const {
  RTCRay query;
  if (!fill(query, ray, impl_->to_embree)) return false;
  embree_occluded(impl_->embree.scene, &query);
  return query.tfar == kEmbreeOccluded;
}

bool Bvh::intersect(const Ray& ray, SurfaceInteraction* si) const {
  const Hit hit = intersect(ray);
  if (!hit.valid()) return false;
  *si = make_interaction(scene_->shapes, ray, hit);
  return true;
}

uint64_t Bvh::memory_bytes() const {
  const int64_t own = std::max<int64_t>(0, impl_->bytes.load(std::memory_order_relaxed));
  return static_cast<uint64_t>(own) + (interfaces_ ? interfaces_->memory_bytes() : 0);
}

}  // namespace kaustik::accel
