// Tests the choice of a light among many: the stated probabilities sum to one, match the choices, and are
// zero only where a light contributes nothing.

#include <gtest/gtest.h>

#include "core/light/choice/light_sampler.h"
#include "tests/core/support/chi_square.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"

namespace kaustik {
namespace {

using test::Random;

Point3 point_in_box(Random& random, float size) {
  return size * Point3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
}

DiffuseAreaLight triangle_light(Random& random, float size) {
  const Point3 p = point_in_box(random, size);
  const auto corner = [&] { return p + 0.05f * size * random.direction(); };
  const Shape shape = test::triangle(p, corner(), corner());
  return *DiffuseAreaLight::make(shape, Rgb(random.uniform(1, 9)), random.uniform() < 0.2f);
}

SpotLight spot(Random& random, float size) {
  SpotLight s;
  s.position = point_in_box(random, size);
  s.frame = Frame::from_z(random.direction());
  s.I = Rgb(size * size * random.uniform(1, 5));
  s.cos_total_width = random.uniform(-0.9f, 0.98f);
  s.cos_falloff_start = random.uniform(s.cos_total_width, 1);
  return s;
}

// Lights of each kind in turn; coordinates and distances scale with `size`.
std::vector<Light> lights(int count, float size = 1, uint64_t seed = 8) {
  Random random(seed);
  std::vector<Light> out;
  for (int i = 0; i < count; ++i) {
    switch (i % 5) {
      case 0:
        out.push_back(PointLight{point_in_box(random, size), Rgb(size * size * random.uniform(1, 5))});
        break;
      case 1:
        out.push_back(spot(random, size));
        break;
      case 2:
        out.push_back(*DiffuseAreaLight::make(
            test::sphere(point_in_box(random, size), 0.03f * size, random.uniform() < 0.3f), Rgb(3), false));
        break;
      default:
        out.push_back(triangle_light(random, size));
    }
  }
  return out;
}

LightReceiver receiver(Random& random, float size = 1) {
  return {point_in_box(random, 1.5f * size), random.direction(), random.uniform() < 0.3f};
}

double sum_of_probabilities(const LightTree& tree, const LightReceiver& x, int count) {
  double sum = 0;
  for (int light = 0; light < count; ++light) sum += double(tree.probability(x, uint32_t(light)));
  return sum;
}

// Each step down the tree multiplies by a factor that is rounded once: at most about 40 steps of 2^-24 for
// 1000 lights.
TEST(LightTree, ProbabilitiesSumToOne) {
  constexpr double kRounding = 40 * 0x1p-24;
  for (const int count : {1, 2, 17, 1000}) {
    std::vector<Light> points;
    for (const Light& light : lights(5 * count))
      if (std::holds_alternative<PointLight>(light)) points.push_back(light);
    const LightTree of_points(points), of_all(lights(count));
    Random random(9);
    for (int i = 0; i < 50; ++i) {
      LightReceiver x = receiver(random);
      // The sum is less than one where a branch cannot contribute although its parent might.
      const double sum = sum_of_probabilities(of_all, x, count);
      EXPECT_LE(sum, 1 + kRounding);
      EXPECT_TRUE(sum > 0 || !of_all.choose(x, 0.5f));
      x.two_sided = true;
      EXPECT_NEAR(sum_of_probabilities(of_points, x, count), 1, kRounding);
    }
  }
}

// Every random number leads to a light with the stated probability, and the numbers that lead to one light
// form an interval of that length.
TEST(LightTree, StatedProbabilitiesMatchTheChoices) {
  const int count = 200;
  const LightTree tree(lights(count));
  Random random(10);
  for (int i = 0; i < 5; ++i) {
    const LightReceiver x = receiver(random);
    std::vector<int> chosen(count);
    constexpr int kSteps = 1 << 16;
    for (int k = 0; k < kSteps; ++k) {
      const auto choice = tree.choose(x, (float(k) + 0.5f) / kSteps);
      if (!choice) continue;
      ++chosen[choice->light];
      ASSERT_EQ(choice->probability, tree.probability(x, choice->light));
      ASSERT_TRUE(choice->u_remapped >= 0 && choice->u_remapped < 1);
    }
    for (int light = 0; light < count; ++light)
      EXPECT_NEAR(chosen[size_t(light)] / double(kSteps), double(tree.probability(x, uint32_t(light))),
                  2.0 / kSteps);
  }
}

TEST(LightTree, IsNeverZeroWhereALightContributes) {
  const std::vector<Light> all = lights(300);
  const LightTree tree(all);
  Random random(11);
  int contributing = 0;
  for (int i = 0; i < 60; ++i) {
    const LightReceiver x = receiver(random);
    for (uint32_t light = 0; light < all.size(); ++light)
      for (int k = 0; k < 20; ++k) {
        const Point2 u = random.uniform_2d();
        const auto s = sample_Li(all[light], x, u);
        if (!s || is_black(s->Li)) continue;
        if (!x.two_sided && !(glm::dot(x.n, s->wi) > 0)) continue;
        ++contributing;
        ASSERT_GT(tree.probability(x, light), 0) << light;
      }
  }
  EXPECT_GT(contributing, 50000);
}

// The extent of these is infinite.
TEST(LightTree, TakesLightsAtTheEndsOfTheRangeOfFloats) {
  constexpr float kEnd = std::numeric_limits<float>::max();
  std::vector<Light> all;
  for (const float x : {-kEnd, 0.0f, 1.0f, 2.0f, 3.0f, kEnd}) all.emplace_back(PointLight{{x, 0, 0}, Rgb(1)});
  const LightTree tree(all);
  const double sum = sum_of_probabilities(tree, {{0, 1, 0}, {0, 1, 0}, true}, int(all.size()));
  EXPECT_TRUE(sum >= 0 && sum < 1.001) << sum;
}

// Lights in one place, on a line, and with powers that differ by many orders are all found.
TEST(LightTree, FindsLightsOfAnyArrangement) {
  std::vector<Light> all;
  for (int i = 0; i < 3000; ++i) {
    const float x = i < 1000 ? 0 : i < 2000 ? float(i) : std::ldexp(1.0f, i % 10);
    all.push_back(PointLight{{x, 0, 0}, Rgb(std::ldexp(1.0f, i % 12 - 6))});
  }
  const LightTree tree(all);
  const LightReceiver x{{3, 100, 5}, {0, -1, 0}, false};
  double sum = 0;
  for (uint32_t light = 0; light < all.size(); ++light) {
    const float p = tree.probability(x, light);
    EXPECT_GT(p, 0) << light;
    sum += double(p);
  }
  EXPECT_NEAR(sum, 1, 1e-4);
}

// A scene that is 2^k times as large gives the same lights with the same probabilities.
TEST(LightTree, ScalesByPowersOfTwo) {
  const LightTree one(lights(100));
  for (const int k : {-30, 20}) {
    const float size = std::ldexp(1.0f, k);
    const LightTree scaled(lights(100, size));
    Random random(12), same(12);
    for (int i = 0; i < 1000; ++i) {
      const LightReceiver x = receiver(random), y = receiver(same, size);
      const float u = random.uniform();
      ASSERT_EQ(same.uniform(), u);
      const auto a = one.choose(x, u), b = scaled.choose(y, u);
      ASSERT_EQ(a.has_value(), b.has_value());
      if (!a) continue;
      ASSERT_EQ(a->light, b->light);
      ASSERT_EQ(a->probability, b->probability);
    }
  }
}

TEST(LightSampler, FewLightsAreChosenByPower) {
  const std::vector<Light> all = lights(int(LightSampler::kMostByPower));
  const LightSampler sampler(all);
  const DiscreteDistribution by_power = light_power_distribution(all);
  const LightReceiver x{{0, 0, 0}, {0, 0, 1}, true};
  for (uint32_t light = 0; light < all.size(); ++light)
    EXPECT_EQ(sampler.probability(x, light), by_power.pdf(light));
  for (const float u : {0.0f, 0.25f, 0.77f, kOneMinusEpsilon}) {
    EXPECT_EQ(sampler.choose(x, u)->light, by_power.sample(u).index);
    EXPECT_EQ(sampler.choose(x, u)->u_remapped, by_power.sample(u).u_remapped);
  }
}

TEST(LightSampler, LightsWithoutAPositionAreChosenBesideTheTree) {
  std::vector<Light> all = lights(40);
  all.insert(all.begin() + 3, DistantLight{{0, 0, 1}, Rgb(1), {0, 0, 0}, 2});
  all.insert(all.begin() + 9, InfiniteLight{Rgb(1), {0, 0, 0}, 2});
  all.push_back(InfiniteLight{Rgb(0), {0, 0, 0}, 2});  // black
  const LightSampler sampler(all);
  const LightReceiver x{{0, 0, 0}, {0, 0, 1}, true};
  // One choice in eight goes by power.
  const DiscreteDistribution by_power = light_power_distribution(all);
  for (const uint32_t light : {3u, 9u})
    EXPECT_FLOAT_EQ(sampler.probability(x, light), 0.875f / 3 + 0.125f * by_power.pdf(light));
  EXPECT_EQ(sampler.probability(x, uint32_t(all.size() - 1)), 0);
  double sum = 0;
  for (uint32_t light = 0; light < all.size(); ++light) sum += double(sampler.probability(x, light));
  EXPECT_LE(sum, 1 + 1e-5);
  for (int k = 0; k < 1000; ++k) {
    const auto choice = sampler.choose(x, (float(k) + 0.5f) / 1000);
    if (!choice) continue;
    ASSERT_EQ(choice->probability, sampler.probability(x, choice->light));
  }
  const LightSampler none(std::vector<Light>(20, PointLight{{0, 0, 0}, Rgb(0)}));
  EXPECT_FALSE(none.choose(x, 0.5f));
}

}  // namespace
}  // namespace kaustik
