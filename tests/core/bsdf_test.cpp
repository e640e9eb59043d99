// Properties that every BSDF must have, run over instances of all of them.

#include "core/bsdf/bsdf.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/core/statistics.h"

namespace kaustik {
namespace {

using test::IndependentRandom;

const std::vector<Bsdf>& instances() {
  static const std::vector<Bsdf> all = {
      Lambertian{Rgb(0.2f, 0.5f, 1)},
      OrenNayar::from_sigma_degrees(Rgb(1), 0),
      OrenNayar::from_sigma_degrees(Rgb(1), 12),
      OrenNayar::from_sigma_degrees(Rgb(0.9f, 0.5f, 0.1f), 40),
      OrenNayar::from_sigma_degrees(Rgb(1), 90),
      Dielectric{1.5f},
      Dielectric{1 / 1.33f},
      Dielectric{1},
      Conductor{Rgb(0.2f, 0.92f, 1.1f), Rgb(3.9f, 2.45f, 2.14f)},
      Mirror{Rgb(0.9f)},
  };
  return all;
}

std::string name_of(const Bsdf& bsdf) {
  return std::visit([](const auto& b) { return std::string(b.kName); }, bsdf);
}
Rgb f(const Bsdf& bsdf, const Vector3& wo, const Vector3& wi) {
  return std::visit([&](const auto& b) { return b.f(wo, wi); }, bsdf);
}
float pdf(const Bsdf& bsdf, const Vector3& wo, const Vector3& wi) {
  return std::visit([&](const auto& b) { return b.pdf(wo, wi); }, bsdf);
}
std::optional<BsdfSample> sample(const Bsdf& bsdf, const Vector3& wo, IndependentRandom& random,
                                 TransportMode mode = TransportMode::kImportance) {
  const float uc = random.next();
  const Point2 u = random.next_2d();
  return std::visit([&](const auto& b) { return b.sample_f(wo, uc, u, mode); }, bsdf);
}

const Vector3 kDirections[] = {{0, 0, 1},
                               {0, 0, -1},
                               glm::normalize(Vector3(1, 0.5f, 1)),
                               glm::normalize(Vector3(-1, 0.2f, -0.3f)),
                               glm::normalize(Vector3(0.3f, -1, 0.01f))};

TEST(Bsdf, InstancesCoverEveryType) {
  std::set<size_t> seen;
  for (const Bsdf& b : instances()) seen.insert(b.index());
  EXPECT_EQ(seen.size(), std::variant_size_v<Bsdf>);
}

TEST(Bsdf, SamplesFollowTheirDensity) {
  std::vector<test::SquareCase> cases;
  for (const Bsdf& b : instances()) {
    if (is_specular(b)) continue;
    for (const Vector3& wo : kDirections) {
      test::SquareCase c;
      c.name = name_of(b) + " wo.z " + std::to_string(wo.z);
      c.sample = [=](IndependentRandom& random, Point2* p) {
        const auto s = sample(b, wo, random);
        if (!s) return false;
        *p = test::direction_to_square(s->wi, -1);
        return true;
      };
      c.density = [=](double x, double y) {
        return pdf(b, wo, test::square_to_direction(x, y, -1)) * test::square_solid_angle(-1);
      };
      cases.push_back(std::move(c));
    }
  }
  test::expect_all_accepted(cases, 100000, 1e-5);
}

// Delta lobes: how often each is chosen against the probability that its samples report.
TEST(Bsdf, SpecularLobesFollowTheirProbability) {
  for (const Bsdf& b : instances()) {
    if (!is_specular(b)) continue;
    for (const Vector3& wo : kDirections) {
      SCOPED_TRACE(name_of(b) + " wo.z " + std::to_string(wo.z));
      IndependentRandom random(8);
      constexpr int kSamples = 20000;
      int64_t count[2] = {0, 0};
      double probability[2] = {0, 0};
      for (int i = 0; i < kSamples; ++i) {
        const auto s = sample(b, wo, random);
        ASSERT_TRUE(s);
        ++count[s->transmission];
        probability[s->transmission] = s->pdf;
      }
      for (int lobe = 0; lobe < 2; ++lobe) {
        const double p = count[lobe] > 0 ? probability[lobe] : 1 - probability[1 - lobe];
        const double sigma = std::sqrt(kSamples * p * (1 - p));
        EXPECT_NEAR(static_cast<double>(count[lobe]), kSamples * p, 4.5 * sigma + 0.5);
      }
    }
  }
}

TEST(Bsdf, WeightIsValueTimesCosineOverDensity) {
  IndependentRandom random(1);
  for (const Bsdf& b : instances()) {
    if (is_specular(b)) continue;
    for (int i = 0; i < 2000; ++i) {
      const Vector3 wo = random.direction();
      const auto s = sample(b, wo, random);
      if (!s) continue;
      EXPECT_FALSE(s->specular);
      EXPECT_FLOAT_EQ(s->pdf, pdf(b, wo, s->wi));
      const Rgb expected = f(b, wo, s->wi) * std::abs(s->wi.z) / s->pdf;
      // Three chained float roundings on either side.
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(s->weight[c], expected[c], 8 * 0x1p-24f * expected[c]);
    }
  }
}

TEST(Bsdf, IsReciprocal) {
  IndependentRandom random(2);
  for (const Bsdf& b : instances()) {
    for (int i = 0; i < 2000; ++i) {
      const Vector3 wo = random.direction();
      const Vector3 wi = random.direction();
      EXPECT_EQ(f(b, wo, wi), f(b, wi, wo)) << name_of(b);
    }
  }
}

// White furnace: the mean weight is the directional albedo. It must not exceed one; for Lambert's it is the
// reflectance itself.
TEST(Bsdf, MakesNoEnergy) {
  const float cosines[] = {1, 0.7f, 0.3f, 0.05f, 0.001f, -0.5f, -0.01f};
  for (const Bsdf& b : instances()) {
    for (const float z : cosines) {
      SCOPED_TRACE(name_of(b) + " wo.z " + std::to_string(z));
      const Vector3 wo(std::sqrt(1 - z * z), 0, z);
      IndependentRandom random(6);
      test::Mean albedo;
      for (int i = 0; i < 20000; ++i) {
        const auto s = sample(b, wo, random);
        if (!s) continue;
        ASSERT_TRUE(is_finite(s->weight));
        ASSERT_GE(std::min(s->weight.x, std::min(s->weight.y, s->weight.z)), 0);
        albedo.add(max_component(s->weight));
      }
      EXPECT_LE(albedo.mean, 1 + 4 * albedo.standard_error() + 1e-6);
    }
  }
  const Lambertian lambertian{Rgb(0.2f, 0.5f, 1)};
  EXPECT_EQ(lambertian.sample_f({0, 0, 1}, 0, {0.3f, 0.8f}, TransportMode::kRadiance)->weight,
            lambertian.reflectance);
}

// The stated hemispherical albedo against the mean weight over cosine-distributed wo.
TEST(Bsdf, AlbedoIsTheMeanOverTheHemisphere) {
  for (const Bsdf& b : instances()) {
    if (std::holds_alternative<Dielectric>(b)) continue;  // its albedo counts transmission: one by definition
    IndependentRandom random(12);
    test::Mean mean;
    for (int i = 0; i < 100000; ++i) {
      const auto s = sample(b, sample_cosine_hemisphere(random.next_2d()), random);
      if (s) mean.add(s->weight.y);
    }
    // Eight quadrature points of the conductor's smooth curve: 1e-3.
    EXPECT_NEAR(albedo(b).y, mean.mean, 4.5 * mean.standard_error() + 1e-3) << name_of(b);
  }
}

TEST(Bsdf, GrazingAndExtremeInputStayFinite) {
  IndependentRandom random(3);
  for (const Bsdf& b : instances()) {
    for (const float z : {0.0f, -0.0f, 1e-38f, -1e-30f, 1e-20f, 1e-7f, 1.0f, 0x1.000002p0f}) {
      const Vector3 wo(std::sqrt(std::max(0.0f, 1 - z * z)), 0, z);
      for (int i = 0; i < 100; ++i) {
        const auto s = sample(b, wo, random, TransportMode::kRadiance);
        if (!s) continue;
        EXPECT_TRUE(is_finite(s->weight) && is_finite(s->wi) && s->pdf > 0) << name_of(b) << " " << z;
        EXPECT_TRUE(is_finite(f(b, wo, s->wi)));
      }
    }
  }
}

TEST(OrenNayar, SigmaZeroIsLambertian) {
  const Rgb reflectance(0.2f, 0.5f, 1);
  const OrenNayar rough = OrenNayar::from_sigma_degrees(reflectance, 0);
  const Lambertian flat{reflectance};
  IndependentRandom random(4);
  for (int i = 0; i < 1000; ++i) {
    const Vector3 wo = random.direction();
    const Vector3 wi = random.direction();
    EXPECT_EQ(rough.f(wo, wi), flat.f(wo, wi));
  }
  EXPECT_EQ(rough.albedo(), flat.albedo());
}

// Against the angles of the paper's equation 30, in double.
TEST(OrenNayar, MatchesThePapersAngles) {
  constexpr double kSigma = 0.5;
  const OrenNayar b =
      OrenNayar::from_sigma_degrees(Rgb(0.8f), static_cast<float>(kSigma * 180 / std::numbers::pi));
  const double s2 = kSigma * kSigma;
  const double A = 1 - 0.5 * s2 / (s2 + 0.33);
  const double B = 0.45 * s2 / (s2 + 0.09);
  for (const double ti : {0.0, 0.3, 1.0, 1.5}) {
    for (const double to : {0.0, 0.5, 1.2}) {
      for (const double dphi : {0.0, 1.0, 2.0, 3.1}) {
        const Vector3 wi(glm::dvec3(std::sin(ti), 0, std::cos(ti)));
        const Vector3 wo(
            glm::dvec3(std::sin(to) * std::cos(dphi), std::sin(to) * std::sin(dphi), std::cos(to)));
        const double expected =
            0.8 / std::numbers::pi *
            (A + B * std::max(0.0, std::cos(dphi)) * std::sin(std::max(ti, to)) * std::tan(std::min(ti, to)));
        EXPECT_NEAR(b.f(wo, wi).x, expected, 1e-6 * expected);
      }
    }
  }
}

}  // namespace
}  // namespace kaustik
