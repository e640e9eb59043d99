#include "core/math/vec.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace kaustik {
namespace {

TEST(UnitVector, HasTheSameBitsAtAnyScale) {
  test::Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Vector3 v = random.uniform(0.5f, 2) * random.direction();
    // Above 2^-100, no component loses bits unless it is smaller than a rounding of the length.
    for (int k = -100; k <= 120; ++k)
      EXPECT_EQ(unit_vector(std::ldexp(1.0f, k) * v), glm::normalize(v)) << "2^" << k;
  }
}

TEST(UnitVector, IsTheXAxisForVectorsWithoutADirection) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (const Vector3& v : {Vector3(0), Vector3(0, kInfinity, 0), Vector3(kNan, 1, 1), Vector3(1, 1, kNan)})
    EXPECT_EQ(unit_vector(v), Vector3(1, 0, 0));
  EXPECT_EQ(unit_vector({0, std::numeric_limits<float>::denorm_min(), 0}), Vector3(0, 1, 0));
}

}  // namespace
}  // namespace kaustik
