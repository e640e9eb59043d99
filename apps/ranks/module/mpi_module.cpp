// The link between ranks by means of MPI, in a library that programs load when an MPI launcher has started
// them. Point-to-point messages only.

#include <mpi.h>

#include <cstdlib>
#include <list>
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
           "MPI than Open MPI";
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

  bool receive(RankMessage* message) override {
    forget_sent();
    int found = 0, size = 0;
    MPI_Status status;
    if (MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &found, &status) != MPI_SUCCESS || !found)
      return false;
    MPI_Get_count(&status, MPI_CHAR, &size);
    *message = {status.MPI_SOURCE, status.MPI_TAG, std::string(size_t(size), '\0')};
    return MPI_Recv(message->body.data(), size, MPI_CHAR, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
                    MPI_STATUS_IGNORE) == MPI_SUCCESS;
  }

  void close(bool orderly) override {
    if (!orderly) return;
    for (Pending& pending : pending_) MPI_Wait(&pending.request, MPI_STATUS_IGNORE);
    MPI_Finalize();
  }

 private:
  struct Pending {
    int to = 0;
    std::string body{};
    MPI_Request request = MPI_REQUEST_NULL;
  };

  // Frees the messages that have left.
  void forget_sent() {
    for (auto at = pending_.begin(); at != pending_.end();) {
      int done = 0;
      const bool failed = MPI_Test(&at->request, &done, MPI_STATUS_IGNORE) != MPI_SUCCESS;
      at = done || failed ? pending_.erase(at) : std::next(at);
    }
  }

  int rank_ = 0, ranks_ = 1;
  std::list<Pending> pending_;  // a list: MPI reads the bodies where they lie
};

}  // namespace

extern "C" __attribute__((visibility("default"))) RankLink* kaustik_open_rank_link(std::string& error) {
  auto link = std::make_unique<MpiLink>();
  error = link->start();
  return error.empty() ? link.release() : nullptr;
}

}  // namespace kaustik::app
