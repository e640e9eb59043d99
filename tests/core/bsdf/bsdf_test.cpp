// Properties that every BSDF must have, run over the examples of all of them.

#include "core/bsdf/bsdf.h"

#include <gtest/gtest.h>

#include "tests/core/support/bsdf_examples.h"
#include "tests/core/support/chi_square.h"
#include "tests/support/random.h"
#include "tests/support/statistics.h"

namespace kaustik {
namespace {

using test::bsdf_examples, test::rounding_of;
using test::Random;

std::optional<BsdfSample> sample(const Bsdf& bsdf, const Vector3& wo, Random& random,
                                 TransportMode mode = TransportMode::kImportance) {
  const float uc = random.uniform();
  const Point2 u = random.uniform_2d();
  return sample_f(bsdf, wo, uc, u, mode);
}

const Vector3 kDirections[] = {{0, 0, 1},
                               {0, 0, -1},
                               glm::normalize(Vector3(1, 0.5f, 1)),
                               glm::normalize(Vector3(-1, 0.2f, -0.3f)),
                               glm::normalize(Vector3(0.3f, -1, 0.01f))};

// A sample of one part alone, where there are two.
std::optional<BsdfSample> sample_part(const Bsdf& bsdf, LobePart part, const Vector3& wo, Random& random) {
  const float uc = random.uniform();
  const Point2 u = random.uniform_2d();
  return sample_f(bsdf, wo, uc, u, TransportMode::kRadiance,
                  part == LobePart::kDiffuse ? Scatter::kDiffuse : Scatter::kSpecular);
}

// Calls fn(bsdf, part) for the parts that have densities.
template <class Fn>
void for_each_part(const Fn& fn) {
  for (const Bsdf& b : bsdf_examples()) {
    if (lobes(b).diffuse) fn(b, LobePart::kDiffuse);
    if (lobes(b).glossy) fn(b, LobePart::kGlossy);
  }
}

const Ggx* facets_of(const Bsdf& bsdf) {
  return std::visit(
      [](const auto& b) -> const Ggx* {
        if constexpr (requires { b.facets; }) return b.facets.smooth() ? nullptr : &b.facets;
        return nullptr;
      },
      bsdf);
}

// The narrow peaks of microfacets need more points in each bin, and must not be narrower than the distance
// between the points. Directions scattered to the wrong side of the surface are lost, so the mass of
// microfacets has no lower bound; the test counts the lost samples in a bin of their own.
TEST(Bsdf, SamplesFollowTheirDensity) {
  std::vector<test::SquareCase> cases, lossy;
  for_each_part([&](const Bsdf& b, LobePart part) {
    const Ggx* facets = facets_of(b);
    if (facets && facets->alpha_x < (std::holds_alternative<Dielectric>(b) ? 0.6f : 0.2f)) return;
    for (const Vector3& wo : kDirections) {
      test::SquareCase c;
      c.name = std::string(name_of(b)) + " " + std::to_string(b.index()) + " wo.z " + std::to_string(wo.z);
      c.sample = [=](Random& random, Point2* p) {
        const auto s = sample_part(b, part, wo, random);
        if (!s) return false;
        *p = test::direction_to_square(s->wi, -1);
        return true;
      };
      c.density = [=](double x, double y) {
        return pdf(b, wo, test::square_to_direction(x, y, -1), part) * test::square_solid_angle(-1);
      };
      if (test::loses_samples(b)) c.subdivisions = 64;
      (test::loses_samples(b) ? lossy : cases).push_back(std::move(c));
    }
  });
  test::expect_all_accepted(cases, 100000, 1e-5);
  test::expect_all_accepted(lossy, 20000, 2e-3, 0);
}

// For delta lobes, compares how often each lobe is chosen with the probability that its samples report.
TEST(Bsdf, SpecularLobesFollowTheirProbability) {
  for (const Bsdf& b : bsdf_examples()) {
    const Lobes parts = lobes(b);
    if (parts.diffuse || parts.glossy) continue;
    for (const Vector3& wo : kDirections) {
      SCOPED_TRACE(std::string(name_of(b)) + " wo.z " + std::to_string(wo.z));
      Random random(8);
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

bool near_edge(const Bsdf& bsdf, const Vector3& wo, const Vector3& wi) {
  return facets_of(bsdf) && (std::abs(wo.z) < 0.05f || std::abs(wi.z) < 0.05f);
}

TEST(Bsdf, WeightIsValueTimesCosineOverDensity) {
  Random random(1);
  for_each_part([&](const Bsdf& b, LobePart part) {
    const double tolerance = rounding_of(b);
    for (int i = 0; i < 2000; ++i) {
      const Vector3 wo = random.direction();
      const auto s = sample_part(b, part, wo, random);
      if (!s || near_edge(b, wo, s->wi)) continue;
      EXPECT_EQ(s->specular, part == LobePart::kGlossy);
      EXPECT_EQ(s->glossy, part == LobePart::kGlossy);
      EXPECT_EQ(s->transmission, !same_hemisphere(wo, s->wi));
      const float density = pdf(b, wo, s->wi, part);
      EXPECT_NEAR(s->pdf, density, tolerance * double(density)) << std::string(name_of(b));
      const Rgb expected = f(b, wo, s->wi, part) * std::abs(s->wi.z) / density;
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(s->weight[c], expected[c], tolerance * double(expected[c]));
    }
  });
}

float squared_index(const Bsdf& bsdf, const Vector3& w) {
  const auto* d = std::get_if<Dielectric>(&bsdf);
  return d && w.z < 0 ? d->eta * d->eta : 1;
}

TEST(Bsdf, IsReciprocal) {
  Random random(2);
  for (const Bsdf& b : bsdf_examples()) {
    for (int i = 0; i < 2000; ++i) {
      const Vector3 wo = random.direction();
      const Vector3 wi = random.direction();
      if (near_edge(b, wo, wi)) continue;
      for (const LobePart part : {LobePart::kDiffuse, LobePart::kGlossy}) {
        // f over eta^2 of the side that radiance leaves to is symmetric (Veach 1997, equation 5.14).
        const Rgb there = f(b, wo, wi, part) / squared_index(b, wo);
        const Rgb back = f(b, wi, wo, part) / squared_index(b, wi);
        const bool through = !same_hemisphere(wo, wi);
        // The two directions add the same terms in another order. The half vectors of refraction have
        // different lengths in the two directions; far from the peak, where f is small, their rounding
        // dominates D.
        const double tolerance = through ? 1e-2 * double(there.x) + 1e-5 : 1e-4 * double(there.x);
        if (rounding_of(b) < 1e-6) {
          EXPECT_EQ(there, back) << std::string(name_of(b));
        } else {
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(there[c], back[c], tolerance) << std::string(name_of(b)) << wo.z << " " << wi.z;
        }
      }
    }
  }
}

// White furnace: the mean weight is the directional albedo, which must not exceed one. For a Lambertian
// surface it is the reflectance.
TEST(Bsdf, CreatesNoEnergy) {
  const float cosines[] = {1, 0.7f, 0.3f, 0.05f, 0.001f, -0.5f, -0.01f};
  for (const Bsdf& b : bsdf_examples()) {
    for (const float z : cosines) {
      SCOPED_TRACE(std::string(name_of(b)) + " wo.z " + std::to_string(z));
      const Vector3 wo(std::sqrt(1 - z * z), 0, z);
      Random random(6);
      test::Mean albedo[3];
      for (int i = 0; i < 20000; ++i) {
        const auto s = sample(b, wo, random);
        if (!s) {
          for (test::Mean& channel : albedo) channel.add(0);
          continue;
        }
        ASSERT_TRUE(is_finite(s->weight));
        ASSERT_GE(std::min(s->weight.x, std::min(s->weight.y, s->weight.z)), 0);
        for (int c = 0; c < 3; ++c) albedo[c].add(double(s->weight[c]));
      }
      for (const test::Mean& channel : albedo)
        EXPECT_LE(channel.mean, 1 + 4 * channel.standard_error() + 1e-6);
    }
  }
  const Lambertian lambertian{Rgb(0.2f, 0.5f, 1)};
  EXPECT_EQ(lambertian.sample_f({0, 0, 1}, 0, {0.3f, 0.8f}, TransportMode::kRadiance)->weight,
            lambertian.reflectance);
}

// Compares the stated hemispherical albedo with the mean weight over cosine-distributed wo.
TEST(Bsdf, AlbedoIsTheMeanOverTheHemisphere) {
  for (const Bsdf& b : bsdf_examples()) {
    if (!test::albedo_is_exact(b)) continue;
    Random random(12);
    test::Mean mean;
    for (int i = 0; i < 100000; ++i) {
      const auto s = sample(b, sample_cosine_hemisphere(random.uniform_2d()), random);
      if (s) mean.add(s->transmission ? 0 : s->weight.y);
    }
    // Eight quadrature points of the conductor's smooth curve: 1e-3.
    EXPECT_NEAR(albedo(b).y, mean.mean, 4.5 * mean.standard_error() + 1e-3) << std::string(name_of(b));
  }
}

// What the traits of a type say holds for all its examples: random directions find no contradiction.
TEST(Bsdf, TraitsHold) {
  for (const Bsdf& b : bsdf_examples()) {
    SCOPED_TRACE(std::string(name_of(b)));
    const bool draws_lobe = std::visit([]<class B>(const B&) { return B::kDrawsLobe; }, b);
    Random random(31);
    for (int i = 0; i < 1000; ++i) {
      const Vector3 wo = random.direction(), wi = random.direction();
      const Rgb value = f(b, wo, wi, LobePart::kDiffuse);
      if (!same_hemisphere(wo, wi) && !is_black(value)) {
        EXPECT_TRUE(transmits(b));
        EXPECT_FALSE(lit_from_one_side(b));
      }
      EXPECT_TRUE(lobes(b).diffuse || is_black(value));
      EXPECT_TRUE(lobes(b).glossy || is_black(f(b, wo, wi, LobePart::kGlossy)));
      const Point2 u = random.uniform_2d();
      const auto s = sample_f(b, wo, random.uniform(), u, TransportMode::kImportance);
      if (!s) continue;
      if (!draws_lobe) {
        EXPECT_EQ(s->wi, sample_f(b, wo, 0, u, TransportMode::kImportance)->wi);
      }
      EXPECT_TRUE(transmits(b) || s->specular || !s->transmission);
      EXPECT_TRUE(s->specular ? lobes(b).specular : lobes(b).diffuse);
    }
  }
}

// f of isotropic BSDFs depends on the angle between the azimuths alone. Turning rounds both directions once
// more.
TEST(Bsdf, IsotropicValuesDoNotTurn) {
  const float c = std::cos(0.7f), s = std::sin(0.7f);
  const auto turned = [&](const Vector3& w) { return Vector3(c * w.x - s * w.y, s * w.x + c * w.y, w.z); };
  for (const Bsdf& b : bsdf_examples()) {
    Random random(32);
    for (int i = 0; i < 1000 && !is_anisotropic(b); ++i) {
      const Vector3 wo = random.direction(), wi = random.direction();
      if (near_edge(b, wo, wi)) continue;
      for (const LobePart part : {LobePart::kDiffuse, LobePart::kGlossy}) {
        const double value = double(f(b, wo, wi, part).x);
        EXPECT_NEAR(double(f(b, turned(wo), turned(wi), part).x), value, 4 * rounding_of(b) * value + 1e-5)
            << name_of(b);
      }
    }
  }
}

TEST(Bsdf, ConstantValuesAreThoseOfPiF) {
  Random random(33);
  for (const Bsdf& b : bsdf_examples()) {
    std::visit(
        [&]<class B>(const B& bsdf) {
          if constexpr (HasConstantValue<B>) {
            for (int i = 0; i < 100; ++i) {
              const Vector3 wo = random.direction(), wi = random.direction();
              EXPECT_EQ(bsdf.f(wo, wi), bsdf.pi_f(!same_hemisphere(wo, wi)) * kInvPi);
            }
          }
        },
        b);
  }
}

TEST(Bsdf, GrazingAndExtremeInputStayFinite) {
  Random random(3);
  for (const Bsdf& b : bsdf_examples()) {
    for (const float z : {0.0f, -0.0f, 1e-38f, -1e-30f, 1e-20f, 1e-7f, 1.0f, 0x1.000002p0f}) {
      const Vector3 wo(std::sqrt(std::max(0.0f, 1 - z * z)), 0, z);
      for (int i = 0; i < 100; ++i) {
        const auto s = sample(b, wo, random, TransportMode::kRadiance);
        if (!s) continue;
        EXPECT_TRUE(is_finite(s->weight) && is_finite(s->wi) && s->pdf > 0)
            << std::string(name_of(b)) << " " << z;
        EXPECT_TRUE(is_finite(f(b, wo, s->wi, LobePart::kDiffuse)) &&
                    is_finite(f(b, wo, s->wi, LobePart::kGlossy)));
      }
    }
  }
}

TEST(OrenNayar, SigmaZeroIsLambertian) {
  const Rgb reflectance(0.2f, 0.5f, 1);
  const OrenNayar rough = OrenNayar::from_sigma_degrees(reflectance, 0);
  const Lambertian flat{reflectance};
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const Vector3 wo = random.direction();
    const Vector3 wi = random.direction();
    EXPECT_EQ(rough.f(wo, wi), flat.f(wo, wi));
  }
  EXPECT_EQ(rough.albedo(), flat.albedo());
}

// Compares with equation 30 of Oren and Nayar's paper, which is written with angles, in double.
TEST(OrenNayar, MatchesThePapersEquationInAngles) {
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
