// The link between ranks by means of MPI, in a library that programs load when an MPI launcher has started
// them. Point-to-point messages only.

#include <mpi.h>

#include <chrono>
#include <list>
#include <set>
#include <string>
#include <utility>

#include "apps/ranks/rank_link.h"

namespace kaustik::app {

namespace {

class MpiLink final : public RankLink {
 public:
  // Returns why MPI cannot be used, or an empty string.
  std::string start() {
    int provided = 0;
    if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS)
      return "MPI could not be initialised";
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
    if (ranks_ > 1) return {};
    MPI_Finalize();
    return "the MPI launcher has started several processes, but none sees the others: it belongs to another "
           "MPI than this build";
  }

  int rank() const override { return rank_; }
  int ranks() const override { return ranks_; }

  void send(int to, int kind, std::string body) override {
    Pending& pending = pending_.emplace_back(Pending{to, std::move(body), MPI_REQUEST_NULL});
    const std::string& sent = pending.body;
    if (MPI_Isend(sent.data(), int(sent.size()), MPI_CHAR, to, kind, MPI_COMM_WORLD, &pending.request) !=
        MPI_SUCCESS)
      pending_.pop_back();  // the receiver is gone, which its silence will tell
  }

  size_t unsent(int to) override {
    forget_sent();
    size_t count = 0;
    for (const Pending& pending : pending_) count += pending.to == to;
    return count;
  }

  // No receive waits: its sender may die between the head of a message and its body.
  bool receive(RankMessage* message) override {
    forget_sent();
    start_receiving();
    std::set<int> late;  // ranks whose earlier message is still under way
    for (auto at = arriving_.begin(); at != arriving_.end(); ++at) {
      int done = 0;
      const bool failed = MPI_Test(&at->request, &done, MPI_STATUS_IGNORE) != MPI_SUCCESS;
      if (failed || !done || late.count(at->rank) > 0) {
        late.insert(at->rank);
        continue;
      }
      *message = {at->rank, at->kind, std::move(at->body)};
      arriving_.erase(at);
      return true;
    }
    return false;
  }

  void close(bool orderly) override {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    while (!pending_.empty() && (orderly || std::chrono::steady_clock::now() < end)) forget_sent();
    if (orderly) MPI_Finalize();
  }

 private:
  struct Pending {
    int to = 0;
    std::string body{};
    MPI_Request request = MPI_REQUEST_NULL;
  };

  struct Arriving {
    int rank = 0, kind = 0;
    std::string body{};
    MPI_Request request = MPI_REQUEST_NULL;
  };

  void start_receiving() {
    for (;;) {
      int found = 0, size = 0;
      MPI_Message handle = MPI_MESSAGE_NULL;
      MPI_Status status;
      const int code = MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &found, &handle, &status);
      if (code != MPI_SUCCESS || !found) return;
      MPI_Get_count(&status, MPI_CHAR, &size);
      Arriving& one = arriving_.emplace_back(
          Arriving{status.MPI_SOURCE, status.MPI_TAG, std::string(size_t(size), '\0'), MPI_REQUEST_NULL});
      MPI_Imrecv(one.body.data(), size, MPI_CHAR, &handle, &one.request);
    }
  }

  // Frees the messages that have left.
  void forget_sent() {
    for (auto at = pending_.begin(); at != pending_.end();) {
      int done = 0;
      const bool failed = MPI_Test(&at->request, &done, MPI_STATUS_IGNORE) != MPI_SUCCESS;
      at = done || failed ? pending_.erase(at) : std::next(at);
    }
  }

  int rank_ = 0, ranks_ = 1;
  // Lists: MPI reads and writes the bodies where they lie.
  std::list<Pending> pending_;
  std::list<Arriving> arriving_;  // in their order of arrival
};

}  // namespace

extern "C" __attribute__((visibility("default"))) RankLink* kaustik_open_rank_link(std::string& error) {
  auto link = std::make_unique<MpiLink>();
  error = link->start();
  return error.empty() ? link.release() : nullptr;
}

}  // namespace kaustik::app
