// Tests the code in SIMD lanes against the scalar code that defines its results.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "photon/trace/lanes/vertex_lanes.h"
#include "photon/trace/lanes/walker_queue.h"
#include "photon/trace/record_sink.h"
#include "tests/core/support/bsdf_examples.h"
#include "tests/photon/support/photon_sets.h"
#include "tests/support/shapes.h"

namespace kaustik::photon {
namespace {

// Triangles of all sizes and proportions, one of them degenerate, and ellipsoids, hit from both sides; each
// with a BSDF of its own.
struct Vertices {
  std::vector<Shape> shapes;
  std::vector<Material> materials;
  std::vector<Hit> hits;
  std::vector<Ray> rays;
  std::vector<Rgb> flux;

  const Bsdf& bsdf(size_t k) const { return materials[shapes[hits[k].shape].material].typical(); }
};

TriangleMesh make_triangle(PhotonMaker& make, bool degenerate) {
  const float size = std::ldexp(1.0f, int(make.bits() % 60) - 40);
  const Point3 p = std::ldexp(1.0f, int(make.bits() % 20) - 10) * make.direction();
  TriangleMesh mesh;
  mesh.P = {p, p + size * make.direction(), degenerate ? p : p + size * make.direction()};
  mesh.indices = {{0, 1, 2}};
  return mesh;
}

Sphere make_ellipsoid(PhotonMaker& make) {
  glm::dmat4 to_world(1);
  for (int c = 0; c < 3; ++c) {
    const Vector3 axis = std::ldexp(1.0f, int(make.bits() % 6) - 3) * make.direction();
    to_world[c] = {axis, 0};
  }
  to_world[3] = {4.0f * make.direction(), 1};
  return {Transform::from_matrix(to_world)};
}

Bsdf make_bsdf(PhotonMaker& make, uint32_t k) {
  // Some reflect nothing, and some have a reflectance above one.
  const Rgb reflectance = k == 7 ? Rgb(0) : Rgb(make.uniform(), make.uniform(), 1.1f * make.uniform());
  switch (k % 7) {
    case 1:
      return OrenNayar::from_sigma_degrees(reflectance, 40 * make.uniform());
    case 2:
      return Mirror{reflectance};
    case 3:
      return Dielectric{0.5f + 2 * make.uniform()};
    case 4:
      return Dielectric{1};
    default:
      return Lambertian{reflectance};
  }
}

Vertices make_vertices(uint64_t seed) {
  PhotonMaker make(seed);
  Vertices v;
  for (uint32_t k = 0; k < kPhotonLanes; ++k) {
    Shape shape;
    shape.geometry = make_triangle(make, k == 5);
    if (k % 4 == 2) shape.geometry = make_ellipsoid(make);
    shape.flip_normal = k % 3 == 0;
    shape.material = k;
    shape.surface_group = 70000 * k;
    v.shapes.push_back(shape);
    v.materials.push_back(make_bsdf(make, k));
    // Every eighth ray meets the same ellipsoid.
    v.hits.push_back(
        {1 + make.uniform(), k % 8 == 2 ? 10 : k, 0, {0.5f * make.uniform(), 0.5f * make.uniform()}});
    v.rays.push_back({4.0f * make.direction(), make.direction()});
    v.flux.push_back({make.uniform(), make.uniform(), make.uniform()});
  }
  return v;
}

void fill(const Vertices& v, VertexLanes& lanes) {
  const SurfaceTable surfaces(v.shapes, v.materials);
  for (size_t k = 0; k < kPhotonLanes; ++k) {
    set_lane(lanes.ray.o, k, v.rays[k].o);
    set_lane(lanes.ray.d, k, v.rays[k].d);
    set_lane(lanes.flux, k, v.flux[k]);
    lanes.hit.set(k, v.hits[k]);
    lanes.set_vertex(k, surfaces.row(v.hits[k].shape));
  }
}

// Lane 6 has a ray from so far away that rounding loses the point of its hit, and lane 14 a large sphere.
void make_extreme(Vertices& v) {
  constexpr float kFar = 0x1p60f, kLarge = 0x1p65f;
  v.shapes[6] = test::sphere(Point3(0), 0.5f, 6);
  v.rays[6] = {{0, 0, kFar}, {0, 0, -1}};
  v.hits[6].t = kFar;
  v.shapes[14] = test::sphere(Point3(0), kLarge, 14);
  v.rays[14] = {Point3(0), v.rays[14].d};
  v.hits[14].t = kLarge;
}

TEST(VertexLanes, PointsMatchMakeInteraction) {
  for (uint64_t seed = 0; seed < 50; ++seed) {
    Vertices v = make_vertices(seed);
    if (seed % 2 == 1) make_extreme(v);
    VertexLanes lanes{};
    fill(v, lanes);
    locate_lanes(lanes, v.shapes, kPhotonLanes);
    for (size_t k = 0; k < kPhotonLanes; ++k) {
      const SurfaceInteraction si = make_interaction(v.shapes, v.rays[k], v.hits[k]);
      const float cosine = glm::dot(v.rays[k].d, si.n);
      ASSERT_EQ(get_lane(lanes.p, k), si.p);
      ASSERT_EQ(lanes.p_error[k], si.p_error);
      ASSERT_EQ(get_lane(lanes.n, k), si.n);
      ASSERT_EQ(lanes.cos_in[k], cosine);
      ASSERT_EQ(get_lane(lanes.facing, k), cosine > 0 ? -si.n : si.n);
      ASSERT_EQ(lanes.surface_group[k], si.surface_group);
    }
  }
}

// The scalar reference: the BSDF's sample_f about n, one Newton step towards unit length, no light through
// the surface except by refraction, Russian roulette.
void expect_scattered(const VertexLanes& lanes, const Vertices& v, const float (&u)[4], size_t k) {
  const SurfaceInteraction si = make_interaction(v.shapes, v.rays[k], v.hits[k]);
  const Frame frame = Frame::from_z(si.n);
  const bool specular = is_specular(v.bsdf(k));
  const auto sample =
      sample_f(v.bsdf(k), frame.to_local(-v.rays[k].d), u[2], {u[0], u[1]}, TransportMode::kImportance);
  const Rgb next = sample ? sample->weight * v.flux[k] : Rgb(0);
  const float before = max_component(v.flux[k]), after = max_component(next);
  const Vector3 w = sample ? frame.to_world(sample->wi) : Vector3(0);
  const Vector3 wi = (1.5f - 0.5f * length_squared(w)) * w;
  const bool same_sides = sample && glm::dot(wi, si.n) * sample->wi.z > 0;
  const bool alive = same_sides && after > 0 && (after >= before || u[specular ? 3 : 2] * before < after);
  const bool draws_lobe = std::visit([]<class B>(const B&) { return B::kDrawsLobe; }, v.bsdf(k));
  ASSERT_EQ(draws_lobe, specular) << "lanes take the number for roulette behind that for the lobe";
  ASSERT_EQ(lanes.fate[k], alive ? VertexLanes::kAlive : VertexLanes::kAbsorbed) << k;
  if (!alive) return;
  ASSERT_EQ(get_lane(lanes.next.d, k), wi) << k;
  ASSERT_EQ(get_lane(lanes.next.o, k), si.spawn(wi).o);
  ASSERT_EQ(get_lane(lanes.next_flux, k), (after < before ? before / after : 1.0f) * next);
}

void expect_scattered(const Vertices& v, uint64_t seed) {
  PhotonMaker make(seed);
  VertexLanes lanes{};
  fill(v, lanes);
  SobolLanes numbers{};
  for (auto& column : numbers.u) {
    for (float& u : column) u = make.uniform();
  }
  locate_lanes(lanes, v.shapes, kPhotonLanes);
  scatter_lanes(lanes, numbers, 1, kPhotonLanes);
  for (size_t k = 0; k < kPhotonLanes; ++k) {
    if (lanes.traits[k] & kScalarTrait) continue;
    expect_scattered(lanes, v, {numbers.u[0][k], numbers.u[1][k], numbers.u[2][k], numbers.u[3][k]}, k);
  }
}

TEST(VertexLanes, SegmentsAreThoseOfTheScalarCode) {
  for (uint64_t seed = 0; seed < 50; ++seed) expect_scattered(make_vertices(seed), 1000 + seed);
}

// Every example of every BSDF, so that none can be computed in lanes without being compared.
TEST(VertexLanes, ExamplesOfAllBsdfsScatterAsInScalarCode) {
  std::set<size_t> in_lanes;
  for (const Bsdf& bsdf : kaustik::test::bsdf_examples()) {
    SCOPED_TRACE(std::string(name_of(bsdf)));
    for (uint64_t seed = 0; seed < 8; ++seed) {
      Vertices v = make_vertices(seed);
      for (Material& material : v.materials) material = bsdf;
      const SurfaceTable surfaces(v.shapes, v.materials);
      if (!(surfaces.row(0).traits & kScalarTrait)) in_lanes.insert(bsdf.index());
      expect_scattered(v, 2000 + seed);
    }
  }
  EXPECT_EQ(in_lanes.size(), 4u) << "types in lanes: diffuse, orennayar, mirror, smooth dielectric";
}

TEST(VertexLanes, NegativeOrNonFiniteFluxIsInvalid) {
  // With this seed, the triangles of these lanes are larger than the rounding of their corners: none is
  // degenerate.
  Vertices v = make_vertices(4);
  v.shapes[2].geometry = v.shapes[0].geometry;
  v.hits[2].shape = 2;
  // White flux, so that roulette with 0.25 keeps the photons of reflectance 0.5 and above.
  std::fill_n(v.flux.begin(), 4, Rgb(1));
  v.materials[0] = Lambertian{Rgb(1, kInfinity, 1)};
  v.materials[1] = Lambertian{Rgb(1, 1, -1)};
  v.materials[2] = Lambertian{Rgb(1, 1, std::numeric_limits<float>::quiet_NaN())};
  v.materials[3] = Lambertian{Rgb(0.5f)};
  VertexLanes lanes{};
  fill(v, lanes);
  SobolLanes numbers{};
  for (auto& column : numbers.u) std::fill(std::begin(column), std::end(column), 0.25f);
  locate_lanes(lanes, v.shapes, 8);
  scatter_lanes(lanes, numbers, 1, 8);
  for (size_t k = 0; k < 3; ++k) EXPECT_EQ(lanes.fate[k], VertexLanes::kInvalid) << k;
  EXPECT_EQ(lanes.fate[3], VertexLanes::kAlive);
}

// Walkers that are pushed to a queue, by rows or alone, come out unchanged, in groups that need not be full.
TEST(WalkerQueue, ReturnsWhatWasPushed) {
  PhotonMaker make(5);
  accel::RayLanes rays{};
  LaneColumn flux[3];
  WalkerLanes walkers{};
  for (size_t k = 0; k < WalkerLanes::kLanes; ++k) {
    set_lane(rays.o, k, make.direction());
    set_lane(rays.d, k, make.direction());
    set_lane(flux, k, make.direction());
    walkers.reversed_index[k] = static_cast<uint32_t>(make.bits());
    walkers.state[k] = k % 2 ? WalkState().behind_specular() : WalkState::straight();
  }
  WalkerRows rows;
  to_rows(rays, flux, walkers, WalkerLanes::kLanes, &rows);
  const auto queue = std::make_unique<WalkerQueue>();
  constexpr size_t kKept = 21;
  for (size_t k = 0; k < WalkerLanes::kLanes; ++k) {
    ASSERT_EQ(rows.octant[k], WalkerQueue::octant(get_lane(rays.d, k)));
    queue->push(rows, k, k % 3 == 1);
  }
  queue->push({1, 2, 3}, {4, 5, 6}, {7, 8, 9}, 10, WalkState::straight());
  ASSERT_EQ(queue->size(), kKept + 1);
  VertexLanes lanes{};
  WalkerLanes taken{};
  queue->take(1, lanes, taken);
  EXPECT_EQ(lanes.ray.get(0).o, Point3(1, 2, 3));
  EXPECT_EQ(lanes.ray.get(0).d, Vector3(4, 5, 6));
  EXPECT_EQ(get_lane(lanes.flux, 0), Rgb(7, 8, 9));
  EXPECT_EQ(taken.reversed_index[0], 10u);
  EXPECT_TRUE(taken.state[0].is_straight());
  queue->take(kKept, lanes, taken);
  for (size_t i = 0, k = 1; i < kKept; ++i, k += 3) {
    EXPECT_EQ(lanes.ray.get(i).o, rays.get(k).o);
    EXPECT_EQ(lanes.ray.get(i).d, rays.get(k).d);
    EXPECT_EQ(get_lane(lanes.flux, i), get_lane(flux, k));
    EXPECT_EQ(taken.reversed_index[i], walkers.reversed_index[k]);
    EXPECT_EQ(taken.state[i].kind(), walkers.state[k].kind());
    EXPECT_EQ(taken.state[i].rays(), walkers.state[k].rays());
  }
}

// Ordinary photons and photons at the limits of the formats, in numbers that are not multiples of the lanes.
TEST(RecordPacker, RecordsMatchPack) {
  PhotonMaker make(77);
  constexpr float kUnit = 0x1p-20f;
  RecordPacker packer(kUnit);
  PhotonRecords records, expected;
  for (int i = 0; i < 100003; ++i) {
    Photon photon;
    photon.p = make.direction();
    photon.wi = i % 7 == 0 ? Vector3(0, i % 2 ? 1 : -1, 0) : make.direction();
    photon.n = i % 11 == 0 ? Normal3(0) : make.direction();
    photon.flux =
        Rgb(make.uniform(), make.uniform(), make.uniform()) * std::ldexp(kUnit, int(make.bits() % 50) - 25);
    if (i % 13 == 0) photon.flux = Rgb(0, -1, std::numeric_limits<float>::quiet_NaN());
    photon.surface_group = uint32_t(make.bits());
    packer.add(photon, records);
    expected.push_back(pack(photon, kUnit));
  }
  packer.flush(records);
  ASSERT_EQ(records.size(), expected.size());
  EXPECT_EQ(std::memcmp(records.data(), expected.data(), records.size() * sizeof(PhotonRecord)), 0);
}

// Photons that are added in whole lanes or alone end up as the records that pack() makes.
TEST(RecordSink, LanesMatchPack) {
  const Vertices v = make_vertices(9);
  VertexLanes lanes{};
  fill(v, lanes);
  locate_lanes(lanes, v.shapes, kPhotonLanes);
  uint8_t kinds[kPhotonLanes];
  constexpr float kUnit = 0x1p-3f;
  constexpr size_t kCount = 61;
  RecordsByKind records, expected;
  for (size_t k = 0; k < kPhotonLanes; ++k) {
    kinds[k] = static_cast<uint8_t>(k % (kPhotonKinds + 1));  // every fifth leaves nothing
    if (k >= kCount || kinds[k] == kPhotonKinds) continue;
    const Photon photon{get_lane(lanes.p, k), -v.rays[k].d, v.flux[k], get_lane(lanes.facing, k),
                        lanes.surface_group[k]};
    expected[kinds[k]].push_back(pack(photon, kUnit));
  }
  RecordSink sink(kUnit, records);
  sink(lanes, kinds, kCount);
  sink.flush();
  for (size_t k = 0; k < kPhotonKinds; ++k) {
    ASSERT_EQ(records[k].size(), expected[k].size());
    EXPECT_EQ(std::memcmp(records[k].data(), expected[k].data(), records[k].size() * sizeof(PhotonRecord)),
              0);
  }
}

}  // namespace
}  // namespace kaustik::photon
