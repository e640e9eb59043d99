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
  free_ = free_.without(single(pass));
  given_[pass] = {rank, 0};
  return pass;
}

void PassBoard::rendered(int rank, uint64_t pass) {
  const auto found = given_.find(pass);
  if (found != given_.end() && found->second.rank == rank) found->second.rendered = ++finished_;
}

std::optional<PassBoard::Fetch> PassBoard::next_fetch() const {
  if (given_.empty()) return std::nullopt;
  if (in_order_) {
    const auto& [pass, given] = *given_.begin();
    const bool lowest = free_.empty() || pass < free_.first();
    return lowest && given.rendered > 0 ? std::optional(Fetch{given.rank, single(pass)}) : std::nullopt;
  }
  std::optional<Given> longest;
  for (const auto& [pass, given] : given_)
    if (given.rendered > 0 && (!longest || given.rendered < longest->rendered)) longest = given;
  if (!longest) return std::nullopt;
  Fetch fetch{longest->rank, {}};
  for (const auto& [pass, given] : given_)
    if (given.rank == fetch.rank && given.rendered > 0) fetch.passes.add(single(pass));
  return fetch;
}

void PassBoard::added(const render::PassSet& passes) {
  std::erase_if(given_, [&](const auto& item) { return !passes.common(single(item.first)).empty(); });
}

render::PassSet PassBoard::held_by(int rank) const {
  render::PassSet passes;
  for (const auto& [pass, given] : given_)
    if (given.rank == rank) passes.add(single(pass));
  return passes;
}

render::PassSet PassBoard::lose(int rank) {
  const render::PassSet passes = held_by(rank);
  std::erase_if(given_, [&](const auto& item) { return item.second.rank == rank; });
  free_.add(passes);
  return passes;
}

}  // namespace kaustik::app
