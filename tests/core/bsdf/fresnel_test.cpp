// Tests Fresnel's factor and Snell's law against their closed forms.

#include "core/bsdf/microfacet/fresnel.h"

#include <gtest/gtest.h>

#include <complex>

#include "core/bsdf/conductor.h"
#include "core/bsdf/dielectric.h"

namespace kaustik {
namespace {

// Fresnel's amplitudes in complex double arithmetic, for dielectrics and conductors alike.
double fresnel_reference(double cos_i, std::complex<double> eta) {
  const double sin2 = 1 - cos_i * cos_i;
  const std::complex<double> cos_t = std::sqrt(1.0 - sin2 / (eta * eta));
  const auto parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const auto perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5 * (std::norm(parallel) + std::norm(perpendicular));
}

// Inputs are floats, so that both sides see the same angle. A reflectance is a ratio of differences of
// numbers near one, which rounds by about 1e-6.
constexpr double kTolerance = 2e-6;

TEST(Fresnel, NormalIncidence) {
  for (const double eta : {1.1, 1.33, 1.5, 2.4}) {
    const double expected = (eta - 1) * (eta - 1) / ((eta + 1) * (eta + 1));
    EXPECT_NEAR(fresnel_dielectric(1, static_cast<float>(eta)), expected, kTolerance);
    EXPECT_NEAR(fresnel_dielectric(-1, static_cast<float>(eta)), expected, kTolerance);
  }
}

// At Brewster's angle, where tan = eta, only the perpendicular part is reflected: ((1 - eta^2) / (1 +
// eta^2))^2 / 2.
TEST(Fresnel, BrewsterAngle) {
  for (const double eta : {1.33, 1.5, 2.4}) {
    const double r = (1 - eta * eta) / (1 + eta * eta);
    const float cos_i = static_cast<float>(1 / std::sqrt(1 + eta * eta));
    EXPECT_NEAR(fresnel_dielectric(cos_i, static_cast<float>(eta)), 0.5 * r * r, kTolerance);
  }
}

TEST(Fresnel, GrazingAndTotalReflection) {
  EXPECT_EQ(fresnel_dielectric(0, 1.5f), 1);
  EXPECT_EQ(fresnel_dielectric(0, 1 / 1.5f), 1);
  const float critical = std::sqrt(1 - 1 / (1.5f * 1.5f));
  EXPECT_EQ(fresnel_dielectric(-critical * 0.999f, 1.5f), 1);
  EXPECT_LT(fresnel_dielectric(-critical * 1.001f, 1.5f), 1);
  EXPECT_EQ(fresnel_dielectric(0.3f, 1), 0);
}

TEST(Fresnel, DielectricMatchesComplexReference) {
  for (const float eta : {1.1f, 1.5f, 0.8f, 2.4f}) {
    for (int i = 1; i <= 100; ++i) {
      const float c = static_cast<float>(i) / 100;
      // At the critical angle the curve is vertical, so a rounding error e of the angle changes the value by
      // sqrt(e).
      if (std::abs((1 - c * c) / (eta * eta) - 1) < 1e-3f) continue;
      EXPECT_NEAR(fresnel_dielectric(c, eta), fresnel_reference(c, eta), 1e-5) << eta << " " << c;
    }
  }
}

TEST(Fresnel, ConductorMatchesComplexReference) {
  for (const auto& [eta, k] :
       {std::pair{0.2f, 3.9f}, {1.1f, 2.14f}, {2.5f, 0.1f}, {1.5f, 0.0f}, {0.05f, 10.0f}}) {
    for (int i = 0; i <= 100; ++i) {
      const float c = static_cast<float>(i) / 100;
      // Differences of squares of the index and the extinction lose a few more bits.
      EXPECT_NEAR(fresnel_conductor(c, eta, k), fresnel_reference(c, {eta, k}), 2e-5)
          << eta << " " << k << " " << c;
    }
  }
}

// A metal of reflectance zero matches the index of its surroundings.
TEST(Fresnel, ConductorIsNeverNegative) {
  for (int i = 0; i <= 100'000; ++i) EXPECT_GE(fresnel_conductor(float(i) * 1e-5f, 1, 0), 0.0f) << i;
}

TEST(Dielectric, ObeysSnellOnBothSides) {
  for (const float eta : {1.5f, 0.7f, 2.4f, 1.0f}) {
    const Dielectric glass{eta};
    for (const float z : {1.0f, 0.9f, 0.5f, 0.1f, -0.2f, -0.8f, -1.0f}) {
      const float r = std::sqrt(1 - z * z);
      const Vector3 wo(0.6f * r, 0.8f * r, z);
      const auto s = glass.sample_f(wo, kOneMinusEpsilon, {0.5f, 0.5f}, TransportMode::kImportance);
      ASSERT_TRUE(s);
      const float relative = z > 0 ? eta : 1 / eta;
      if (r >= relative) {  // total reflection
        EXPECT_FALSE(s->transmission);
        EXPECT_EQ(s->wi, Vector3(-wo.x, -wo.y, wo.z));
        continue;
      }
      ASSERT_TRUE(s->transmission);
      EXPECT_LT(s->wi.z * wo.z, 0);
      EXPECT_NEAR(s->wi.x * relative, -wo.x, 1e-6);
      EXPECT_NEAR(s->wi.y * relative, -wo.y, 1e-6);
      EXPECT_NEAR(glm::length(s->wi), 1, 1e-6);
    }
  }
}

TEST(Dielectric, EtaOneDoesNotBendRays) {
  const Vector3 wo = glm::normalize(Vector3(0.9f, -0.3f, 0.001f));
  const auto s = Dielectric{1}.sample_f(wo, 0, {0, 0}, TransportMode::kRadiance);
  ASSERT_TRUE(s);
  EXPECT_EQ(s->wi, -wo);
  EXPECT_EQ(s->weight, Rgb(1));
}

TEST(Dielectric, RadianceScalesByEtaSquaredFluxDoesNot) {
  const Dielectric glass{1.5f};
  for (const float z : {0.8f, -0.9f}) {
    const Vector3 wo(std::sqrt(1 - z * z), 0, z);
    const auto radiance = glass.sample_f(wo, kOneMinusEpsilon, {0, 0}, TransportMode::kRadiance);
    const auto flux = glass.sample_f(wo, kOneMinusEpsilon, {0, 0}, TransportMode::kImportance);
    ASSERT_TRUE(radiance->transmission && flux->transmission);
    // L_o / eta_o^2 = L_t / eta_t^2.
    EXPECT_FLOAT_EQ(radiance->weight.x, z > 0 ? 1 / 2.25f : 2.25f);
    EXPECT_EQ(flux->weight, Rgb(1));
    const auto reflected = glass.sample_f(wo, 0, {0, 0}, TransportMode::kRadiance);
    EXPECT_FALSE(reflected->transmission);
    EXPECT_EQ(reflected->weight, Rgb(1));
    EXPECT_FLOAT_EQ(reflected->pdf + radiance->pdf, 1);
  }
}

TEST(Conductor, ReflectsWithItsFresnelFactor) {
  const Conductor metal{Rgb(0.2f, 0.92f, 1.1f), Rgb(3.9f, 2.45f, 2.14f)};
  const auto s = metal.sample_f({0, 0, -1}, 0, {0, 0}, TransportMode::kRadiance);
  EXPECT_EQ(s->wi, Vector3(0, 0, -1));
  for (int c = 0; c < 3; ++c) {
    const double n1 = metal.eta[c] - 1, n2 = metal.eta[c] + 1, k2 = metal.k[c] * metal.k[c];
    EXPECT_NEAR(s->weight[c], (n1 * n1 + k2) / (n2 * n2 + k2), kTolerance);
  }
}

}  // namespace
}  // namespace kaustik
