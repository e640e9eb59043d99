// What is computed in SIMD lanes against the scalar code that defines it.

#include <gtest/gtest.h>

#include <cstring>

#include "core/bsdf/lambertian.h"
#include "photon/diffuse_lanes.h"
#include "photon/record_sink.h"
#include "tests/photon/photon_sets.h"

namespace kaustik::photon {
namespace {

// Triangles of all sizes and proportions, one of them degenerate, hit from both sides.
struct Vertices {
  std::vector<Shape> shapes;
  std::vector<Hit> hits;
  std::vector<Vector3> d;
  std::vector<Rgb> flux, reflectance;
};

Vertices make_vertices(uint64_t seed) {
  PhotonMaker make(seed);
  Vertices v;
  for (uint32_t k = 0; k < DiffuseLanes::kLanes; ++k) {
    const float size = std::ldexp(1.0f, int(make.bits() % 60) - 40);
    const Point3 p = std::ldexp(1.0f, int(make.bits() % 20) - 10) * make.direction();
    TriangleMesh mesh;
    mesh.P = {p, p + size * make.direction(), k == 5 ? p : p + size * make.direction()};
    mesh.indices = {{0, 1, 2}};
    Shape shape;
    shape.geometry = mesh;
    shape.flip_normal = k % 3 == 0;
    v.shapes.push_back(shape);
    v.hits.push_back({1, k, 0, {0.5f * make.uniform(), 0.5f * make.uniform()}});
    v.d.push_back(make.direction());
    v.flux.push_back({make.uniform(), make.uniform(), make.uniform()});
    // Some reflect nothing, some more than all.
    v.reflectance.push_back(k == 7 ? Rgb(0) : Rgb(make.uniform(), make.uniform(), 1.1f * make.uniform()));
  }
  return v;
}

void fill(const Vertices& v, DiffuseLanes& lanes) {
  for (size_t k = 0; k < DiffuseLanes::kLanes; ++k) {
    const auto& mesh = std::get<TriangleMesh>(v.shapes[k].geometry);
    DiffuseLanes::set(lanes.ray.o, k, Point3(0));
    DiffuseLanes::set(lanes.ray.d, k, v.d[k]);
    DiffuseLanes::set(lanes.flux, k, v.flux[k]);
    lanes.hit.set(k, v.hits[k]);
    lanes.set_vertex(k, mesh, v.shapes[k].flip_normal, v.reflectance[k]);
  }
}

TEST(DiffuseLanes, PointsAreThoseOfMakeInteraction) {
  for (uint64_t seed = 0; seed < 50; ++seed) {
    const Vertices v = make_vertices(seed);
    DiffuseLanes lanes{};
    fill(v, lanes);
    locate_lanes(lanes, DiffuseLanes::kLanes);
    for (size_t k = 0; k < DiffuseLanes::kLanes; ++k) {
      const SurfaceInteraction si = make_interaction(v.shapes, {}, v.hits[k]);
      ASSERT_EQ(DiffuseLanes::get(lanes.p, k), si.p);
      ASSERT_EQ(lanes.p_error[k], si.p_error);
      ASSERT_EQ(DiffuseLanes::get(lanes.n, k), si.n);
      ASSERT_EQ(lanes.cos_in[k], glm::dot(v.d[k], si.n));
      ASSERT_EQ(DiffuseLanes::get(lanes.facing, k), glm::dot(v.d[k], si.n) > 0 ? -si.n : si.n);
    }
  }
}

// Scalar: Lambertian::sample_f about n, one Newton step towards unit length, Russian roulette.
void expect_scattered(const DiffuseLanes& lanes, const Vertices& v, const float (&u)[3], size_t k) {
  const SurfaceInteraction si = make_interaction(v.shapes, {}, v.hits[k]);
  const Frame frame = Frame::from_z(si.n);
  const auto sample = Lambertian{v.reflectance[k]}.sample_f(frame.to_local(-v.d[k]), 0, {u[0], u[1]},
                                                            TransportMode::kImportance);
  const Rgb next = v.reflectance[k] * v.flux[k];
  const float before = max_component(v.flux[k]), after = max_component(next);
  const bool alive =
      sample && length_squared(si.n) > 0 && after > 0 && (after >= before || u[2] * before < after);
  ASSERT_EQ(lanes.fate[k], alive ? DiffuseLanes::kAlive : DiffuseLanes::kAbsorbed) << k;
  if (!alive) return;
  const Vector3 w = frame.to_world(sample->wi);
  const Vector3 wi = (1.5f - 0.5f * length_squared(w)) * w;
  ASSERT_EQ(DiffuseLanes::get(lanes.next.d, k), wi);
  ASSERT_EQ(DiffuseLanes::get(lanes.next.o, k), si.spawn(wi).o);
  ASSERT_EQ(DiffuseLanes::get(lanes.next_flux, k), (after < before ? before / after : 1.0f) * next);
}

TEST(DiffuseLanes, SegmentsAreThoseOfTheScalarCode) {
  for (uint64_t seed = 0; seed < 50; ++seed) {
    const Vertices v = make_vertices(seed);
    PhotonMaker make(1000 + seed);
    DiffuseLanes lanes{};
    fill(v, lanes);
    SobolLanes numbers{};
    for (auto& column : numbers.u) {
      for (float& u : column) u = make.uniform();
    }
    locate_lanes(lanes, DiffuseLanes::kLanes);
    scatter_lanes(lanes, numbers, DiffuseLanes::kLanes);
    for (size_t k = 0; k < DiffuseLanes::kLanes; ++k) {
      expect_scattered(lanes, v, {numbers.u[0][k], numbers.u[1][k], numbers.u[2][k]}, k);
    }
  }
}

TEST(DiffuseLanes, WhatIsNoFluxIsInvalid) {
  Vertices v = make_vertices(3);
  v.reflectance[0] = Rgb(1, kInfinity, 1);
  v.reflectance[1] = Rgb(1, 1, -1);
  v.reflectance[2] = Rgb(1, 1, std::numeric_limits<float>::quiet_NaN());
  DiffuseLanes lanes{};
  fill(v, lanes);
  SobolLanes numbers{};
  for (auto& column : numbers.u) std::fill(std::begin(column), std::end(column), 0.25f);
  locate_lanes(lanes, 8);
  scatter_lanes(lanes, numbers, 8);
  for (size_t k = 0; k < 3; ++k) EXPECT_EQ(lanes.fate[k], DiffuseLanes::kInvalid);
  EXPECT_EQ(lanes.fate[3], DiffuseLanes::kAlive);
}

// Ordinary photons and those at the ends of the formats, in numbers that are no multiple of the lanes.
TEST(RecordPacker, RecordsAreThoseOfPack) {
  PhotonMaker make(77);
  constexpr float kUnit = 0x1p-20f;
  RecordPacker packer(kUnit);
  std::vector<PhotonRecord> records, expected;
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

// Whole lanes and single photons end in the records that pack() makes of them.
TEST(RecordSink, LanesAreThoseOfPack) {
  const Vertices v = make_vertices(9);
  DiffuseLanes lanes{};
  fill(v, lanes);
  locate_lanes(lanes, DiffuseLanes::kLanes);
  alignas(64) uint32_t groups[DiffuseLanes::kLanes];
  uint8_t kinds[DiffuseLanes::kLanes];
  constexpr float kUnit = 0x1p-3f;
  constexpr size_t kCount = 61;
  RecordsByKind records, expected;
  for (size_t k = 0; k < DiffuseLanes::kLanes; ++k) {
    groups[k] = static_cast<uint32_t>(70000 * k);
    kinds[k] = static_cast<uint8_t>(k % (kPhotonKinds + 1));  // every fifth leaves nothing
    if (k >= kCount || kinds[k] == kPhotonKinds) continue;
    const Photon photon{DiffuseLanes::get(lanes.p, k), -v.d[k], v.flux[k], DiffuseLanes::get(lanes.facing, k),
                        groups[k]};
    expected[kinds[k]].push_back(pack(photon, kUnit));
  }
  RecordSink sink(kUnit, records);
  sink(lanes, kinds, groups, kCount);
  sink.flush();
  for (size_t k = 0; k < kPhotonKinds; ++k) {
    ASSERT_EQ(records[k].size(), expected[k].size());
    EXPECT_EQ(std::memcmp(records[k].data(), expected[k].data(), records[k].size() * sizeof(PhotonRecord)),
              0);
  }
}

}  // namespace
}  // namespace kaustik::photon
