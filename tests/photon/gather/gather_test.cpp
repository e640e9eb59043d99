// Tests every instruction set of this machine against the baseline.

#include "photon/gather/gather.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "photon/gather/nearest.h"
#include "tests/photon/support/photon_sets.h"

namespace kaustik::photon {
namespace {

// Restricts the run-time dispatch to one instruction set until it goes out of scope.
class OnlyTarget {
 public:
  explicit OnlyTarget(int64_t target) { set(target); }
  ~OnlyTarget() { set(0); }

 private:
  static void set(int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

std::vector<int64_t> targets() {
  std::vector<int64_t> result;
  for (int64_t left = hwy::SupportedTargets(); left; left &= left - 1) result.push_back(left & -left);
  return result;
}

struct Answer {
  Rgb flux;
  uint64_t accepted;
  std::vector<float> distances;
  float nearest;
};

std::vector<Answer> ask(const PhotonMap& map, const std::vector<GatherQuery>& queries) {
  std::vector<Answer> answers;
  for (const GatherQuery& query : queries) {
    Answer answer{};
    GatherCounters counters;
    answer.flux = gather_flux(map, query, {KernelType::kEpanechnikov, 1}, counters);
    answer.accepted = counters.accepted;
    for_each_photon(
        map, query, [&](const Photon&, float d2) { answer.distances.push_back(d2); }, counters);
    answer.nearest = nearest_radius(map, query, 5, counters);
    answers.push_back(std::move(answer));
  }
  return answers;
}

TEST(Gather, EveryInstructionSetAcceptsTheSamePhotons) {
  ASSERT_FALSE(targets().empty());
  for (const PhotonSet& set : photon_sets()) {
    const PhotonMap map = PhotonMap::build(make_buffer(set.photons));
    const std::vector<GatherQuery> queries = queries_for(set, 60);
    std::vector<Answer> plain;
    {
      const OnlyTarget only(targets().back());
      plain = ask(map, queries);
    }
    for (const int64_t target : targets()) {
      const OnlyTarget only(target);
      const std::vector<Answer> answers = ask(map, queries);
      for (size_t i = 0; i < answers.size(); ++i) {
        ASSERT_EQ(answers[i].accepted, plain[i].accepted) << hwy::TargetName(target) << ", " << set.name;
        ASSERT_EQ(answers[i].distances, plain[i].distances) << hwy::TargetName(target) << ", " << set.name;
        ASSERT_EQ(answers[i].nearest, plain[i].nearest) << hwy::TargetName(target) << ", " << set.name;
        // The sums run in another order, over at most 1024 terms per lane: see PhotonMapSets in
        // photon_map_test.cpp.
        const float scale = kernel_terms({KernelType::kEpanechnikov, 1}, queries[i].radius).scale;
        const float bound =
            (1024 + 16) * std::numeric_limits<float>::epsilon() * scale * float(plain[i].accepted);
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(answers[i].flux[c], plain[i].flux[c], bound);
      }
    }
  }
}

// Where a kernel falls to zero at the rim, rounding of its polynomial must not make it negative: samples of
// negative radiance are dropped.
TEST(Gather, PhotonsNearTheRimHaveNoNegativeWeight) {
  PhotonMaker make(3);
  const Normal3 up(0, 0, 1);
  for (int i = 0; i < 300; ++i) {
    const float radius = make.uniform(0.1f, 1), distance = radius * (1 - 1e-5f * float(i % 100));
    Photon photon = make.at({distance, 0, 0}, up, 0);
    photon.flux = Rgb(1);
    const PhotonMap map = PhotonMap::build(make_buffer({photon}));
    for (const int64_t target : targets()) {
      const OnlyTarget only(target);
      for (const KernelType type : kKernelTypes) {
        GatherCounters counters;
        const Rgb flux = gather_flux(map, {Point3(0), up, 0, radius, kAllPhotons}, {type, 1}, counters);
        ASSERT_GE(flux.x, 0) << hwy::TargetName(target) << ", " << kKernels[size_t(type)].name;
        ASSERT_GE(kernel_value(type, kernel_terms({type, 1}, radius), distance * distance), 0)
            << kKernels[size_t(type)].name;
      }
    }
  }
}

}  // namespace
}  // namespace kaustik::photon
