#include "apps/ranks/ranks.h"

namespace kaustik::app {

namespace {

constexpr auto kBetweenPolls = std::chrono::milliseconds(2);

template <class Side>
void exchange_messages(Side& side, std::unique_ptr<RankLink>& link) {
  while (side.poll(*link)) std::this_thread::sleep_for(kBetweenPolls);
  link->close(side.orderly());
  if (!side.orderly()) link.release();  // MPI may still use its buffers
}

}  // namespace

Ranks::Ranks(double timeout, const OpenLink& open) {
  const auto joined = std::make_shared<std::promise<void>>();
  std::future<void> done = joined->get_future();
  thread_ = std::thread([this, open, timeout, joined] { run(open, timeout, *joined); });
  try {
    done.get();
  } catch (...) {
    thread_.join();
    throw;
  }
}

void Ranks::run(const OpenLink& open, double timeout, std::promise<void>& joined) {
  std::unique_ptr<RankLink> link;
  try {
    link = open();
    rank_ = link->rank(), count_ = link->ranks();
    if (leads())
      coordinator_.emplace(count_, timeout);
    else
      worker_.emplace(timeout * kPatience);
  } catch (...) {
    joined.set_exception(std::current_exception());
    return;
  }
  joined.set_value();
  leads() ? exchange_messages(*coordinator_, link) : exchange_messages(*worker_, link);
}

Ranks::~Ranks() {
  leads() ? coordinator_->finish() : worker_->finish();
  thread_.join();
}

}  // namespace kaustik::app
