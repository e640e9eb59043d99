// Tests photons in media that scatter.

#include <gtest/gtest.h>

#include "photon/shoot/shoot.h"
#include "tests/photon/support/same_records.h"
#include "tests/photon/support/trace_scenes.h"
#include "tests/support/packed_flux.h"
#include "tests/support/statistics.h"

namespace kaustik::photon {
namespace {

using namespace test;

constexpr double kErrors = 5;  // standard errors

double total_flux(const PhotonBuffer& buffer, int c) {
  double sum = 0;
  for (const PhotonRecord& record : buffer.records) sum += double(unpack(record, buffer.flux_unit).flux[c]);
  return sum;
}

// A lamp in a medium without end. Of its power, the n-th scattering leaves albedo^n; the first leaves no
// photon.
TEST(PhotonsInMedia, LeaveAGeometricSeries) {
  Scene scene;
  scene.materials = {Lambertian{Rgb(0)}};
  scene.shapes = {sphere({1e4f, 0, 0}, 1, 0)};  // the scene must not be empty
  scene.lights = {PointLight{{0, 0, 0}, Rgb(1, 2, 3)}};
  const Medium medium{{1, 0.5f, 0.25f}, {1, 1.5f, 0.75f}, 0.4f};
  fill(scene, medium);
  std::vector<double> found[3];
  for (uint64_t seed = 0; seed < 8; ++seed) {
    TraceSettings settings = settings_for(20'000, kAllKinds);
    settings.seed = seed;
    settings.max_bounces = 12;
    const ShootResult shot = shoot(scene, accel::Bvh(scene), settings);
    EXPECT_EQ(shot.counters.energy.unaccounted(), 0);
    for (int c = 0; c < 3; ++c)
      found[c].push_back(total_flux(shot.buffers[size_t(PhotonKind::kMediumIndirect)], c));
    EXPECT_TRUE(shot.buffers[size_t(PhotonKind::kMediumCaustic)].records.empty());
  }
  for (int c = 0; c < 3; ++c) {
    const double albedo = double(medium.sigma_s[c] / medium.sigma_t()[c]);
    double expected = 0;
    for (int n = 2; n <= 12; ++n) expected += 4 * double(kPi) * (c + 1) * std::pow(albedo, n);
    const Estimate e = estimate_of(found[c]);
    EXPECT_NEAR(e.mean, expected, kErrors * e.standard_error + 6 * kPackedFluxError * expected) << c;
    EXPECT_LT(e.standard_error, 0.02 * expected);
  }
}

// A caustic in a thin medium leaves a photon on each of its segments, wherever the photon itself is
// scattered.
TEST(PhotonsInMedia, CausticsLeaveOneOnEachSegment) {
  Scene scene = full_room();
  for (Shape& shape : scene.shapes)
    shape.media = {kVacuum, std::holds_alternative<Dielectric>(scene.materials[shape.material].typical())
                                ? MediumIndex(1)
                                : kVacuum};
  fill(scene, {Rgb(0.01f), Rgb(0.02f)});
  scene.camera_medium = 1;
  KindMask caustics;
  caustics.caustic = caustics.medium_caustic = true;
  const ShootResult shot = shoot(scene, accel::Bvh(scene), settings_for(20'000, caustics));
  const auto stored = shot.counters.stored;
  EXPECT_GE(stored[size_t(PhotonKind::kMediumCaustic)], stored[size_t(PhotonKind::kCaustic)]);
  EXPECT_GT(stored[size_t(PhotonKind::kCaustic)], 500u);
  // In a medium so thin, the flux that a segment leaves is that of the photon times sigma_s times its length,
  // of a room 2 m wide.
  const PhotonBuffer &in_medium = shot.buffers[size_t(PhotonKind::kMediumCaustic)],
                     &on_walls = shot.buffers[size_t(PhotonKind::kCaustic)];
  const double ratio = total_flux(in_medium, 0) / total_flux(on_walls, 0);
  EXPECT_GT(ratio, 0.02 * 0.5);
  EXPECT_LT(ratio, 0.02 * 4);
}

// The records of a shoot in fog in which caustics leave so many photons on each segment.
ShootResult shoot_in_fog(const Rgb& sigma_s, uint32_t on_segments, uint64_t seed = 0) {
  Scene scene = full_room();
  fill(scene, {Rgb(0.2f), sigma_s});
  TraceSettings settings = settings_for(5'000, kAllKinds);
  settings.seed = seed;
  settings.photons_on_segments = on_segments;
  return shoot(scene, accel::Bvh(scene), settings);
}

// The photons of a segment in grey fog lie on its ray, one in each part from which the same light comes: what
// is left of the light falls by the same amount from one to the next. Together they have the flux that one
// has by itself, and all other photons are what they are without them.
TEST(PhotonsInMedia, PhotonsOfASegmentShareItsLight) {
  constexpr uint32_t kMany = 8;
  constexpr float kSigmaT = 0.7f;
  const ShootResult one = shoot_in_fog(Rgb(0.5f), 1), many = shoot_in_fog(Rgb(0.5f), kMany);
  EXPECT_EQ(one.counters.energy.in_media, many.counters.energy.in_media);
  for (size_t k = 0; k < kPhotonKinds; ++k) {
    const bool same = same_records(one.buffers[k].records, many.buffers[k].records);
    EXPECT_EQ(same, PhotonKind(k) != PhotonKind::kMediumCaustic) << kPhotonKindNames[k];
  }
  const PhotonBuffer &single = one.buffers[size_t(PhotonKind::kMediumCaustic)],
                     &shared = many.buffers[size_t(PhotonKind::kMediumCaustic)];
  ASSERT_GT(single.records.size(), 200u);
  ASSERT_EQ(shared.records.size(), kMany * single.records.size());
  for (size_t i = 0; i < single.records.size(); ++i) {
    const Photon alone = unpack(single.records[i], single.flux_unit);
    const auto of = [&](size_t j) { return unpack(shared.records[kMany * i + j], shared.flux_unit); };
    const auto left = [&](size_t j) { return std::exp(-kSigmaT * glm::distance(of(j).p, of(0).p)); };
    double flux = 0;
    for (size_t j = 0; j < kMany; ++j) {
      EXPECT_EQ(of(j).wi, alone.wi);
      flux += double(of(j).flux.x);
      // Directions are packed with some 15 bits a coordinate, and the room is 3.5 m across.
      EXPECT_LT(glm::length(glm::cross(of(j).p - alone.p, alone.wi)), 3.5f * 0x1p-13f);
      EXPECT_NEAR(left(j), 1 - float(j) * (1 - left(1)), 20 * kMany * std::numeric_limits<float>::epsilon());
    }
    EXPECT_NEAR(flux, double(alone.flux.x), 2 * kPackedFluxError * flux);
  }
}

// In coloured fog, where a photon's place is drawn for one of its channels, so on average.
TEST(PhotonsInMedia, ManyPhotonsOnASegmentKeepTheFlux) {
  std::vector<double> difference[3], flux[3];
  for (uint64_t seed = 0; seed < 8; ++seed) {
    const ShootResult one = shoot_in_fog({0.2f, 0.8f, 2}, 1, seed),
                      many = shoot_in_fog({0.2f, 0.8f, 2}, 5, seed);
    for (int c = 0; c < 3; ++c) {
      const auto kind = size_t(PhotonKind::kMediumCaustic);
      flux[c].push_back(total_flux(one.buffers[kind], c));
      difference[c].push_back(total_flux(many.buffers[kind], c) - flux[c].back());
    }
  }
  for (int c = 0; c < 3; ++c) {
    const Estimate e = estimate_of(difference[c]), all = estimate_of(flux[c]);
    EXPECT_NEAR(e.mean, 0, kErrors * e.standard_error + 2 * kPackedFluxError * all.mean) << c;
    EXPECT_LT(e.standard_error, 0.02 * all.mean) << c;
  }
}

// Half as many photons as are emitted, divided among the segments, and no more than a segment may have.
TEST(PhotonsInMedia, SegmentsGetMorePhotonsWhereTheyAreRare) {
  EXPECT_EQ(photons_on_segments(1000, 5000), 1u);
  EXPECT_EQ(photons_on_segments(1000, 300), 1u);
  EXPECT_EQ(photons_on_segments(1000, 100), 5u);
  EXPECT_EQ(photons_on_segments(1000, 1), kMostOnSegment);
  EXPECT_EQ(photons_on_segments(1000, 0), kMostOnSegment);
}

// Behind one medium lies another: caustic photons are left there as often whether the photons themselves are
// scattered in the first one or not.
TEST(PhotonsInMedia, CausticsAreLeftBehindAMediumThatScatters) {
  Scene scene = full_room();
  const auto is_glass = [&](const Shape& s) {
    return std::holds_alternative<Dielectric>(scene.materials[s.material].typical());
  };
  for (Shape& shape : scene.shapes)
    if (is_glass(shape)) shape.media = {kVacuum, 1};
  auto interfaces = std::make_shared<Scene>();
  interfaces->shapes = {parallelogram({-1, -0.9f, -1}, {0, 0, 2}, {2, 0, 0})};  // above the floor, facing up
  interfaces->shapes[0].media = {2, 1};
  interfaces->bounds.add(bounds_of(interfaces->shapes[0]));
  scene.interfaces = interfaces;
  scene.media = {Medium{}, Medium{Rgb(0), Rgb(1)}, Medium{Rgb(0), Rgb(8)}};
  scene.light_media.assign(scene.lights.size(), 1);
  finalize_scene(scene);
  const auto flux_below = [&](bool with_indirect) {
    std::vector<double> found;
    for (uint64_t seed = 0; seed < 8; ++seed) {
      KindMask kinds;
      kinds.medium_caustic = true;
      kinds.indirect = kinds.medium_indirect = with_indirect;
      TraceSettings settings = settings_for(20'000, kinds);
      settings.seed = seed;
      const ShootResult shot = shoot(scene, accel::Bvh(scene), settings);
      const PhotonBuffer& buffer = shot.buffers[size_t(PhotonKind::kMediumCaustic)];
      double sum = 0;
      for (const PhotonRecord& record : buffer.records) {
        const Photon photon = unpack(record, buffer.flux_unit);
        if (photon.surface_group != 2) continue;
        EXPECT_LE(photon.p.y, -0.9f + 1e-4f);
        sum += double(photon.flux.x);
      }
      found.push_back(sum);
    }
    return estimate_of(found);
  };
  const Estimate apart = flux_below(false), together = flux_below(true);
  EXPECT_NEAR(apart.mean, together.mean, kErrors * std::hypot(apart.standard_error, together.standard_error));
  EXPECT_LT(together.standard_error, 0.1 * together.mean);
}

// What is stored in the medium names it, and lies in it.
TEST(PhotonsInMedia, KnowTheirMedium) {
  Scene scene = full_room();
  fill(scene, {Rgb(0.2f), Rgb(0.5f)});
  const ShootResult shot = shoot(scene, accel::Bvh(scene), settings_for(5'000, kAllKinds));
  for (const PhotonKind kind : {PhotonKind::kMediumCaustic, PhotonKind::kMediumIndirect}) {
    const PhotonBuffer& buffer = shot.buffers[size_t(kind)];
    EXPECT_GT(buffer.records.size(), 100u);
    for (const PhotonRecord& record : buffer.records) {
      const Photon photon = unpack(record, buffer.flux_unit);
      EXPECT_EQ(photon.surface_group, 1u);
      EXPECT_LE(max_abs_component(photon.p), 1.0001f);
    }
  }
}

}  // namespace
}  // namespace kaustik::photon
