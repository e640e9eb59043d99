// Coloured dielectrics: closed forms of their lobes.

#include "core/bsdf/lobe_tints.h"

#include <gtest/gtest.h>

#include "core/bsdf/dielectric.h"
#include "core/bsdf/thin_dielectric.h"
#include "tests/core/support/bsdf_examples.h"
#include "tests/support/random.h"

namespace kaustik {
namespace {

using test::kTints;
using test::Random;
constexpr TransportMode kModes[] = {TransportMode::kRadiance, TransportMode::kImportance};

// The weight of each lobe times its probability is its tint times its Fresnel factor, which plain glass
// gives.
template <class B>
void expect_tinted_lobes(const B& plain, const B& tinted) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vector3 wo = random.direction();
    for (const TransportMode mode : kModes) {
      for (const float uc : {0.0f, kOneMinusEpsilon}) {
        const auto expected = plain.sample_f(wo, uc, {}, mode), found = tinted.sample_f(wo, uc, {}, mode);
        ASSERT_TRUE(expected && found);
        ASSERT_EQ(found->transmission, expected->transmission);
        EXPECT_EQ(found->wi, expected->wi);
        const Rgb lobe = expected->pdf * expected->weight * kTints.of_lobe(expected->transmission);
        // 1 - F and the two divisions round relative to one, so a faint lobe is off by some 2^-24 in all.
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(found->pdf * found->weight[c], lobe[c], 16 * 0x1p-24 * (1 + double(lobe[c])));
        const float most = mode == TransportMode::kRadiance ? max_component(expected->weight) : 1.0f;
        EXPECT_LE(max_component(found->weight), most * (1 + 4 * 0x1p-24f));
      }
    }
  }
}

TEST(LobeTints, ScaleTheLobesOfSmoothGlass) {
  expect_tinted_lobes(Dielectric{1.5f}, Dielectric{1.5f, {}, kTints});
  expect_tinted_lobes(Dielectric{1}, Dielectric{1, {}, kTints});
  expect_tinted_lobes(ThinDielectric{1.5f}, ThinDielectric{1.5f, kTints});
}

// Both values round the same terms; the tint is one more product.
TEST(LobeTints, ScaleTheValueOfRoughGlass) {
  for (const float alpha : {0.2f, 0.7f}) {
    const Dielectric plain{1.5f, {alpha, alpha}}, tinted{1.5f, {alpha, alpha}, kTints};
    Random random(4);
    for (int i = 0; i < 1000; ++i) {
      const Vector3 wo = random.direction(), wi = random.direction();
      const Rgb expected =
          kTints.of_lobe(!same_hemisphere(wo, wi)) * (plain.f(wo, wi) + plain.f_glossy(wo, wi));
      const Rgb found = tinted.f(wo, wi) + tinted.f_glossy(wo, wi);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 4 * 0x1p-24 * double(expected[c]));
    }
  }
}

// Whatever number is drawn, plain glass gives the same sample as before there were tints: tints of one change
// nothing.
TEST(LobeTints, OfOneAreNone) {
  const Dielectric white{1.5f, {}, {Rgb(1), Rgb(1)}};
  EXPECT_FALSE(white.tints.tinted());
  EXPECT_TRUE((Dielectric{1.5f, {}, {Rgb(1), Rgb(1, 1, 0.5f)}}).tints.tinted());
  EXPECT_EQ(white.sample_f({0, 0, 1}, 0.5f, {}, TransportMode::kImportance)->weight, Rgb(1));
  EXPECT_EQ(white.albedo(), Rgb(1));
}

TEST(LobeTints, BlackLobesScatterNothing) {
  const Vector3 wo = glm::normalize(Vector3(1, 0.5f, 1)), inside = glm::normalize(Vector3(1, 0, -0.2f));
  const LobeTints black(Rgb(0), Rgb(0)), clear(Rgb(0), Rgb(1)), opaque(Rgb(1), Rgb(0));
  for (const float uc : {0.0f, 0.5f, kOneMinusEpsilon}) {
    for (const Ggx& facets : {Ggx{}, Ggx{0.5f, 0.5f}}) {
      const Point2 u(0.3f, 0.4f);
      EXPECT_FALSE((Dielectric{1.5f, facets, black}).sample_f(wo, uc, u, kModes[0]));
      EXPECT_TRUE((Dielectric{1.5f, facets, clear}).sample_f(wo, uc, u, kModes[0])->transmission);
      EXPECT_FALSE((Dielectric{1.5f, facets, opaque}).sample_f(wo, uc, u, kModes[0])->transmission);
    }
    // Total internal reflection leaves nothing to transmit.
    EXPECT_FALSE((Dielectric{1.5f, {}, clear}).sample_f(inside, uc, {}, kModes[0]));
    EXPECT_FALSE((ThinDielectric{1.5f, black}).sample_f(wo, uc, {}, kModes[0]));
  }
}

}  // namespace
}  // namespace kaustik
