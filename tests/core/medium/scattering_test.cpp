// Tests the phase function and the distributions of where a medium scatters light.

#include <gtest/gtest.h>

#include "core/medium/free_path.h"
#include "core/medium/phase_function.h"
#include "core/sampling/sampler.h"
#include "tests/support/statistics.h"

namespace kaustik {
namespace {

using test::Mean;

constexpr double kErrors = 5;  // standard errors
constexpr int kSamples = 100'000;

// Integral over the sphere of fn(cos) times the phase function, by Simpson's rule in an angle: the lobes are
// smooth in it.
template <class Fn>
double integral(float g, const Fn& fn) {
  constexpr int kSteps = 20'000;
  double sum = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double theta = double(kPi) * i / kSteps, c = std::cos(theta);
    const double weight = i == 0 || i == kSteps ? 1 : i % 2 ? 4 : 2;
    sum += weight * fn(c) * double(phase(float(c), g)) * std::sin(theta);
  }
  return 2 * double(kPi) * sum * double(kPi) / (3.0 * kSteps);
}

class Phase : public ::testing::TestWithParam<float> {};

// Floats know cosines near 1 to 2^-24 only: there the thinnest lobe, of width 1 - g, is off by as much.
TEST_P(Phase, IntegratesToOneWithMeanCosineG) {
  const float g = GetParam();
  const double tolerance = 1e-5 + 0x1p-22 / std::pow(1 - std::abs(double(g)), 2);
  EXPECT_NEAR(integral(g, [](double) { return 1.0; }), 1, tolerance);
  EXPECT_NEAR(integral(g, [](double c) { return c; }), double(g), tolerance);
}

// The distribution function of the cosine (Pharr 2023, equation 11.10, inverted), and the deflection from d.
TEST_P(Phase, SamplesFollowIt) {
  const double g = double(GetParam());
  const Vector3 d = glm::normalize(Vector3(0.3f, -0.8f, 0.5f));
  Sampler sampler(7, 0);
  Mean below, along, across;
  const double median = g == 0 ? 0 : (1 + g * g - std::pow(1 - g * g, 2)) / (2 * g);
  for (int i = 0; i < kSamples; ++i) {
    Sampler s(7, uint64_t(i));
    const Vector3 w = sample_phase(d, GetParam(), s.next_2d());
    EXPECT_NEAR(glm::length(w), 1, 1e-5);
    const double c = double(glm::dot(w, d));
    below.add(c < median ? 1 : 0);
    along.add(c);
    across.add(double(glm::dot(w, glm::normalize(glm::cross(d, Vector3(0, 0, 1))))));
  }
  EXPECT_NEAR(below.mean, 0.5, kErrors * 0.5 / std::sqrt(double(kSamples)));
  EXPECT_NEAR(along.mean, g, kErrors * along.standard_error() + 1e-6);
  EXPECT_NEAR(across.mean, 0, kErrors * across.standard_error() + 1e-6);
}
INSTANTIATE_TEST_SUITE_P(G, Phase, ::testing::Values(0.0f, 1e-4f, 0.3f, -0.6f, 0.95f, -0.99f));

// The event of light that goes through one medium.
struct Event {
  bool scattered = false;
  float t = 0;
  Rgb weight{0};
};
Event draw(const Medium& medium, const Rgb& light, float distance, const Point2& u) {
  FreePath way(light, u);
  EXPECT_TRUE(way.rest() >= 0 && way.rest() < 1);
  const std::optional<float> t = way.pass(medium, distance);
  return t ? Event{true, *t, way.scattered(medium)} : Event{false, distance, way.passed()};
}

const Medium kMedium{{0.1f, 0, 2}, {0.3f, 1, 0}};
const Rgb kLight(1, 0.25f, 3);

// The mean weight of what is scattered, 1 - T times the albedo, and of what gets through, T; and the mean
// place of the former.
TEST(FreePath, WeightsHaveTheRightMeans) {
  for (const float distance : {0.2f, 3.0f, kInfinity}) {
    Mean scattered[3], passed[3], place[3];
    for (int i = 0; i < kSamples; ++i) {
      Sampler sampler(3, uint64_t(i));
      const Event way = draw(kMedium, kLight, distance, sampler.next_2d());
      EXPECT_LE(way.t, distance);
      for (int c = 0; c < 3; ++c) {
        scattered[c].add(way.scattered ? double(way.weight[c]) : 0);
        place[c].add(way.scattered ? double(way.weight[c] * way.t) : 0);
        passed[c].add(way.scattered ? 0 : double(way.weight[c]));
      }
    }
    for (int c = 0; c < 3; ++c) {
      const double sigma = double(kMedium.sigma_t()[c]), albedo = double(kMedium.sigma_s[c]) / sigma;
      const double d = double(distance), T = std::exp(-sigma * d);
      const double at = T > 0 ? (1 - (1 + sigma * d) * T) / sigma : 1 / sigma;
      EXPECT_NEAR(scattered[c].mean, albedo * (1 - T), kErrors * scattered[c].standard_error() + 1e-6) << c;
      EXPECT_NEAR(passed[c].mean, T, kErrors * passed[c].standard_error() + 1e-6) << c;
      EXPECT_NEAR(place[c].mean, albedo * at, kErrors * place[c].standard_error() + 1e-6) << c;
    }
  }
}

// Two media behind each other: the light that passes both, and that is scattered by the second; and glass in
// between, which only absorbs.
TEST(FreePath, GoesThroughMediaOneAfterTheOther) {
  const Medium second{{1, 0, 0.5f}, {0.5f, 2, 0.1f}}, glass{{0.2f, 1, 0}};
  Mean scattered[3], passed[3];
  for (int i = 0; i < kSamples; ++i) {
    Sampler sampler(6, uint64_t(i));
    FreePath way(kLight, sampler.next_2d());
    const bool in_first = way.pass(kMedium, 0.4f).has_value();
    const bool in_glass = !in_first && way.pass(glass, 0.5f).has_value();
    EXPECT_FALSE(in_glass);
    const bool in_second = !in_first && way.pass(second, 0.7f).has_value();
    for (int c = 0; c < 3; ++c) {
      scattered[c].add(in_second ? double(way.scattered(second)[c]) : 0);
      passed[c].add(in_first || in_second ? 0 : double(way.passed()[c]));
    }
  }
  for (int c = 0; c < 3; ++c) {
    const double before = std::exp(-double(kMedium.sigma_t()[c]) * 0.4 - double(glass.sigma_t()[c]) * 0.5);
    const double T = std::exp(-double(second.sigma_t()[c]) * 0.7);
    const double albedo = double(second.sigma_s[c] / second.sigma_t()[c]);
    EXPECT_NEAR(passed[c].mean, before * T, kErrors * passed[c].standard_error() + 1e-6) << c;
    EXPECT_NEAR(scattered[c].mean, albedo * before * (1 - T), kErrors * scattered[c].standard_error() + 1e-6);
  }
}

// The light's sum over the channels never grows, so that no event is bright.
TEST(FreePath, NoWeightIsLarge) {
  for (int i = 0; i < 10'000; ++i) {
    Sampler sampler(4, uint64_t(i));
    const Event way = draw(kMedium, kLight, 1.5f, sampler.next_2d());
    const Rgb left = way.weight * kLight;
    EXPECT_LE(left.x + left.y + left.z, (kLight.x + kLight.y + kLight.z) * (1 + 1e-5f));
  }
}

TEST(ScatteringPlace, SamplesAllThatIsScattered) {
  for (const float distance : {1e-4f, 0.2f, 3.0f, kInfinity}) {
    const ScatteringPlace places(kMedium, kLight, distance);
    Mean sum[3], whole;
    for (int i = 0; i < kSamples; ++i) {
      Sampler sampler(5, uint64_t(i));
      const float t = places.sample(sampler.next_2d());
      ASSERT_TRUE(t >= 0 && t <= distance);
      for (int c = 0; c < 3; ++c) sum[c].add(double(places.scattered(t)[c] / places.pdf(t)));
      if (distance < kInfinity) whole.add(1 / double(places.pdf(t)));
    }
    for (int c = 0; c < 3; ++c) {
      const double sigma = double(kMedium.sigma_t()[c]), albedo = double(kMedium.sigma_s[c]) / sigma;
      const double expected = -albedo * std::expm1(-sigma * double(distance));
      EXPECT_NEAR(sum[c].mean, expected, kErrors * sum[c].standard_error() + 1e-5 * expected) << c;
    }
    if (distance < 1) {
      EXPECT_NEAR(whole.mean, double(distance), kErrors * whole.standard_error() + 1e-5 * double(distance));
    }
  }
  EXPECT_EQ(ScatteringPlace(Medium{}, kLight, 1).opacity(), 0);
}

}  // namespace
}  // namespace kaustik
