// Tests the properties that every BSDF must have, on instances of all types.

#include "core/bsdf/bsdf.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/core/support/chi_square.h"
#include "tests/support/random.h"
#include "tests/support/statistics.h"

namespace kaustik {
namespace {

using test::Random;

const Rgb kCopperEta(0.2f, 0.92f, 1.1f), kCopperK(3.9f, 2.45f, 2.14f);

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
      Dielectric{1.5f, {0.2f, 0.2f}},
      Dielectric{1.5f, {0.9f, 0.9f}},
      Dielectric{1 / 1.33f, {0.3f, 0.15f}},
      Dielectric{2.4f, {0.7f, 0.7f}},
      Conductor{kCopperEta, kCopperK},
      Conductor{kCopperEta, kCopperK, {0.1f, 0.1f}},
      Conductor{kCopperEta, kCopperK, {0.25f, 0.6f}},
      Conductor{kCopperEta, kCopperK, {1, 1}},
      Mirror{Rgb(0.9f)},
      ThinDielectric{1.5f},
      ThinDielectric{1},
      DiffuseTransmission{Rgb(0.2f, 0.5f, 0), Rgb(0.7f, 0.5f, 0.1f)},
      DiffuseTransmission{Rgb(0.5f), Rgb(0)},
      DiffuseTransmission{Rgb(0), Rgb(1)},
      CoatedDiffuse::from_reflectance(Rgb(0.9f, 0.5f, 0), 1.5f),
      CoatedDiffuse::from_reflectance(Rgb(1), 2.5f),
      CoatedDiffuse::from_reflectance(Rgb(0.5f), 1),
      CoatedDiffuse::from_reflectance(Rgb(0.9f, 0.5f, 0), 1.5f, {0.2f, 0.2f}),
      CoatedDiffuse::from_reflectance(Rgb(0.9f, 0.5f, 0), 1.5f, {0.7f, 0.5f}),
  };
  return all;
}

std::string name_of(const Bsdf& bsdf) {
  return std::visit([](const auto& b) { return std::string(b.kName); }, bsdf);
}
// The value of the diffuse lobes, or of the glossy ones.
Rgb f(const Bsdf& bsdf, const Vector3& wo, const Vector3& wi, bool glossy = false) {
  return std::visit(
      [&](const auto& b) {
        if (!glossy) return b.f(wo, wi);
        if constexpr (requires { b.f_glossy(wo, wi); }) return b.f_glossy(wo, wi);
        return Rgb(0);
      },
      bsdf);
}
float pdf(const Bsdf& bsdf, const Vector3& wo, const Vector3& wi, bool glossy = false) {
  return std::visit(
      [&](const auto& b) {
        if (!glossy) return b.pdf(wo, wi);
        if constexpr (requires { b.pdf_glossy(wo, wi); }) return b.pdf_glossy(wo, wi);
        return 0.0f;
      },
      bsdf);
}
std::optional<BsdfSample> sample(const Bsdf& bsdf, const Vector3& wo, Random& random,
                                 TransportMode mode = TransportMode::kImportance) {
  const float uc = random.uniform();
  const Point2 u = random.uniform_2d();
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

// Samples one part alone where the BSDF has two.
std::optional<BsdfSample> sample_part(const Bsdf& bsdf, bool glossy, const Vector3& wo, Random& random) {
  const float uc = random.uniform();
  const Point2 u = random.uniform_2d();
  constexpr TransportMode kMode = TransportMode::kRadiance;
  return std::visit(
      [&](const auto& b) {
        if constexpr (requires { b.sample_broad(wo, uc, u, kMode); }) {
          if (!glossy) return b.sample_broad(wo, uc, u, kMode);
          return b.sample_specular(wo, uc, u, kMode);
        }
        return b.sample_f(wo, uc, u, kMode);
      },
      bsdf);
}

// Calls fn(bsdf, glossy) for each part that has a density.
template <class Fn>
void for_each_part(const Fn& fn) {
  for (const Bsdf& b : instances()) {
    if (lobes(b).broad) fn(b, false);
    if (lobes(b).glossy) fn(b, true);
  }
}

const Ggx* facets_of(const Bsdf& bsdf) {
  const Ggx* facets = nullptr;
  if (const auto* c = std::get_if<Conductor>(&bsdf)) facets = &c->facets;
  if (const auto* d = std::get_if<Dielectric>(&bsdf)) facets = &d->facets;
  if (const auto* c = std::get_if<CoatedDiffuse>(&bsdf)) facets = &c->facets;
  return facets && !facets->smooth() ? facets : nullptr;
}

// The narrow peaks of microfacets need more points in each bin, and must not be narrower than the distance
// between the points. Directions scattered to the wrong side of the surface are lost, so the mass of
// microfacets has no lower bound; the test counts the lost samples in a bin of their own.
TEST(Bsdf, SamplesFollowTheirDensity) {
  std::vector<test::SquareCase> cases, of_facets;
  for_each_part([&](const Bsdf& b, bool glossy) {
    const Ggx* facets = facets_of(b);
    if (facets && facets->alpha_x < (std::holds_alternative<Dielectric>(b) ? 0.6f : 0.2f)) return;
    for (const Vector3& wo : kDirections) {
      test::SquareCase c;
      c.name = name_of(b) + " " + std::to_string(b.index()) + " wo.z " + std::to_string(wo.z);
      c.sample = [=](Random& random, Point2* p) {
        const auto s = sample_part(b, glossy, wo, random);
        if (!s) return false;
        *p = test::direction_to_square(s->wi, -1);
        return true;
      };
      c.density = [=](double x, double y) {
        return pdf(b, wo, test::square_to_direction(x, y, -1), glossy) * test::square_solid_angle(-1);
      };
      if (facets) c.subdivisions = 64;
      (facets ? of_facets : cases).push_back(std::move(c));
    }
  });
  test::expect_all_accepted(cases, 100000, 1e-5);
  test::expect_all_accepted(of_facets, 20000, 2e-3, 0);
}

// For delta lobes, compares how often each lobe is chosen with the probability that its samples report.
TEST(Bsdf, SpecularLobesFollowTheirProbability) {
  for (const Bsdf& b : instances()) {
    const Lobes parts = lobes(b);
    if (parts.broad || parts.glossy) continue;
    for (const Vector3& wo : kDirections) {
      SCOPED_TRACE(name_of(b) + " wo.z " + std::to_string(wo.z));
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

// Relative rounding error of a value. Both sides of a comparison chain three float roundings. For microfacets
// the half vector is computed anew from the two directions: its slope is off by a few roundings divided by
// the cosines, so near-grazing directions are left out, and D changes by 4 / alpha for each unit of slope.
// The half vector of refraction and its Jacobian contain differences that may be small, which costs up to
// 1e-3.
double rounding_of(const Bsdf& bsdf) {
  const double plain = 8 * 0x1p-24;
  const Ggx* facets = facets_of(bsdf);
  if (!facets) return plain;
  if (std::holds_alternative<Dielectric>(bsdf)) return 1e-3;
  return plain + 64 * 0x1p-24 * 4 / double(std::min(facets->alpha_x, facets->alpha_y));
}
bool near_edge(const Bsdf& bsdf, const Vector3& wo, const Vector3& wi) {
  return facets_of(bsdf) && (std::abs(wo.z) < 0.05f || std::abs(wi.z) < 0.05f);
}

TEST(Bsdf, WeightIsValueTimesCosineOverDensity) {
  Random random(1);
  for_each_part([&](const Bsdf& b, bool glossy) {
    const double tolerance = rounding_of(b);
    for (int i = 0; i < 2000; ++i) {
      const Vector3 wo = random.direction();
      const auto s = sample_part(b, glossy, wo, random);
      if (!s || near_edge(b, wo, s->wi)) continue;
      EXPECT_EQ(s->specular, glossy);
      EXPECT_EQ(s->glossy, glossy);
      EXPECT_EQ(s->transmission, !same_hemisphere(wo, s->wi));
      const float density = pdf(b, wo, s->wi, glossy);
      EXPECT_NEAR(s->pdf, density, tolerance * double(density)) << name_of(b);
      const Rgb expected = f(b, wo, s->wi, glossy) * std::abs(s->wi.z) / density;
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
  for (const Bsdf& b : instances()) {
    for (int i = 0; i < 2000; ++i) {
      const Vector3 wo = random.direction();
      const Vector3 wi = random.direction();
      if (near_edge(b, wo, wi)) continue;
      for (const bool glossy : {false, true}) {
        // f divided by eta^2 of the side that radiance leaves to is symmetric (Veach 1997, equation 5.14).
        const Rgb there = f(b, wo, wi, glossy) / squared_index(b, wo);
        const Rgb back = f(b, wi, wo, glossy) / squared_index(b, wi);
        const bool through = !same_hemisphere(wo, wi);
        // The two directions add the same terms in another order. The half vectors of refraction have
        // different lengths in the two directions; far from the peak, where f is small, their rounding
        // dominates D.
        const double tolerance = through ? 1e-2 * double(there.x) + 1e-5 : 1e-4 * double(there.x);
        if (rounding_of(b) < 1e-6) {
          EXPECT_EQ(there, back) << name_of(b);
        } else {
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(there[c], back[c], tolerance) << name_of(b) << wo.z << " " << wi.z;
        }
      }
    }
  }
}

// White furnace: the mean weight is the directional albedo, which must not exceed one. For a Lambertian
// surface it is the reflectance.
TEST(Bsdf, CreatesNoEnergy) {
  const float cosines[] = {1, 0.7f, 0.3f, 0.05f, 0.001f, -0.5f, -0.01f};
  for (const Bsdf& b : instances()) {
    for (const float z : cosines) {
      SCOPED_TRACE(name_of(b) + " wo.z " + std::to_string(z));
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
  for (const Bsdf& b : instances()) {
    // The albedo of these types counts transmission, so it is one by definition.
    if (std::holds_alternative<Dielectric>(b) || std::holds_alternative<ThinDielectric>(b)) continue;
    if (facets_of(b)) continue;  // the albedo is stated for the smooth surface
    Random random(12);
    test::Mean mean;
    for (int i = 0; i < 100000; ++i) {
      const auto s = sample(b, sample_cosine_hemisphere(random.uniform_2d()), random);
      if (s) mean.add(s->transmission ? 0 : s->weight.y);
    }
    // The albedo of a conductor is an integral by eight quadrature points over a smooth curve: 1e-3.
    EXPECT_NEAR(albedo(b).y, mean.mean, 4.5 * mean.standard_error() + 1e-3) << name_of(b);
  }
}

TEST(Bsdf, GrazingAndExtremeInputStayFinite) {
  Random random(3);
  for (const Bsdf& b : instances()) {
    for (const float z : {0.0f, -0.0f, 1e-38f, -1e-30f, 1e-20f, 1e-7f, 1.0f, 0x1.000002p0f}) {
      const Vector3 wo(std::sqrt(std::max(0.0f, 1 - z * z)), 0, z);
      for (int i = 0; i < 100; ++i) {
        const auto s = sample(b, wo, random, TransportMode::kRadiance);
        if (!s) continue;
        EXPECT_TRUE(is_finite(s->weight) && is_finite(s->wi) && s->pdf > 0) << name_of(b) << " " << z;
        EXPECT_TRUE(is_finite(f(b, wo, s->wi)) && is_finite(f(b, wo, s->wi, true)));
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
