#include "apps/ranks/worker.h"

#include <algorithm>

#include "render/passes/pass_set.h"

namespace kaustik::app {

namespace {

// Pieces of pixels that are under way at once.
constexpr size_t kMostUnsent = 2;

}  // namespace

template <class Done>
void Worker::wait(std::unique_lock<std::mutex>& lock, const std::function<bool()>& go_on, const Done& done) {
  while (!over_ && !done()) {
    changed_.wait_for(lock, kRankWake);
    if (!go_on()) return;
  }
}

std::optional<BeginText> Worker::begin(const std::function<bool()>& go_on) {
  std::unique_lock lock(mutex_);
  wait(lock, go_on, [&] { return begin_.has_value(); });
  return over_ ? std::nullopt : begin_;
}

std::optional<uint64_t> Worker::next(const std::function<bool()>& go_on) {
  std::unique_lock lock(mutex_);
  share_ = 0;
  if (over_) return std::nullopt;
  order(RankCall::kWants);
  wait(lock, go_on, [&] { return pass_.has_value(); });
  return over_ ? std::nullopt : std::exchange(pass_, std::nullopt);
}

bool Worker::deliver(render::PassSums& sums) {
  const std::lock_guard lock(mutex_);
  const uint64_t pass = sums.passes.first();
  if (in_order_ || held_.empty()) {
    held_.push_back(std::exchange(sums, std::exchange(spare_, {})));
  } else {
    held_.back().add(sums);
  }
  sums.clear();
  order(RankCall::kRendered, number_body(pass));
  return !over_;
}

void Worker::fail(const std::string& why) {
  const std::lock_guard lock(mutex_);
  give_up(why);
}

void Worker::give_up(const std::string& why) {
  held_.clear();
  outgoing_.reset();
  order(RankCall::kFailed, why);
}

void Worker::finish() {
  const std::lock_guard lock(mutex_);
  finished_ = true;
}

// The sums of several passes leave together, unless they are added in order.
void Worker::start_sending(const std::string& passes) {
  const auto wanted = render::PassSet::parse(passes);
  const auto found = std::find_if(held_.begin(), held_.end(), [&](const render::PassSums& sums) {
    return wanted && !sums.passes.common(*wanted).empty();
  });
  if (found == held_.end()) return;
  outgoing_.emplace(std::move(*found));
  held_.erase(found);
  order(RankCall::kSums, outgoing_->head());
}

void Worker::handle(const RankMessage& message) {
  heard_ = RankClock::now();
  switch (RankCall(message.kind)) {
    case RankCall::kBegin:
      begin_ = BeginText::from(message.body);
      in_order_ = begin_->in_order;
      break;
    case RankCall::kRender:
      pass_ = number_of(message.body);
      break;
    case RankCall::kSend:
      start_sending(message.body);
      break;
    case RankCall::kEnd:
      over_ = ended_ = true;
      outgoing_.reset();
      break;
    case RankCall::kClose:
      orderly_ = message.body == "orderly";
      closed_ = true;
      break;
    default:
      break;
  }
}

void Worker::send_pixels(RankLink& link) {
  while (outgoing_ && link.unsent(0) < kMostUnsent) {
    if (!outgoing_->has_more()) {
      spare_ = outgoing_->take();
      outgoing_.reset();
      return;
    }
    link.send(0, int(RankCall::kPixels), outgoing_->next_piece());
  }
}

bool Worker::poll(RankLink& link) {
  const std::lock_guard lock(mutex_);
  try {
    exchange(link);
  } catch (const std::exception& error) {
    give_up(error.what());
    over_ = true;
  }
  changed_.notify_all();
  return !closed_ && !(deserted_ && finished_);
}

void Worker::exchange(RankLink& link) {
  for (RankMessage message; link.receive(&message);) handle(message);
  if (seconds_since(told_) >= kAliveEvery) {
    told_ = RankClock::now();
    order(RankCall::kAlive, number_body(uint64_t(share_ * 1000)));
  }
  if (ended_ && finished_ && !said_bye_) {
    said_bye_ = true;
    order(RankCall::kBye);
  }
  for (RankOrder& order : std::exchange(orders_, {})) link.send(0, int(order.call), std::move(order.body));
  send_pixels(link);
  if (seconds_since(heard_) > timeout_) {
    over_ = deserted_ = true;
  }
}

}  // namespace kaustik::app
