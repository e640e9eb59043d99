// Tests the predicted memory of a shoot, and the limit on it.

#include "photon/shoot/memory_estimate.h"

#include <gtest/gtest.h>

#include "tests/photon/support/trace_scenes.h"
#include "tests/support/shapes.h"

namespace kaustik::photon {
namespace {

using test::settings_for;

constexpr KindMask kDirectOnly = {true, false, false, false};
const Scene kRoom = test::lit_room(Rgb(0.5f), Rgb(1));
constexpr uint64_t kUnlimited = std::numeric_limits<uint64_t>::max();

// The message of check_memory; empty when it allows the shoot.
std::string refusal(const Scene& scene, const TraceSettings& settings, PhotonUse use, uint64_t limit) {
  try {
    check_memory(scene, accel::Bvh(scene), settings, use, limit);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

// The counts of two shoots of n photons each differ by less than 5 standard deviations sqrt(2 v), where v is
// the variance of one: at most 16 times its mean for counts of 0 to 16 per photon.
TEST(MemoryEstimate, MatchesWhatALargerShootStores) {
  const Scene scene = test::foggy_room();
  const accel::Bvh bvh(scene);
  const TraceSettings settings = settings_for(2 * kEstimatePhotons, test::kAllKinds);
  const auto estimate = estimate_stored(scene, bvh, settings);
  const TraceCounters counted = shoot(scene, bvh, settings).counters;
  for (size_t k = 0; k < kPhotonKinds; ++k) {
    EXPECT_GT(estimate[k], 0) << kPhotonKindNames[k];
    EXPECT_NEAR(estimate[k], double(counted.stored[k]), 5 * std::sqrt(2 * 16 * estimate[k] / 2))
        << kPhotonKindNames[k];
  }
}

// In a closed room of albedo 1/2 half of the photons survive each meeting: they leave 1/2 + 1/4 + ... = 1
// indirect photon each, and those that leave any leave 2, which is what a photon does that is guided. Of n =
// 65,536 both means have relative variances below 3 / n and 1 / n.
TEST(MemoryEstimate, GuidedPhotonsAllLeaveIndirectOnes) {
  const accel::Bvh bvh(kRoom);
  const TraceSettings settings = settings_for(1'000'000, {false, false, false, true});
  const auto bytes = [&](const GuidedPhotons& guided) {
    return double(forecast_bytes(kRoom, bvh, settings, PhotonUse::kMaps, guided));
  };
  const double n = double(kEstimatePhotons);
  EXPECT_NEAR(bytes({0, true}) / bytes({}), 2, 5 * 2 * std::sqrt(4 / n));
  EXPECT_NEAR(bytes({}), 52e6, 5 * 52e6 * std::sqrt(3 / n));
}

TEST(MemoryEstimate, PeakIsTheBuildOfTheLargestMapBesideTheOthers) {
  EXPECT_EQ(peak_bytes({10, 20, 30, 40}, PhotonUse::kRecords), 24 * 100);
  EXPECT_DOUBLE_EQ(peak_bytes({10, 20, 30, 40}, PhotonUse::kMaps), 26.4 * 60 + 52 * 40);
}

// In a closed room every emitted photon leaves one direct photon.
TEST(MemoryEstimate, RefusesTooManyPhotonsAndNamesANumberThatFits) {
  const TraceSettings settings = settings_for(1'000'000'000, kDirectOnly);
  EXPECT_EQ(refusal(kRoom, settings, PhotonUse::kMaps, 52'000'000'000), "");
  EXPECT_EQ(refusal(kRoom, settings, PhotonUse::kRecords, 24'000'000'000), "");
  EXPECT_EQ(
      refusal(kRoom, settings, PhotonUse::kMaps, 26'000'000'000),
      "1000000000 photons would need about 52 GB of memory, but 26 GB are available: emit at most about "
      "500M at a time, or store fewer kinds");
  EXPECT_NE(refusal(kRoom, settings, PhotonUse::kRecords, 23'999'999'999), "");
}

TEST(MemoryEstimate, RefusesMorePhotonsThanAMapCanNumber) {
  const TraceSettings settings = settings_for(8'589'934'588, kDirectOnly);  // 2 (2^32 - 2)
  EXPECT_EQ(
      refusal(kRoom, settings, PhotonUse::kMaps, kUnlimited),
      "8589934588 photons would store about 8.59e+09 in one map, which holds at most 4294967294: emit at "
      "most about 4.2G at a time");
  EXPECT_EQ(refusal(kRoom, settings, PhotonUse::kRecords, kUnlimited), "");
}

// The direct photons alone fill the limit; photons that meet the shelf leave shadow photons behind it.
TEST(MemoryEstimate, ShadowPhotonsCountToo) {
  Scene scene = kRoom;
  scene.shapes.push_back(test::parallelogram({-0.5f, 0, -0.5f}, {0, 0, 1}, {1, 0, 0}));
  finalize_scene(scene);
  const uint64_t photons = 10'000'000, limit = 24 * photons;
  const TraceSettings direct = settings_for(photons, kDirectOnly);
  const TraceSettings both = settings_for(photons, {true, true, false, false});
  EXPECT_EQ(refusal(scene, direct, PhotonUse::kRecords, limit), "");
  EXPECT_NE(refusal(scene, both, PhotonUse::kRecords, limit), "");
}

TEST(MemoryEstimate, NoPhotonsNeedNoMemory) {
  EXPECT_EQ(refusal(kRoom, settings_for(0, kDirectOnly), PhotonUse::kMaps, 0), "");
}

}  // namespace
}  // namespace kaustik::photon
