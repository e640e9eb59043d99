#include "photon/map/morton.h"

#include <gtest/gtest.h>

#include "photon/map/morton_lanes.h"
#include "tests/photon/support/photon_sets.h"

namespace kaustik::photon {
namespace {

TEST(Morton, InterleavesBitByBit) {
  PhotonMaker make(3);
  for (int i = 0; i < 1000; ++i) {
    const MortonCell cell{make.bits() & kMortonMax, make.bits() & kMortonMax, make.bits() & kMortonMax};
    uint64_t expected = 0;
    for (uint32_t bit = 0; bit < uint32_t(kMortonBits); ++bit) {
      for (uint32_t axis = 0; axis < 3; ++axis)
        expected |= uint64_t(cell[axis] >> bit & 1) << (3 * bit + axis);
    }
    ASSERT_EQ(morton_key(cell), expected);
  }
}

// Every length leaves a different remainder for the last vector; some coordinates are clamped.
TEST(Morton, KeysInLanesMatchTheScalarKeys) {
  PhotonMaker make(12);
  const MortonCube cube = MortonCube::around({Point3(-1), Point3(2)});
  const float special[] = {kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN(), 0, -0.0f,
                           1e30f,     1e-40f};
  const auto coordinate = [&] {
    return make.bits() % 8 == 0 ? special[make.bits() % 7] : 5 * make.uniform() - 2;
  };
  for (size_t size = 0; size < 600; size += size < 40 ? 1 : 37) {
    std::vector<PhotonRecord> records(size);
    std::vector<float> x(size), y(size), z(size);
    std::vector<uint64_t> expected(size), of_columns(size), of_records(size);
    for (size_t i = 0; i < size; ++i) {
      records[i] = {x[i] = coordinate(), y[i] = coordinate(), z[i] = coordinate(), 1, 2, 3};
      expected[i] = morton_key(cube.cell({x[i], y[i], z[i]}));
    }
    morton_keys(cube, x.data(), y.data(), z.data(), of_columns);
    morton_keys(cube, records.data(), of_records);
    ASSERT_EQ(of_columns, expected);
    ASSERT_EQ(of_records, expected);
  }
}

TEST(MortonCube, ContainsTheBoundsAwayFromItsFaces) {
  PhotonMaker make(4);
  for (int i = 0; i < 1000; ++i) {
    Bounds3 bounds;
    for (int k = 0; k < 2; ++k) {
      bounds.add(Point3(make.uniform(), make.uniform(), make.uniform()) *
                 std::ldexp(1.0f, int(make.bits() % 40) - 20));
    }
    const MortonCube cube = MortonCube::around(bounds);
    int exponent;
    ASSERT_EQ(std::frexp(cube.size, &exponent), 0.5f) << "a power of two";
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_GT(cube.to_cells(bounds.min[axis], axis), 0);
      ASSERT_LT(cube.to_cells(bounds.max[axis], axis), float(kMortonMax));
    }
  }
}

TEST(MortonCube, KeysStayTheSameUnderScalingByPowersOfTwo) {
  PhotonMaker make(5);
  std::vector<Point3> points;
  Bounds3 bounds;
  for (int i = 0; i < 1000; ++i) {
    points.push_back(Point3(-0.3f, 7, 1e-3f) +
                     3.0f * Vector3(make.uniform(), make.uniform(), make.uniform()));
    bounds.add(points.back());
  }
  const MortonCube cube = MortonCube::around(bounds);
  for (const int exponent : {-40, -3, 1, 40}) {
    const float scale = std::ldexp(1.0f, exponent);
    const MortonCube scaled = MortonCube::around({bounds.min * scale, bounds.max * scale});
    for (const Point3& p : points) ASSERT_EQ(morton_key(scaled.cell(p * scale)), morton_key(cube.cell(p)));
  }
}

TEST(MortonCube, QuantisationIsMonotoneAndClamps) {
  const MortonCube cube = MortonCube::around({Point3(-1), Point3(2)});
  EXPECT_EQ(cube.quantise(-kInfinity, 0), 0u);
  EXPECT_EQ(cube.quantise(kInfinity, 0), kMortonMax);
  EXPECT_EQ(cube.quantise(std::numeric_limits<float>::quiet_NaN(), 0), 0u);
  PhotonMaker make(6);
  for (int i = 0; i < 1000; ++i) {
    const float a = 5 * make.uniform() - 2, b = 5 * make.uniform() - 2;
    EXPECT_LE(cube.quantise(std::min(a, b), 1), cube.quantise(std::max(a, b), 1));
  }
}

TEST(MortonCube, EmptyOrInfiniteBoundsGiveTheUnitCube) {
  EXPECT_EQ(MortonCube::around(Bounds3{}), MortonCube{});
  EXPECT_EQ(MortonCube::around({Point3(0), Point3(kInfinity)}), MortonCube{});
}

}  // namespace
}  // namespace kaustik::photon
