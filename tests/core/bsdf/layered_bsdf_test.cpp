// Tests microfacets, coats and panes against integrals and sums that they must reproduce.

#include <gtest/gtest.h>

#include "core/bsdf/bsdf.h"
#include "core/bsdf/microfacet/rough_coat.h"
#include "tests/core/support/bsdf_examples.h"
#include "tests/core/support/chi_square.h"
#include "tests/support/random.h"
#include "tests/support/statistics.h"

namespace kaustik {
namespace {

using test::kCopperEta, test::kCopperK;
using test::Random;

const Vector3 kDirections[] = {{0, 0, 1},
                               {0, 0, -1},
                               glm::normalize(Vector3(1, 0.5f, 1)),
                               glm::normalize(Vector3(-1, 0.2f, -0.3f)),
                               glm::normalize(Vector3(0.3f, -1, 0.01f))};

// pbrt-v4's convention: alpha = sqrt(roughness) unless remapping is off, and below 1e-3 the surface is
// smooth.
TEST(Ggx, RoughnessFollowsPbrtsConvention) {
  EXPECT_EQ(Ggx::from_roughness(0.25f, 0.04f, true).alpha_x, 0.5f);
  EXPECT_EQ(Ggx::from_roughness(0.25f, 0.04f, true).alpha_y, 0.2f);
  EXPECT_EQ(Ggx::from_roughness(0.25f, 0.04f, false).alpha_x, 0.25f);
  EXPECT_TRUE(Ggx::from_roughness(0, 0, true).smooth());
  EXPECT_TRUE(Ggx::from_roughness(0.9e-6f, 0.9e-6f, true).smooth());
  EXPECT_FALSE(Ggx::from_roughness(1.1e-6f, 0, true).smooth());
  EXPECT_EQ(Ggx::from_roughness(1.1e-6f, 0, true).alpha_y, Ggx::kLeastAlpha);
}

// The projected areas of all facets add up to the surface, and those that w sees add up to what w sees of the
// surface (Heitz 2014, equations 4 and 14).
TEST(Ggx, FacetsProjectToTheSurface) {
  for (const Ggx& g : {Ggx{0.3f, 0.3f}, Ggx{1, 1}, Ggx{0.4f, 0.8f}}) {
    for (const Vector3& w : kDirections) {
      // Midpoint rule in s = tan / (1 + tan) and phi.
      constexpr int kSteps = 400;
      double area = 0, seen = 0;
      for (int i = 0; i < kSteps; ++i) {
        const double s = (i + 0.5) / kSteps, t = s / (1 - s), z = 1 / std::sqrt(1 + t * t);
        // sin(theta) dtheta, with dtan/ds = (1 + t)^2 and dtheta/dtan = z^2.
        const double measure = t * z * z * z * (1 + t) * (1 + t) / kSteps;
        for (int j = 0; j < kSteps; ++j) {
          const double phi = (j + 0.5) * 2 * std::numbers::pi / kSteps;
          const Vector3 wm(glm::dvec3(t * z * std::cos(phi), t * z * std::sin(phi), z));
          const double m = measure * 2 * std::numbers::pi / kSteps;
          area += double(g.D(wm) * wm.z) * m;
          const Vector3 up(w.x, w.y, std::abs(w.z));
          if (glm::dot(up, wm) > 0) seen += double(g.visible_D(up, wm)) * m;
        }
      }
      EXPECT_NEAR(area, 1, 2e-3);
      EXPECT_NEAR(seen, 1, 2e-3);
    }
  }
}

// At the threshold a lobe changes from specular to diffuse and keeps its values.
TEST(Ggx, WidthDecidesWhetherALobeIsSpecular) {
  const Vector3 wo = kDirections[2], wi = glm::normalize(Vector3(-0.8f, -0.7f, 1));
  const float a = Ggx::kNarrowAlpha;
  const Conductor narrow{kCopperEta, kCopperK, {0.999f * a, a}},
      diffuse{kCopperEta, kCopperK, {1.001f * a, a}};
  EXPECT_TRUE(narrow.lobes().glossy && narrow.lobes().specular && !narrow.lobes().diffuse);
  EXPECT_TRUE(diffuse.lobes().diffuse && !diffuse.lobes().glossy && !diffuse.lobes().specular);
  EXPECT_EQ(narrow.f(wo, wi), Rgb(0));
  EXPECT_EQ(diffuse.f_glossy(wo, wi), Rgb(0));
  EXPECT_NEAR(narrow.f_glossy(wo, wi).x, diffuse.f(wo, wi).x, 0.01f * diffuse.f(wo, wi).x);
}

// A white base under a coat that absorbs nothing loses no energy: for every direction, what the coat reflects
// and what leaves after all inner reflections add up to one. The midpoint rule with 1000 points is accurate
// to 1e-5.
TEST(CoatedDiffuse, WhiteFurnace) {
  for (const float eta : {1.0f, 1.33f, 1.5f, 2.5f}) {
    const CoatedDiffuse b = CoatedDiffuse::from_reflectance(Rgb(1), eta);
    for (const float z : {1.0f, 0.7f, 0.3f, 0.05f}) {
      const Vector3 wo(std::sqrt(1 - z * z), 0, z);
      double out = double(fresnel_dielectric(z, eta));
      constexpr int kPoints = 1000;
      for (int i = 0; i < kPoints; ++i) {
        const float c = (i + 0.5f) / kPoints;
        out += 2 * std::numbers::pi * double(b.f(wo, {std::sqrt(1 - c * c), 0, c}).x * c) / kPoints;
      }
      // fresnel_diffuse() is off by 1e-6, which inner reflections above a white base multiply by up to 20.
      EXPECT_NEAR(out, 1, 1e-4) << eta << " " << z;
    }
  }
}

// Each part is chosen in proportion to its light, so that no sample of one part weighs more than what the
// whole surface scatters.
TEST(CoatedDiffuse, NoSampleOutweighsTheWholeSurface) {
  const CoatedDiffuse b = CoatedDiffuse::from_reflectance(Rgb(0.5f, 0.2f, 0.8f), 1.5f);
  Random random(9);
  for (const Vector3& wo : kDirections) {
    test::Mean either, diffuse, specular;
    for (int i = 0; i < 50000; ++i) {
      const Point2 u = random.uniform_2d();
      const float uc = random.uniform();
      constexpr TransportMode kMode = TransportMode::kRadiance;
      if (const auto s = b.sample_f(wo, uc, u, kMode)) either.add(double(s->weight.x));
      if (const auto s = b.sample_diffuse(wo, uc, u, kMode)) diffuse.add(double(s->weight.x));
      if (const auto s = b.sample_specular(wo, uc, u, kMode)) specular.add(double(s->weight.x));
    }
    EXPECT_NEAR(either.mean, diffuse.mean + specular.mean,
                4.5 * std::hypot(either.standard_error(), diffuse.standard_error()) + 1e-6);
  }
}

// The reference sums all reflections between two smooth surfaces one by one.
TEST(ThinDielectric, EqualsTheSumOfAllReflections) {
  const Vector3 wo = glm::normalize(Vector3(1, 0, 0.4f));
  const double R = double(fresnel_dielectric(wo.z, 1.5f)), T = 1 - R;
  double reflected = R;
  for (int i = 0; i < 200; ++i) reflected += T * T * std::pow(R, 2 * i + 1);
  const auto s = ThinDielectric{1.5f}.sample_f(wo, 0, {}, TransportMode::kRadiance);
  EXPECT_NEAR(s->pdf, reflected, 1e-6);
  const auto through = ThinDielectric{1.5f}.sample_f(wo, 0.999f, {}, TransportMode::kRadiance);
  EXPECT_EQ(through->wi, -wo);
  EXPECT_NEAR(through->pdf, 1 - reflected, 1e-6);
}

// Compares the table with many samples of the boundary itself, at random cosines, alphas and indices. The
// table is interpolated linearly between smooth curves.
TEST(RoughCoat, TableMatchesSamplesOfTheBoundary) {
  Random random(21);
  for (int i = 0; i < 40; ++i) {
    const float alpha = random.uniform(0.02f, 1), eta = random.uniform(1.05f, 3),
                z = random.uniform(0.02f, 1);
    const Dielectric boundary{eta, {alpha, alpha}};
    const Vector3 wo(std::sqrt(1 - z * z), 0, z);
    test::Mean through, inner;
    for (int k = 0; k < 20000; ++k) {
      const auto s = boundary.sample_f(wo, random.uniform(), random.uniform_2d(), TransportMode::kImportance);
      through.add(s && s->transmission ? double(s->weight.x) : 0.0);
      Vector3 from_inside = sample_cosine_hemisphere(random.uniform_2d());
      from_inside.z = -from_inside.z;
      const auto r =
          boundary.sample_f(from_inside, random.uniform(), random.uniform_2d(), TransportMode::kImportance);
      inner.add(r && !r->transmission ? double(r->weight.x) : 0.0);
    }
    EXPECT_NEAR(double(rough_transmittance(z, alpha, eta)), through.mean,
                4.5 * through.standard_error() + 0.01)
        << alpha << " " << eta << " " << z;
    EXPECT_NEAR(double(rough_inner_reflectance(alpha, eta)), inner.mean, 4.5 * inner.standard_error() + 0.01)
        << alpha << " " << eta;
  }
}

}  // namespace
}  // namespace kaustik
