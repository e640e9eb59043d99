#pragma once
// A rank other than 0: renders the passes that rank 0 hands out, and keeps their sums until rank 0 asks for
// them.

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "apps/ranks/rank_calls.h"
#include "apps/ranks/rank_link.h"
#include "apps/ranks/sums_transfer.h"

namespace kaustik::app {

// Thread-safe: one thread renders, another one has the link. go_on: called from time to time by what waits;
// false ends the waiting.
class Worker {
 public:
  // timeout: the render is over once rank 0 has been silent for so many seconds.
  explicit Worker(double timeout) : timeout_(timeout) {}

  // The thread that renders. What rank 0 says of the render; nothing if the render ends before it begins.
  std::optional<BeginText> begin(const std::function<bool()>& go_on);
  // The next pass to render; nothing at the end.
  std::optional<uint64_t> next(const std::function<bool()>& go_on);
  // Takes the sums of a pass; false if no more is to be rendered.
  bool deliver(render::PassSums& sums);
  void share(double share) { share_ = share; }  // of the pass that is rendered
  void fail(const std::string& why);
  // All that this rank had to say has been said.
  void finish();

  bool over() const { return over_; }
  bool deserted() const { return deserted_; }  // rank 0 has fallen silent

  // The thread of the link. False once this rank may leave; then orderly() tells how to close the link.
  bool poll(RankLink& link);
  bool orderly() const { return orderly_; }

 private:
  void exchange(RankLink& link);
  void give_up(const std::string& why);
  void handle(const RankMessage& message);
  void start_sending(const std::string& passes);
  void send_pixels(RankLink& link);
  void order(RankCall call, std::string body = {}) { orders_.push_back({0, call, std::move(body)}); }
  template <class Done>
  void wait(std::unique_lock<std::mutex>& lock, const std::function<bool()>& go_on, const Done& done);

  std::mutex mutex_;
  std::condition_variable changed_;
  const double timeout_;
  std::vector<RankOrder> orders_;
  std::optional<BeginText> begin_;
  std::optional<uint64_t> pass_;        // to be rendered
  std::vector<render::PassSums> held_;  // one for each pass if they are fetched in order, else at most one
  std::optional<OutgoingSums> outgoing_;
  render::PassSums spare_;  // memory that was sent: to allocate it anew would take longer than to add to it
  RankClock::time_point heard_ = RankClock::now(), told_ = RankClock::now();
  bool in_order_ = false, ended_ = false, finished_ = false, said_bye_ = false, closed_ = false;
  std::atomic<bool> over_ = false, deserted_ = false, orderly_ = false;
  std::atomic<double> share_ = 0;
};

}  // namespace kaustik::app
