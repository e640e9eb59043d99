// Tests light of one wavelength against the colours that it is made from and the CIE's spectral colours.

#include "core/spectrum/wavelength.h"

#include <gtest/gtest.h>

#include <array>

#include "core/spectrum/colour_space.h"
#include "core/spectrum/spectrum.h"

namespace kaustik {
namespace {

constexpr int kSamples = 1 << 22;

float nth_wavelength(int i) {
  return sample_wavelength((float(i) + 0.5f) / float(kSamples));
}

// Midpoints of equal strata: each of the 471 bins of a nanometre gets its share of the samples to one sample.
TEST(Wavelength, MeanOverWavelengthsIsTheColour) {
  constexpr std::array<Rgb, 5> kColours = {Rgb(1), Rgb(1, 0, 0), Rgb(0, 1, 0), Rgb(0, 0, 1), Rgb(3, 0.5f, 2)};
  std::array<glm::dvec3, kColours.size()> sums{};
  double largest = 0;
  for (int i = 0; i < kSamples; ++i) {
    const float nm = nth_wavelength(i);
    for (size_t c = 0; c < kColours.size(); ++c) {
      const Rgb part = at_wavelength(kColours[c], nm);
      sums[c] += part;
      largest = std::max(largest, double(glm::length(part)));
    }
  }
  for (size_t c = 0; c < kColours.size(); ++c)
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(sums[c][k] / kSamples, kColours[c][k], 471 * largest / kSamples) << c << ' ' << k;
}

// Chromaticities of spectral colours (CIE 15:2004, table T.4, to the four digits printed there; the tables
// that we use are refined from steps of 5 nm, and light of one wavelength is constant over a nanometre).
TEST(Wavelength, WhiteHasSpectralColours) {
  const struct {
    float nm;
    double x, y;
  } published[] = {{450, 0.1566, 0.0177}, {480, 0.0913, 0.1327}, {520, 0.0743, 0.8338},
                   {560, 0.3731, 0.6245}, {600, 0.6270, 0.3725}, {650, 0.7260, 0.2740}};
  for (const auto& p : published) {
    const glm::dvec3 xyz = glm::inverse(xyz_to_ours()) * glm::dvec3(at_wavelength(Rgb(1), p.nm));
    const double sum = xyz.x + xyz.y + xyz.z;
    EXPECT_NEAR(xyz.x / sum, p.x, 3e-4) << p.nm;
    EXPECT_NEAR(xyz.y / sum, p.y, 3e-4) << p.nm;
  }
}

// A colour has a share of white's light at each wavelength, and the primaries share it.
TEST(Wavelength, PrimariesShareTheLightOfWhite) {
  for (float nm = 360; nm <= 830; nm += 0.5f) {
    const Rgb white = at_wavelength(Rgb(1), nm);
    Rgb sum(0);
    for (int k = 0; k < 3; ++k) {
      Rgb primary(0);
      primary[k] = 1;
      const Rgb part = at_wavelength(primary, nm);
      EXPECT_GE(glm::dot(part, white), 0) << nm;
      sum += part;
    }
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(sum[k], white[k], 1e-5f * glm::length(white)) << nm;
  }
}

TEST(Wavelength, NumbersFromZeroToOneCoverTheRange) {
  EXPECT_NEAR(sample_wavelength(0), 359.5f, 0.01f);
  EXPECT_GT(sample_wavelength(kOneMinusEpsilon), 780);
  EXPECT_LE(sample_wavelength(kOneMinusEpsilon), 830.5f);
  for (int i = 1; i < 1000; ++i)
    EXPECT_GT(sample_wavelength(float(i) / 1000), sample_wavelength(float(i - 1) / 1000));
}

// Photons are kept in XYZ, where nothing is negative.
TEST(Wavelength, SpectralColoursAreNotNegativeInXyz) {
  for (int nm = kFirstNanometre; nm <= kLastNanometre; ++nm) {
    const glm::dvec3 xyz = ours_to_white_xyz() * glm::dvec3(at_wavelength(Rgb(1), float(nm)));
    for (int k = 0; k < 3; ++k) EXPECT_GT(xyz[k], -1e-4) << nm;
  }
}

}  // namespace
}  // namespace kaustik
