#include "photon/estimate/radiance_estimate.h"

#include <gtest/gtest.h>

#include "tests/photon/support/photon_sets.h"
#include "tests/support/packed_flux.h"

namespace kaustik::photon {
namespace {

constexpr int kPhotons = 40000;

// A unit square floor under even light: each photon carries E / kPhotons watts and arrives from straight
// above.
PhotonMap even_floor(const Rgb& E) {
  PhotonMaker make(40);
  std::vector<Photon> photons;
  for (int i = 0; i < kPhotons; ++i) {
    photons.push_back({{make.uniform(), make.uniform(), 0}, {0, 0, 1}, E / float(kPhotons), {0, 0, 1}, 5});
  }
  return PhotonMap::build(make_buffer(photons, 0x1p-15f));
}

SurfaceInteraction middle() {
  SurfaceInteraction si;
  si.p = {0.5f, 0.5f, 0};
  si.surface_group = 5;
  return si;
}

const Vector3 kViewer = glm::normalize(Vector3(0.3f, -0.2f, 0.8f));
const Rgb kIrradiance(3, 2, 0.5f);

// The number of photons in reach is binomial: the relative standard error of the constant kernel is
// 1/sqrt(n), that of a kernel K is sqrt(pi r^2 int K^2 / n). The tolerance is five of them and the rounding
// of packed fluxes.
float tolerance(float radius, KernelType type) {
  const KernelSpec kernel{type, 1};
  const KernelTerms terms = kernel_terms(kernel, radius);
  constexpr int kRings = 1000;  // of equal area
  double squares = 0;
  for (int i = 0; i < kRings; ++i) {
    const double k = double(kernel_value(type, terms, radius * radius * (float(i) + 0.5f) / kRings));
    squares += k * k / kRings;
  }
  const double area = double(kPi * radius * radius), n = area * double(kPhotons);
  return float(5 * std::sqrt(squares * area * area / n) + test::kPackedFluxError);
}

TEST(RadianceEstimate, LambertianUnderEvenLightIsAlbedoTimesIrradianceOverPi) {
  const PhotonMap map = even_floor(kIrradiance);
  const Lambertian bsdf{Rgb(0.8f, 0.5f, 0.2f)};
  const Rgb expected = bsdf.reflectance * kIrradiance * kInvPi;
  for (const KernelType type : kKernelTypes) {
    for (const bool leaf : {false, true}) {
      const EstimateSettings settings{0.1f, {type, 1}, 0, leaf, 64};
      GatherCounters counters;
      const Rgb Lr = estimate_radiance(map, middle(), kViewer, bsdf, settings, counters);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(Lr[c], expected[c], expected[c] * tolerance(0.1f, type));
      EXPECT_EQ(counters.queries, 1u);
    }
  }
}

TEST(RadianceEstimate, OtherBsdfsAreEvaluatedPerPhoton) {
  const PhotonMap map = even_floor(kIrradiance);
  const EstimateSettings settings{0.1f, {KernelType::kEpanechnikov, 1}, 0, false, 64};
  GatherCounters counters;
  // Without roughness Oren-Nayar is Lambertian: both branches must agree up to the rounding of up to n terms.
  const Rgb smooth =
      estimate_radiance(map, middle(), kViewer, OrenNayar{Rgb(0.5f), 1, 0}, settings, counters);
  const Rgb lambertian = estimate_radiance(map, middle(), kViewer, Lambertian{Rgb(0.5f)}, settings, counters);
  const float rounding = float(counters.accepted) * std::numeric_limits<float>::epsilon();
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(smooth[c], lambertian[c], lambertian[c] * rounding);
  // With roughness, light from one direction has a single value of f.
  const OrenNayar rough = OrenNayar::from_sigma_degrees(Rgb(0.5f), 30);
  const Rgb expected = rough.f(kViewer, {0, 0, 1}) * kIrradiance;
  const Rgb Lr = estimate_radiance(map, middle(), kViewer, rough, settings, counters);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(Lr[c], expected[c], expected[c] * tolerance(0.1f, KernelType::kEpanechnikov));
}

TEST(RadianceEstimate, NearestUsesTheDiscOfTheKthPhoton) {
  const PhotonMap map = even_floor(kIrradiance);
  constexpr uint32_t kNearest = 400;
  const EstimateSettings settings{0.5f, {}, kNearest, false, 64};
  GatherCounters counters;
  const Rgb Lr = estimate_radiance(map, middle(), kViewer, Lambertian{Rgb(1)}, settings, counters);
  // With the radius of the K-th photon the density K/A is a gamma variate: relative error 1/sqrt(K), bias
  // 1/(K-1).
  const Rgb expected = kIrradiance * kInvPi;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(Lr[c], expected[c], expected[c] * 5 / std::sqrt(float(kNearest)));
}

// All light comes from one direction, which is in the tail of the glossy lobe or is not.
TEST(RadianceEstimate, TheTailOfAGlossyLobeIsGathered) {
  const PhotonMap map = even_floor(kIrradiance);
  const Conductor metal{Rgb(0.2f, 0.9f, 1.1f), Rgb(3.9f, 2.4f, 2.2f), {0.15f, 0.15f}};
  ASSERT_TRUE(metal.lobes().glossy);
  const Vector3 wi(0, 0, 1);
  const float pdf = metal.pdf_glossy(kViewer, wi);
  const Rgb expected = metal.f_glossy(kViewer, wi) * kIrradiance;
  const EstimateSettings settings{0.1f, {KernelType::kEpanechnikov, 1}, 0, false, 64};
  GatherCounters counters;
  const auto tail = [&](const Bsdf& bsdf, float most_pdf) {
    return estimate_glossy_tail(map, middle(), kViewer, bsdf, settings, most_pdf, counters);
  };
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(tail(metal, 1.01f * pdf)[c], expected[c],
                expected[c] * tolerance(0.1f, KernelType::kEpanechnikov));
  EXPECT_EQ(tail(metal, 0.99f * pdf), Rgb(0));
  EXPECT_EQ(tail(Lambertian{Rgb(0.5f)}, 1e9f), Rgb(0));
  EXPECT_EQ(tail(Mirror{}, 1e9f), Rgb(0));
}

TEST(RadianceEstimate, OtherGroupsAndTheOtherSideDoNotCount) {
  const PhotonMap map = even_floor(kIrradiance);
  const EstimateSettings settings{0.1f, {}, 0, false, 64};
  GatherCounters counters;
  SurfaceInteraction other = middle();
  other.surface_group = 6;
  EXPECT_EQ(estimate_radiance(map, other, kViewer, Lambertian{}, settings, counters), Rgb(0));
  EXPECT_EQ(estimate_radiance(map, middle(), -kViewer, Lambertian{}, settings, counters), Rgb(0));
}

TEST(RadianceEstimate, EmptyMapsAndSpecularSurfacesAreBlack) {
  GatherCounters counters;
  const EstimateSettings settings{0.1f, {}, 0, false, 64};
  EXPECT_EQ(estimate_radiance(PhotonMap(), middle(), kViewer, Lambertian{}, settings, counters), Rgb(0));
  EXPECT_EQ(estimate_radiance(even_floor(kIrradiance), middle(), kViewer, Mirror{}, settings, counters),
            Rgb(0));
}

}  // namespace
}  // namespace kaustik::photon
