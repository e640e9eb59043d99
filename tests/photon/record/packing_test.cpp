#include "photon/record/packing.h"

#include <gtest/gtest.h>

#include "tests/photon/support/photon_sets.h"
#include "tests/support/packed_flux.h"

namespace kaustik::photon {
namespace {

float angle(const Vector3& a, const Vector3& b) {
  return 2 * std::asin(std::min(1.0f, 0.5f * glm::length(a - b)));
}

// Largest angle between a unit vector and its unpacked octahedral map of 2 x `bits` bits. Both coordinates
// are rounded to multiples of 1/M, M = 2^(bits - 1) - 1 (so that zero is a value), so each moves by up to h =
// 1/(2 M). On a face of the octahedron |x| + |y| + |z| = 1 the third coordinate moves by at most the sum of
// the two, so the point moves by at most sqrt(1 + 1 + 4) h. The face's plane is 1/sqrt(3) from the origin, so
// a length L in it is seen under an angle of at most sqrt(3) L; across an edge between faces the parts add
// up. The worst case, sqrt(18) h, is the centre of a face. Computing in floats moves the scaled coordinate,
// below 2^16, by less than 3 % of h: five roundings of 2^-24 M before the scaling, and 2^-9 + 2^-10 after it.
float octahedral_error(int bits) {
  const float h = 0.5f / float((1 << (bits - 1)) - 1);
  return 1.03f * std::sqrt(18.0f) * h;
}
const float kDirectionError = octahedral_error(16);  // 6.7e-5 rad
const float kNormalError = octahedral_error(8);      // 0.0172 rad

TEST(Packing, DirectionsAreAccurate) {
  PhotonMaker make(9);
  for (int i = 0; i < 100000; ++i) {
    const Vector3 w = make.direction();
    ASSERT_LT(angle(unpack_direction(pack_direction(w)), w), kDirectionError);
    ASSERT_LT(angle(unpack_surface_normal(pack_surface(w, 3)), w), kNormalError);
  }
}

TEST(Packing, AxesAreExact) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0f, 1.0f}) {
      Vector3 w(0);
      w[axis] = sign;
      EXPECT_EQ(unpack_direction(pack_direction(w)), w);
      EXPECT_EQ(unpack_surface_normal(pack_surface(w, 0)), w);
    }
  }
}

TEST(Packing, GroupsAreKeptModulo65536) {
  EXPECT_EQ(pack_surface({0, 0, 1}, 65537) >> 16, 1u);
  EXPECT_EQ(pack_surface({0, 0, 1}, 65535) >> 16, 65535u);
}

TEST(Packing, FluxIsWithinTheSharedExponentsBound) {
  PhotonMaker make(10);
  for (int i = 0; i < 100000; ++i) {
    const Rgb c =
        Rgb(make.uniform(), make.uniform(), make.uniform()) * std::ldexp(1.0f, int(make.bits() % 30) - 13);
    if (max_component(c) < 0x1p-16f || max_component(c) > kRgb9e5Max) continue;
    const Rgb back = unpack_rgb9e5(pack_rgb9e5(c));
    for (int k = 0; k < 3; ++k)
      ASSERT_LE(std::abs(back[k] - c[k]), max_component(c) * test::kPackedFluxError) << c.x;
  }
}

TEST(Packing, ExtremeFluxesAreClamped) {
  EXPECT_EQ(unpack_rgb9e5(pack_rgb9e5(Rgb(1e30f, kInfinity, 0))), Rgb(kRgb9e5Max, kRgb9e5Max, 0));
  EXPECT_EQ(pack_rgb9e5(Rgb(-1, std::numeric_limits<float>::quiet_NaN(), 1e-30f)), 0u);
  EXPECT_EQ(unpack_rgb9e5(pack_rgb9e5(Rgb(1, 0.5f, 0.25f))), Rgb(1, 0.5f, 0.25f));
}

// The mean of many different fluxes is off by far less than one of them: the format then adds noise, not a
// tint. The error of one flux is uniform over a step of at most 1/256 of the largest channel: standard
// deviation 1/(256 sqrt(12)).
TEST(Packing, TotalFluxIsPreserved) {
  constexpr int kCount = 100000;
  PhotonMaker make(11);
  const float flux_unit = 0x1p-13f;
  glm::dvec3 exact(0), stored(0);
  for (int i = 0; i < kCount; ++i) {
    Photon photon = make.on_wall();
    photon.flux *= flux_unit;
    exact += glm::dvec3(photon.flux);
    stored += glm::dvec3(unpack(pack(photon, flux_unit), flux_unit).flux);
  }
  const double sigma = double(flux_unit) / (256 * std::sqrt(12.0)) * std::sqrt(double(kCount));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(stored[c], exact[c], 5 * sigma);
}

TEST(Packing, NormalsCountWithin60Degrees) {
  PhotonMaker make(12);
  for (int i = 0; i < 20000; ++i) {
    const Normal3 stored = make.direction(), n = make.direction();
    const float cosine = glm::dot(stored, n);
    // A cosine changes by at most the change of its angle.
    if (std::abs(cosine - kNormalCosine) < kNormalError) continue;
    EXPECT_EQ(normal_counts(pack_surface(stored, 0), n), cosine > kNormalCosine);
  }
}

TEST(Packing, PositionGroupAndDirectionSurvive) {
  PhotonMaker make(13);
  const Photon photon = make.on_wall();
  const Photon back = unpack(pack(photon, 0.25f), 0.25f);
  EXPECT_EQ(back.p, photon.p);
  EXPECT_EQ(back.n, photon.n);
  EXPECT_EQ(back.surface_group, photon.surface_group);
  EXPECT_LT(angle(back.wi, photon.wi), kDirectionError);
}

}  // namespace
}  // namespace kaustik::photon
