// Tests renders on several ranks, whose messages here stay in one process. scripts/check-mpi does the same
// with Open MPI.

#include "apps/ranks/ranks.h"

#include <gmock/gmock.h>

#include <deque>
#include <numeric>
#include <sstream>

#include "apps/machine/thread_limit.h"
#include "apps/session/rank_session.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using render::PassSet;
using render::PassSums;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Queues of messages, one for each rank.
struct Hub {
  explicit Hub(int ranks) : queues(size_t(ranks)), cut_offs(size_t(ranks)) {}
  std::mutex mutex;
  std::vector<std::deque<RankMessage>> queues;
  // By rank: it is cut off after so many messages of this kind; then nothing it sends arrives.
  struct CutOff {
    RankCall after{};
    int messages = -1;  // -1: never
  };
  std::vector<CutOff> cut_offs;

  bool waits_for_cut() {
    const std::lock_guard lock(mutex);
    return std::any_of(cut_offs.begin(), cut_offs.end(), [](const CutOff& cut) { return cut.messages > 0; });
  }
};

class HubLink final : public RankLink {
 public:
  HubLink(std::shared_ptr<Hub> hub, int rank) : hub_(std::move(hub)), rank_(rank) {}
  int rank() const override { return rank_; }
  int ranks() const override { return int(hub_->queues.size()); }
  void send(int to, int kind, std::string body) override {
    const std::lock_guard lock(hub_->mutex);
    Hub::CutOff& cut = hub_->cut_offs[size_t(rank_)];
    if (cut.messages == 0) return;
    hub_->queues[size_t(to)].push_back({rank_, kind, std::move(body)});
    if (cut.messages > 0 && RankCall(kind) == cut.after) --cut.messages;
  }
  size_t unsent(int) override { return 0; }
  bool receive(RankMessage* message) override {
    const std::lock_guard lock(hub_->mutex);
    auto& queue = hub_->queues[size_t(rank_)];
    if (queue.empty()) return false;
    *message = std::move(queue.front());
    queue.pop_front();
    return true;
  }
  void close(bool) override {}

 private:
  std::shared_ptr<Hub> hub_;
  int rank_;
};

class RendersOnRanks : public test::ProgramTest {
 protected:
  static constexpr int kRanks = 3;
  static constexpr double kTimeout = 0.7;  // seconds: ranks say twice a second that they are alive

  Job job_of(const std::string& scene) const {
    SettingOverrides overrides;
    for (const auto& [name, value] : settings_) overrides.add(*find_setting(name), {value});
    std::ostringstream said;
    return load_job(scene, overrides, Console{said, said, false, true});
  }

  // One of the other ranks, which renders `scene`.
  void serve(int rank, const std::string& scene) {
    std::ostringstream said;
    Ranks ranks(timeout_, [&] { return std::make_unique<HubLink>(hub_, rank); });
    const LoadQuietly load = [&](const Console&) { return job_of(scene); };
    SettingOverrides given;
    given.add(*find_setting("threads"), {"1"});
    EXPECT_EQ(serve_passes(ranks, load, given, interrupt_, Console{said, said}), kDone) << said.str();
  }

  // Renders on all ranks; returns the sums. after_pass: see RankRules.
  PassSums render_on_all(const std::function<bool(PassSums&)>& after_pass = {}, const RankRules& rules = {}) {
    const Job job = job_of(scene_);
    std::vector<std::thread> others;
    for (int rank = 1; rank < kRanks; ++rank)
      others.emplace_back([this, rank] { serve(rank, rank == 1 ? scene_of_1_ : scene_); });
    render::RenderResult result;
    {
      Ranks ranks(timeout_, [&] { return std::make_unique<HubLink>(hub_, 0); });
      with_thread_limit(1, [&] {
        const accel::Bvh bvh(job.scene, 1);
        render::RenderTask task;
        task.passes = PassSet(0, job.settings.render.passes);
        task.after_pass = after_pass;
        std::ostringstream said;
        // Rank 0 is slow until the others have done what the test is about.
        const auto slow = [&](const render::Progress&) {
          if (hub_->waits_for_cut()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
          return true;
        };
        result =
            render_on_ranks(ranks.coordinator(), job, bvh, slow, rules, std::move(task), Console{said, said});
        said_ = said.str();
      });
    }
    for (std::thread& other : others) other.join();
    EXPECT_FALSE(result.cancelled);
    return std::move(result.sums);
  }

  // The sums of one process.
  PassSums whole(uint64_t passes) const {
    const Job job = job_of(scene_);
    PassSums sums;
    with_thread_limit(2, [&] {
      const accel::Bvh bvh(job.scene, 2);
      sums = render::render(job.scene, bvh, job.settings.render, {}, {.passes = PassSet(0, passes)}).sums;
    });
    return sums;
  }

  static void expect_same(const PassSums& a, const PassSums& b) {
    EXPECT_EQ(a.passes, b.passes);
    EXPECT_EQ(a.radii, b.radii);
    EXPECT_EQ(a.statistics.photons.emitted, b.statistics.photons.emitted);
    EXPECT_EQ(a.statistics.rays.all(), b.statistics.rays.all());
    const auto x = render::bytes_of(a.totals), y = render::bytes_of(b.totals);
    for (size_t i = 0; i < x.size(); ++i)
      EXPECT_TRUE(std::equal(x[i].begin(), x[i].end(), y[i].begin(), y[i].end()));
  }

  std::string scene_ = small_scene(film(24, 16));
  std::string scene_of_1_ = scene_;
  std::vector<std::pair<std::string, std::string>> settings_ = {
      {"photons", "24k"}, {"spp", "12"}, {"passes", "12"}, {"alpha", "0.8"}, {"denoise", "on"}};
  double timeout_ = 30;
  std::shared_ptr<Hub> hub_ = std::make_shared<Hub>(kRanks);
  std::string said_;
  InterruptGuard interrupt_;
};

TEST_F(RendersOnRanks, GiveTheSumsOfOneProcess) {
  expect_same(render_on_all(), whole(12));
  EXPECT_THAT(said_, IsEmpty());
}

TEST_F(RendersOnRanks, WithATargetErrorDecideAfterTheSamePassesAsOneProcess) {
  settings_.emplace_back("target-error", "50%");  // passes are then added in their order
  std::vector<uint64_t> seen;
  const PassSums sums = render_on_all([&](PassSums& so_far) {
    seen.push_back(so_far.passes.count());
    EXPECT_EQ(so_far.passes, PassSet(0, so_far.passes.count()));
    return so_far.passes.count() < 7;
  });
  std::vector<uint64_t> each(7);
  std::iota(each.begin(), each.end(), 1);
  EXPECT_THAT(seen, ElementsAreArray(each));
  expect_same(sums, whole(7));
}

TEST_F(RendersOnRanks, RenderThePassesOfARankThatFallsSilent) {
  timeout_ = kTimeout;
  hub_->cut_offs[2] = {RankCall::kWants, 2};  // with its second pass
  expect_same(render_on_all(), whole(12));
  EXPECT_THAT(said_, HasSubstr("rank 2 takes no part any more: it has been silent for 0.7 s; its passes "));
}

TEST_F(RendersOnRanks, DropTheSumsThatARankHasSentInPart) {
  timeout_ = kTimeout;
  hub_->cut_offs[2] = {RankCall::kSums, 1};  // the pixels are missing
  expect_same(render_on_all(), whole(12));
  EXPECT_THAT(said_, HasSubstr("rank 2 takes no part any more"));
}

// All ranks keep finished passes then, which wait for those of the lost one.
TEST_F(RendersOnRanks, InOrderRenderThePassesOfARankThatFallsSilent) {
  timeout_ = kTimeout;
  settings_.emplace_back("target-error", "50%");
  hub_->cut_offs[2] = {RankCall::kWants, 1};
  expect_same(render_on_all([](PassSums& so_far) { return so_far.passes.count() < 10; }), whole(10));
  EXPECT_THAT(said_, HasSubstr("rank 2 takes no part any more"));
}

TEST_F(RendersOnRanks, EndWhenARankIsLostAndTheTimeIsOver) {
  timeout_ = kTimeout;
  settings_.emplace_back("target-error", "50%");
  hub_->cut_offs[2] = {RankCall::kWants, 1};
  std::atomic<bool> over = false;
  RankRules rules;
  rules.has_time_for = [&](double) { return hub_->waits_for_cut(); };
  rules.out_of_time = [&] { over = true; };
  const PassSums sums = render_on_all({}, rules);
  EXPECT_TRUE(over);
  EXPECT_GE(sums.passes.count(), 1u);
  EXPECT_LT(sums.passes.count(), 12u);
}

TEST_F(RendersOnRanks, DoWithoutARankThatHasReadAnotherScene) {
  scene_of_1_ = write("other.pbrt", read("small.pbrt") + "\n# changed\n");
  expect_same(render_on_all(), whole(12));
  EXPECT_THAT(said_, HasSubstr("rank 1 takes no part any more: on "));
  EXPECT_THAT(said_, HasSubstr("other.pbrt differ in content from those that rank 0 has read"));
}

TEST_F(RendersOnRanks, StopWhenNoPassWouldEndInTime) {
  const Job job = job_of(scene_);
  Coordinator coordinator(1, timeout_);
  coordinator.start(PassSet(0, render::kMostPasses), {},
                    {.has_time_for = [left = 3](double) mutable { return left-- > 0; }});
  PassSums sums;
  for (uint64_t expected = 0; expected < 4; ++expected) {
    EXPECT_EQ(coordinator.next([] { return true; }), expected);
    sums = whole(1);
    sums.passes = PassSet(expected, expected + 1);
    coordinator.deliver(sums);
  }
  EXPECT_EQ(coordinator.next([] { return true; }), std::nullopt);
  EXPECT_TRUE(coordinator.over());
  EXPECT_EQ(coordinator.end().passes, PassSet(0, 4));  // the first one is rendered however short the time is
}

}  // namespace
}  // namespace kaustik::app
