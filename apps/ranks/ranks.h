#pragma once
// The ranks of a render that an MPI launcher has started, as one of them sees them.

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <thread>

#include "apps/ranks/coordinator.h"
#include "apps/ranks/worker.h"

namespace kaustik::app {

// How long rank 0 waits for a silent rank, in seconds. The others wait for rank 0, which may write a file,
// longer.
inline constexpr double kRankTimeout = 30, kPatience = 10;

class Ranks {
 public:
  using OpenLink = std::function<std::unique_ptr<RankLink>()>;

  // Joins the other ranks. Throws std::runtime_error if that fails.
  explicit Ranks(double timeout, const OpenLink& open = open_rank_link);
  // Ends the render for all ranks, and waits until they have left.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }
  int count() const { return count_; }
  bool leads() const { return rank_ == 0; }
  Coordinator& coordinator() { return *coordinator_; }  // of rank 0
  Worker& worker() { return *worker_; }                 // of the others

 private:
  void run(const OpenLink& open, double timeout, std::promise<void>& joined);

  int rank_ = 0, count_ = 1;
  std::optional<Coordinator> coordinator_;
  std::optional<Worker> worker_;
  std::thread thread_;  // has the link
};

}  // namespace kaustik::app
