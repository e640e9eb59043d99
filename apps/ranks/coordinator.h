#pragma once
// Rank 0 of a render: hands out passes to all ranks, itself included, and adds their sums, which are exact:
// the result does not depend on who renders what.

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "apps/ranks/pass_board.h"
#include "apps/ranks/rank_calls.h"
#include "apps/ranks/rank_link.h"
#include "apps/ranks/sums_transfer.h"

namespace kaustik::app {

// What a render on several ranks obeys. Called one at a time, by any thread.
struct RankRules {
  // After passes have been added, with the sums of all. False ends the render.
  std::function<bool(render::PassSums&)> after_pass{};
  // Whether a further pass that takes so many seconds ends in time.
  std::function<bool(double seconds)> has_time_for{};
  // Called once no rank has time for a further pass.
  std::function<void()> out_of_time{};
  std::function<void(const std::string&)> warn{};
  // Passes are added one by one by their index, so that after_pass decides as in a single process.
  bool in_order = false;
};

// Thread-safe: one thread renders, another one exchanges messages.
class Coordinator {
 public:
  // timeout: a rank that is silent for so many seconds is lost, and others render its passes.
  Coordinator(int ranks, double timeout);

  // The thread that renders. First start(), then begin(), which lets the other ranks start.
  void start(const render::PassSet& missing, render::PassSums done, RankRules rules);
  void begin(std::string command_line, std::string manifest);
  // The next pass to render here; waits for one that a lost rank gives back. Nothing if all is done, or once
  // go_on returns false, which is called from time to time.
  std::optional<uint64_t> next(const std::function<bool()>& go_on);
  // Takes the sums of a pass; false if no more is to be rendered.
  bool deliver(render::PassSums& sums);
  // Ends the render; no rule is called any more.
  void stop();
  // Ends the render and returns the sums of all passes. Rethrows what a rule threw on the other thread.
  render::PassSums end();
  // Lets the other ranks leave, once this one has nothing more to do.
  void finish();

  bool over() const { return over_; }
  // Passes that were added, and the shares that are done of the passes at work, summed.
  uint64_t added() const { return added_; }
  double at_work() const { return at_work_; }
  void here(double share) { here_ = share; }  // of the pass that is rendered here

  // The thread of the link: handles what has arrived and sends what waits. False once all ranks have left or
  // are lost after the end; then orderly() tells how to close the link.
  bool poll(RankLink& link);
  bool orderly() const;

 private:
  struct Peer {
    RankClock::time_point heard{}, since{};  // the last message; the start of its pass
    double share = 0, seconds = 0;           // of its pass; of the pass before
    bool wants = false, lost = false, left = false, told_end = false;
    std::unique_ptr<IncomingSums> incoming{};
  };

  bool exchange(RankLink& link);  // whether anything has arrived
  bool all_left() const;
  bool has_time(const Peer& peer);
  std::optional<uint64_t> hand_out(int rank);
  void add(render::PassSums& sums);
  void rendered(int rank, uint64_t pass);
  void handle(const RankMessage& message);
  void finish_incoming(Peer& peer);
  void lose(int rank, const std::string& why);
  void warn(const std::string& text);
  void check_silence();
  void serve();
  void fetch();
  void send_orders(RankLink& link);
  void update();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  const double timeout_;
  std::vector<Peer> peers_;  // by rank
  std::vector<RankOrder> orders_;
  PassBoard board_;
  RankRules rules_;
  render::PassSums total_;
  std::vector<render::PassSums> held_;  // rendered here, in order, but not yet added
  render::PassSums
      spare_;  // memory that has been added: to allocate it anew would take longer than to add to it
  std::optional<int> fetching_;  // the rank whose sums are under way
  std::exception_ptr error_;
  std::vector<std::string> warnings_;  // until there are rules
  RankClock::time_point polled_ = RankClock::now(), told_ = RankClock::now();
  bool started_ = false, any_out_ = false, stopped_ = false, finished_ = false;
  std::atomic<bool> over_ = false;
  std::atomic<uint64_t> added_ = 0;
  std::atomic<double> at_work_ = 0, here_ = 0;
};

}  // namespace kaustik::app
