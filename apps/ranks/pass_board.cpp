#include "apps/ranks/pass_board.h"

namespace kaustik::app {

namespace {

render::PassSet single(uint64_t pass) {
  return {pass, pass + 1};
}

}  // namespace

std::optional<uint64_t> PassBoard::hand_out(int rank) {
  if (free_.empty()) return std::nullopt;
  const uint64_t pass = free_.first();
  const auto kept = rendered_.find(rank);
  const bool full = in_order_ && kept != rendered_.end() && kept->second.count() >= kMostKept;
  if (full && pass > given_.begin()->first) return std::nullopt;
  free_ = free_.without(single(pass));
  given_[pass] = rank;
  return pass;
}

void PassBoard::rendered(int rank, uint64_t pass) {
  const auto found = given_.find(pass);
  if (found == given_.end() || found->second != rank) return;
  render::PassSet& passes = rendered_[rank];
  if (passes.empty()) waiting_.push_back(rank);
  passes.add(single(pass));
}

std::optional<PassBoard::Fetch> PassBoard::next_fetch() const {
  if (waiting_.empty()) return std::nullopt;
  if (!in_order_) return Fetch{waiting_.front(), rendered_.at(waiting_.front())};
  const auto& [pass, rank] = *given_.begin();
  const auto found = rendered_.find(rank);
  const bool lowest = free_.empty() || pass < free_.first();
  const bool finished = found != rendered_.end() && !found->second.common(single(pass)).empty();
  return lowest && finished ? std::optional(Fetch{rank, single(pass)}) : std::nullopt;
}

void PassBoard::forget(int rank, const render::PassSet& passes) {
  const auto found = rendered_.find(rank);
  if (found == rendered_.end()) return;
  found->second = found->second.without(passes);
  if (!found->second.empty()) return;
  rendered_.erase(found);
  std::erase(waiting_, rank);
}

void PassBoard::added(const render::PassSet& passes) {
  for (const render::PassSet::Range& range : passes.ranges()) {
    for (auto at = given_.lower_bound(range.begin); at != given_.end() && at->first < range.end;) {
      forget(at->second, single(at->first));
      at = given_.erase(at);
    }
  }
}

render::PassSet PassBoard::lose(int rank) {
  render::PassSet passes;
  for (const auto& [pass, holder] : given_)
    if (holder == rank) passes.add(single(pass));
  std::erase_if(given_, [&](const auto& item) { return item.second == rank; });
  forget(rank, passes);
  if (!closed_) free_.add(passes);
  return passes;
}

}  // namespace kaustik::app
