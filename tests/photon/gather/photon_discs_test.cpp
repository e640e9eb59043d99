#include "photon/gather/photon_discs.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "photon/gather/gather.h"
#include "tests/photon/support/photon_sets.h"

namespace kaustik::photon {
namespace {

const Normal3 kUp(0, 0, 1);
constexpr uint32_t kFewest = 60, kMost = 400;

// Photons of unit flux that lie evenly on the square [0, 1]^2 but for the part where x < edge, which has one
// in `ratio` of the others' density.
std::vector<Photon> half_lit(int bright, float ratio, float edge) {
  PhotonMaker make(11);
  std::vector<Photon> photons;
  while (photons.size() < size_t(bright)) {
    const Point3 p(make.uniform(), make.uniform(), 0);
    if (p.x >= edge || make.uniform() * ratio < 1) photons.push_back({p, kUp, Rgb(1), kUp, 0});
  }
  return photons;
}

float radius_of(const PhotonDiscs& discs, uint64_t i) {
  return discs.largest() / std::sqrt(discs.stretch()[i]);
}

GatherQuery query_at(const PhotonDiscs& discs, const Point3& p) {
  return {p, kUp, 0, discs.largest(), kAllPhotons, &discs};
}

// The integral of the estimate over the plane, by the midpoint rule.
double integral(const PhotonMap& map, const PhotonDiscs& discs, KernelType kernel, int cells) {
  double sum = 0;
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) {
      const Point3 p(2 * (float(x) + 0.5f) / float(cells) - 0.5f, 2 * (float(y) + 0.5f) / float(cells) - 0.5f,
                     0);
      GatherCounters ignored;
      sum += double(gather_flux(map, query_at(discs, p), {kernel}, ignored).x);
    }
  return sum * 4 / (double(cells) * double(cells));
}

// Each kernel integrates to one, so that the estimates add up to the photons' flux whatever their radii are:
// an edge of light gains nothing. A kernel on one radius for each point would gain several per cent here.
// Smallest discs are 10 cells wide, and the errors of many discs cancel out.
TEST(PhotonDiscs, EstimatesAddUpToTheFluxAtAnEdge) {
  const std::vector<Photon> photons = half_lit(4000, 20, 0.5f);
  const PhotonMap map = PhotonMap::build(make_buffer(photons));
  const PhotonDiscs discs(map, {kFewest, kMost, 0.2f});
  for (const KernelType kernel : {KernelType::kConstant, KernelType::kEpanechnikov})
    EXPECT_NEAR(integral(map, discs, kernel, 400), double(photons.size()), 0.002 * double(photons.size()));
}

// Discs beside an edge keep off it or hold few photons; others grow until the rule ends it.
TEST(PhotonDiscs, AreNarrowAtAnEdgeAndWideWhereLightIsEven) {
  const PhotonMap map = PhotonMap::build(make_buffer(half_lit(100'000, 50, 0.5f)));
  const PhotonDiscs discs(map, {kFewest, 4000, 0.2f});
  // 100,000 photons, of which one in 51 is in the dark half.
  const double density = 2 * 100'000 * 50 / 51.0;
  const auto radius_for = [&](double photons) { return float(std::sqrt(photons / (3.14159265 * density))); };
  std::vector<float> at_edge, inside;
  for (uint64_t i = 0; i < map.size(); ++i) {
    const Point3 p = map.photon(i).p;
    if (p.y < 0.2f || p.y > 0.8f) continue;
    if (p.x > 0.5f && p.x < 0.501f) at_edge.push_back(radius_of(discs, i));
    if (p.x > 0.7f && p.x < 0.8f) inside.push_back(radius_of(discs, i));
  }
  const auto median = [](std::vector<float>& values) {
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
  };
  // Of discs at the very edge one half is dark: as wide as those of twice as many photons.
  EXPECT_LT(median(at_edge), 1.2f * radius_for(2 * kFewest));
  EXPECT_GT(median(inside), radius_for(4000 / 2.25));
  for (const float r : inside) EXPECT_LT(r, radius_for(1.2 * 4000 * 2.25));
}

// A photon of a hundred times the others' flux is spread over a disc of fifty times their area or more.
TEST(PhotonDiscs, BrightPhotonsGetWideOnes) {
  std::vector<Photon> photons = half_lit(20'000, 1, 0);
  Photon bright{{0.5f, 0.5f, 0}, kUp, Rgb(100), kUp, 0};
  photons.push_back(bright);
  const PhotonMap map = PhotonMap::build(make_buffer(photons));
  const PhotonDiscs discs(map, {kFewest, kFewest, 1});
  float widest = 0;
  std::vector<float> others;
  for (uint64_t i = 0; i < map.size(); ++i) {
    const Photon photon = map.photon(i);
    if (photon.flux.x > 50)
      widest = radius_of(discs, i);
    else if (length_squared(photon.p - bright.p) < 0.01f)
      others.push_back(radius_of(discs, i));
  }
  std::sort(others.begin(), others.end());
  EXPECT_GT(widest, 4 * others[others.size() / 2]);
  EXPECT_LT(widest, 8 * others[others.size() / 2]);
}

// SIMD sums, selections and the boxes' least stretches give what each photon alone gives.
TEST(PhotonDiscs, GathersSumWhatBruteForceSums) {
  for (const PhotonSet& set : photon_sets()) {
    const PhotonMap map = PhotonMap::build(make_buffer(set.photons));
    const PhotonDiscs discs(map, {kFewest, kMost, 0.5f});
    for (GatherQuery query : queries_for(set, 60)) {
      query.radius = discs.largest(), query.discs = &discs;
      const KernelSpec kernel{KernelType::kEpanechnikov};
      double expected = 0, selected = 0;
      uint64_t count = 0;
      for (uint64_t i = 0; i < map.size(); ++i) {
        GatherQuery own = query;
        own.discs = nullptr, own.radius = radius_of(discs, i), own.within = {i, i + 1};
        GatherCounters counted;
        expected += double(gather_flux(map, own, kernel, counted).y);
        count += counted.accepted;
      }
      GatherCounters counters, ignored;
      const Rgb flux = gather_flux(map, query, kernel, counters);
      const KernelTerms terms = kernel_terms(kernel, query.radius);
      for_each_photon(
          map, query,
          [&](const Photon& photon, float d2) {
            selected += double(photon.flux.y * kernel_value(kernel.type, terms, d2));
          },
          ignored);
      // Photons on a rim, where the kernel is zero, may be taken as in or out.
      ASSERT_NEAR(double(counters.accepted), double(count), 2 + 0.001 * double(count)) << set.name;
      ASSERT_NEAR(double(flux.y), expected, 1e-4 * expected) << set.name;
      ASSERT_NEAR(selected, expected, 1e-4 * expected) << set.name;
    }
  }
}

TEST(PhotonDiscs, AreTheSameForAnyNumberOfThreadsAndScaleExactly) {
  std::vector<Photon> photons = half_lit(30'000, 10, 0.3f);
  const PhotonMap map = PhotonMap::build(make_buffer(photons));
  const PhotonDiscs discs(map, {kFewest, kMost, 0.1f});
  for (Photon& photon : photons) photon.p *= 0x1p-7f;
  const PhotonMap scaled_map = PhotonMap::build(make_buffer(photons));
  for (const size_t threads : {1u, 3u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const PhotonDiscs again(map, {kFewest, kMost, 0.1f});
    const PhotonDiscs scaled(scaled_map, {kFewest, kMost, 0.1f * 0x1p-7f});
    for (uint64_t i = 0; i < map.size(); ++i) {
      ASSERT_EQ(discs.stretch()[i], again.stretch()[i]);
      ASSERT_EQ(discs.stretch()[i], scaled.stretch()[i]);
    }
  }
}

}  // namespace
}  // namespace kaustik::photon
