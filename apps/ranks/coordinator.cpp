#include "apps/ranks/coordinator.h"

#include <fmt/format.h>

#include <algorithm>

namespace kaustik::app {

namespace {

// Longer delays between two polls, such as for a checkpoint, do not count as silence of the others.
constexpr auto kLatePoll = std::chrono::seconds(1);
// Exchanges of messages in a poll, while any arrive.
constexpr int kMostRounds = 64;

}  // namespace

Coordinator::Coordinator(int ranks, double timeout) : timeout_(timeout), peers_(size_t(ranks)) {
  for (Peer& peer : peers_) peer.heard = RankClock::now();
  peers_[0].told_end = peers_[0].left = true;  // itself
}

void Coordinator::start(const render::PassSet& missing, render::PassSums done, RankRules rules) {
  const std::lock_guard lock(mutex_);
  board_ = PassBoard(missing, rules.in_order);
  total_ = std::move(done);
  rules_ = std::move(rules);
  started_ = true;
  for (const std::string& text : std::exchange(warnings_, {})) warn(text);
}

void Coordinator::begin(std::string command_line, std::string manifest) {
  const std::lock_guard lock(mutex_);
  const std::string body = BeginText{rules_.in_order, std::move(command_line), std::move(manifest)}.body();
  for (size_t rank = 1; rank < peers_.size(); ++rank) orders_.push_back({int(rank), RankCall::kBegin, body});
}

// Whether a pass of this rank would end in time. Without any in time, the time is over.
bool Coordinator::has_time(const Peer& peer) {
  if (!rules_.has_time_for || !any_out_) return true;  // one pass is rendered, however short the time is
  double shortest = 0, longest = 0;                    // of the passes that ranks have finished
  for (const Peer& other : peers_) {
    if (other.seconds > 0) shortest = shortest > 0 ? std::min(shortest, other.seconds) : other.seconds;
    longest = std::max(longest, other.seconds);
  }
  if (rules_.has_time_for(peer.seconds > 0 ? peer.seconds : longest)) return true;
  if (rules_.has_time_for(shortest)) return false;
  board_.close();
  if (rules_.out_of_time) rules_.out_of_time();
  update();
  return false;
}

std::optional<uint64_t> Coordinator::hand_out(int rank) {
  Peer& peer = peers_[size_t(rank)];
  if (stopped_ || !board_.has_free() || !has_time(peer)) return std::nullopt;
  const std::optional<uint64_t> pass = board_.hand_out(rank);
  if (pass) any_out_ = true, peer.since = RankClock::now(), peer.share = 0;
  return pass;
}

std::optional<uint64_t> Coordinator::next(const std::function<bool()>& go_on) {
  std::unique_lock lock(mutex_);
  here_ = 0;
  while (!over_) {
    if (const auto pass = hand_out(0)) return pass;
    if (over_) break;
    changed_.wait_for(lock, kRankWake);
    lock.unlock();  // go_on() may ask for the progress
    const bool goes_on = go_on();
    lock.lock();
    if (!goes_on) return std::nullopt;
  }
  return std::nullopt;
}

bool Coordinator::deliver(render::PassSums& sums) {
  const std::lock_guard lock(mutex_);
  const uint64_t pass = sums.passes.first();
  rendered(0, pass);
  here_ = 0;
  if (rules_.in_order) {
    held_.push_back(std::exchange(sums, std::exchange(spare_, {})));
    sums.clear();
    fetch();
  } else {
    add(sums);
  }
  return !over_;
}

void Coordinator::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  rules_ = {};
  update();
}

render::PassSums Coordinator::end() {
  stop();
  const std::lock_guard lock(mutex_);
  if (error_) std::rethrow_exception(error_);
  return std::exchange(total_, {});
}

void Coordinator::finish() {
  stop();
  const std::lock_guard lock(mutex_);
  finished_ = true;
}

void Coordinator::rendered(int rank, uint64_t pass) {
  Peer& peer = peers_[size_t(rank)];
  peer.seconds = seconds_since(peer.since);
  peer.share = 1;
  board_.rendered(rank, pass);
}

// Leaves sums of no pass.
void Coordinator::add(render::PassSums& sums) {
  if (over_) return sums.clear();
  const render::PassSet passes = sums.passes;
  // Ranks render side by side: so the seconds of all add up to those that have passed.
  render::RenderStatistics& statistics = sums.statistics;
  for (double* const seconds : {&statistics.photon_trace_s, &statistics.photon_build_s, &statistics.render_s})
    *seconds /= double(peers_.size());
  if (total_.passes.empty())
    total_ = std::exchange(sums, {});
  else
    total_.add(sums);
  sums.clear();
  board_.added(passes);
  added_ += passes.count();
  if (rules_.after_pass && !rules_.after_pass(total_)) stopped_ = true;
  update();
}

// Notices the end of the render.
void Coordinator::update() {
  const bool done = started_ && board_.complete();
  if (stopped_ || done) over_ = true;
  changed_.notify_all();
}

void Coordinator::lose(int rank, const std::string& why) {
  Peer& peer = peers_[size_t(rank)];
  if (peer.lost) return;
  peer.lost = true;
  peer.incoming.reset();
  if (fetching_ == rank) fetching_.reset();
  const render::PassSet passes = over_ ? render::PassSet() : board_.lose(rank);
  if (!over_)
    warn(fmt::format("rank {} takes no part any more: {}{}", rank, why,
                     passes.empty() ? "" : fmt::format("; its passes {} go to others", passes.text())));
  update();
}

void Coordinator::warn(const std::string& text) {
  if (!started_)
    warnings_.push_back(text);
  else if (rules_.warn)
    rules_.warn(text);
}

// Ranks say twice a second that they are alive.
void Coordinator::check_silence() {
  const auto now = RankClock::now();
  const auto delay = now - std::exchange(polled_, now);
  for (size_t rank = 1; rank < peers_.size(); ++rank) {
    Peer& peer = peers_[rank];
    if (delay > kLatePoll) peer.heard += delay;
    if (!peer.lost && !peer.left && seconds_since(peer.heard) > timeout_)
      lose(int(rank), fmt::format("it has been silent for {:g} s", timeout_));
  }
}

void Coordinator::finish_incoming(Peer& peer) {
  if (!peer.incoming->complete()) return;
  render::PassSums sums = peer.incoming->take();
  peer.incoming.reset();
  peer.share = 0;
  fetching_.reset();
  add(sums);
  spare_ = std::move(sums);
}

void Coordinator::handle(const RankMessage& message) {
  Peer& peer = peers_[size_t(message.rank)];
  peer.heard = RankClock::now();
  if (peer.lost && RankCall(message.kind) != RankCall::kBye) return;  // its passes are rendered by others
  switch (RankCall(message.kind)) {
    case RankCall::kAlive:
      peer.share = double(number_of(message.body)) / 1000;
      break;
    case RankCall::kWants:
      peer.wants = true;
      break;
    case RankCall::kRendered:
      rendered(message.rank, number_of(message.body));
      break;
    case RankCall::kSums:
      peer.incoming = std::make_unique<IncomingSums>(message.body, std::exchange(spare_, {}));
      finish_incoming(peer);
      break;
    case RankCall::kPixels:
      if (!peer.incoming) break;
      peer.incoming->add(message.body);
      finish_incoming(peer);
      break;
    case RankCall::kFailed:
      lose(message.rank, message.body);
      peer.lost = false, peer.left = !peer.told_end;  // it waits for the end, as others do
      break;
    case RankCall::kBye:
      peer.left = true;
      break;
    default:
      break;
  }
}

// Asks for the sums that are needed next; those that are here are added at once.
void Coordinator::fetch() {
  while (!over_ && !fetching_) {
    const std::optional<PassBoard::Fetch> wanted = board_.next_fetch();
    if (!wanted) return;
    if (wanted->rank != 0) {
      fetching_ = wanted->rank;
      orders_.push_back({wanted->rank, RankCall::kSend, wanted->passes.text()});
      return;
    }
    const auto found = std::find_if(held_.begin(), held_.end(), [&](const render::PassSums& sums) {
      return sums.passes == wanted->passes;
    });
    render::PassSums sums = std::move(*found);
    held_.erase(found);
    add(sums);
    spare_ = std::move(sums);
  }
}

// Gives passes to the ranks that wait for one, and tells all when there are no more.
void Coordinator::serve() {
  bool told = seconds_since(told_) < kAliveEvery;
  if (!told) told_ = RankClock::now();
  double at_work = here_;
  for (size_t rank = 1; rank < peers_.size(); ++rank) {
    Peer& peer = peers_[rank];
    if (!peer.lost) at_work += peer.share;
    if (over_ && !peer.told_end) {  // a lost rank may live
      peer.told_end = true;
      peer.left = false;
      orders_.push_back({int(rank), RankCall::kEnd});
    }
    if (!told) orders_.push_back({int(rank), RankCall::kAlive});
    if (!peer.wants || over_ || peer.left || peer.lost) continue;
    if (const auto pass = hand_out(int(rank))) {
      peer.wants = false;
      orders_.push_back({int(rank), RankCall::kRender, number_body(*pass)});
    }
  }
  at_work_ = at_work;
}

void Coordinator::send_orders(RankLink& link) {
  for (RankOrder& order : std::exchange(orders_, {}))
    link.send(order.rank, int(order.call), std::move(order.body));
}

bool Coordinator::exchange(RankLink& link) {
  const std::lock_guard lock(mutex_);
  bool heard = false;
  try {
    for (RankMessage message; link.receive(&message); heard = true) handle(message);
    check_silence();
    fetch();
    serve();
    send_orders(link);
  } catch (...) {
    if (!error_) error_ = std::current_exception();
    stopped_ = true;
    fetching_.reset();
    update();
  }
  return heard;
}

bool Coordinator::poll(RankLink& link) {
  for (int round = 0; round < kMostRounds && exchange(link); ++round) continue;
  const std::lock_guard lock(mutex_);
  const auto gone = [&](const Peer& peer) {
    return peer.told_end && (peer.left || seconds_since(peer.heard) > timeout_);
  };
  if (!finished_ || !std::all_of(peers_.begin(), peers_.end(), gone)) return true;
  const std::string how = all_left() ? "orderly" : "";
  for (size_t rank = 1; rank < peers_.size(); ++rank) orders_.push_back({int(rank), RankCall::kClose, how});
  send_orders(link);
  return false;
}

bool Coordinator::all_left() const {
  return std::all_of(peers_.begin(), peers_.end(), [](const Peer& peer) { return peer.left; });
}

bool Coordinator::orderly() const {
  const std::lock_guard lock(mutex_);
  return all_left();
}

}  // namespace kaustik::app
