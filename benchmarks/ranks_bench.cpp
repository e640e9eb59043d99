// What rank 0 spends on other ranks: the real coordinator, with ranks that render nothing. Tells how many
// passes a second one rank 0 can hand out and add, and so how many nodes it can lead.

#include <benchmark/benchmark.h>

#include <deque>

#include "apps/ranks/coordinator.h"

namespace {

using namespace kaustik;
using namespace kaustik::app;

// All other ranks: they answer at once.
class IdleRanks final : public RankLink {
 public:
  IdleRanks(int ranks, const render::PassSums& sums) : ranks_(ranks), sums_(sums) {
    for (int rank = 1; rank < ranks; ++rank) answer(rank, RankCall::kWants);
  }
  int rank() const override { return 0; }
  int ranks() const override { return ranks_; }
  void send(int to, int kind, std::string body) override {
    if (RankCall(kind) == RankCall::kRender) {
      answer(to, RankCall::kRendered, body);
      answer(to, RankCall::kWants);
    } else if (RankCall(kind) == RankCall::kSend) {
      send_sums(to, body);
    } else if (RankCall(kind) == RankCall::kEnd) {
      answer(to, RankCall::kBye);
    }
  }
  size_t unsent(int) override { return 0; }
  bool receive(RankMessage* message) override {
    if (queue_.empty()) return false;
    *message = std::move(queue_.front());
    queue_.pop_front();
    return true;
  }
  void close(bool) override {}

 private:
  void answer(int rank, RankCall call, std::string body = {}) {
    queue_.push_back({rank, int(call), std::move(body)});
  }
  void send_sums(int rank, const std::string& passes) {
    render::PassSums sums = sums_;
    sums.passes = *render::PassSet::parse(passes);
    OutgoingSums outgoing(std::move(sums));
    answer(rank, RankCall::kSums, outgoing.head());
    while (outgoing.has_more()) answer(rank, RankCall::kPixels, outgoing.next_piece());
  }

  int ranks_;
  const render::PassSums& sums_;
  std::deque<RankMessage> queue_;
};

// Arguments: ranks, width and height of the picture. Counts passes a second, and fetches: several passes of a
// rank may come at once.
void lead_ranks(benchmark::State& state) {
  const int ranks = int(state.range(0)), width = int(state.range(1)), height = int(state.range(2));
  render::PassSums sums;
  sums.totals = render::FilmTotals(render::PixelWindow<render::PixelTotals>(width, height), {});
  const uint64_t passes = uint64_t(ranks - 1) * (width > 1 ? 2 : 16);
  uint64_t fetches = 0;
  for (auto _ : state) {
    IdleRanks others(ranks, sums);
    Coordinator coordinator(ranks, 1e9);
    RankRules rules;
    rules.after_pass = [&](render::PassSums&) { return ++fetches, true; };
    coordinator.start(render::PassSet(0, passes), {}, std::move(rules));
    while (coordinator.poll(others)) continue;
  }
  state.counters["passes/s"] =
      benchmark::Counter(double(passes) * double(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["fetches/s"] = benchmark::Counter(double(fetches), benchmark::Counter::kIsRate);
}
BENCHMARK(lead_ranks)->Args({1000, 1, 1})->Args({4000, 1, 1})->Args({5, 1920, 1080})->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
