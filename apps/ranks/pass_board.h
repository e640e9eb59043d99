#pragma once
// Which rank renders which pass of a render, and whose sums are needed next.

#include <deque>
#include <map>
#include <optional>

#include "render/passes/pass_set.h"

namespace kaustik::app {

inline constexpr uint64_t kMostKept = 2;

class PassBoard {
 public:
  PassBoard() = default;
  // in_order: the sums are needed by ascending pass, so that what is decided after each does not depend on
  // the ranks.
  PassBoard(render::PassSet passes, bool in_order) : free_(std::move(passes)), in_order_(in_order) {}

  // Gives a rank the lowest pass that nobody has; nothing if none is left. In order, a rank that already
  // keeps kMostKept finished passes only gets one that all those wait for.
  std::optional<uint64_t> hand_out(int rank);
  // The rank holds the sums of a pass that it was given.
  void rendered(int rank, uint64_t pass);
  // Sums to ask for: in order, those of the lowest pass that is missing; otherwise all of the rank that has
  // held some for the longest time. Nothing if there are none yet.
  struct Fetch {
    int rank = 0;
    render::PassSet passes;
  };
  std::optional<Fetch> next_fetch() const;
  // The sums of these passes have arrived.
  void added(const render::PassSet& passes);
  // Takes back all passes of a rank that has not sent them, for others, and returns them.
  render::PassSet lose(int rank);

  // Hands out no more: only passes that somebody has are still to come.
  void close() { free_ = {}, closed_ = true; }
  bool has_free() const { return !free_.empty(); }
  bool complete() const { return given_.empty() && free_.empty(); }

 private:
  void forget(int rank, const render::PassSet& passes);  // among those that are finished

  render::PassSet free_;
  std::map<uint64_t, int> given_;            // the rank that has a pass
  std::map<int, render::PassSet> rendered_;  // of them, by rank, those that are finished
  std::deque<int> waiting_;  // the ranks in rendered_, the one that has waited for the longest time first
  bool in_order_ = false, closed_ = false;
};

}  // namespace kaustik::app
