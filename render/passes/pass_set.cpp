// Set operations on ranges of passes, and their text form.

#include "render/passes/pass_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace kaustik::render {

namespace {

std::optional<PassSet::Range> parse_range(std::string_view text) {
  uint64_t edge[2] = {0, 0};
  const size_t colon = text.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const std::string_view parts[2] = {text.substr(0, colon), text.substr(colon + 1)};
  for (int i = 0; i < 2; ++i) {
    const char* stop = parts[i].data() + parts[i].size();
    const auto [end, error] = std::from_chars(parts[i].data(), stop, edge[i]);
    if (error != std::errc() || end != stop) return std::nullopt;
  }
  if (edge[0] >= edge[1] || edge[1] > kMostPasses) return std::nullopt;
  return PassSet::Range{edge[0], edge[1]};
}

}  // namespace

PassSet::PassSet(uint64_t begin, uint64_t end) {
  if (begin < end) ranges_.push_back({begin, end});
}

std::optional<PassSet> PassSet::parse(std::string_view text) {
  PassSet all;
  for (size_t comma = 0; comma != std::string_view::npos;) {
    comma = text.find(',');
    const auto range = parse_range(text.substr(0, comma));
    if (!range) return std::nullopt;
    all.ranges_.push_back(*range);
    text.remove_prefix(std::min(comma, text.size() - 1) + 1);
  }
  // Sorted and compared once: a text of a megabyte, which a file may hold, has a hundred thousand ranges.
  std::sort(all.ranges_.begin(), all.ranges_.end(),
            [](const Range& a, const Range& b) { return a.begin < b.begin; });
  for (size_t i = 1; i < all.ranges_.size(); ++i)
    if (all.ranges_[i].begin < all.ranges_[i - 1].end) return std::nullopt;
  all.add({});  // joins those that touch
  return all;
}

std::string PassSet::text() const {
  std::string out;
  for (const Range& r : ranges_) out += fmt::format("{}{}:{}", out.empty() ? "" : ",", r.begin, r.end);
  return out.empty() ? "none" : out;
}

void PassSet::add(const PassSet& other) {
  std::vector<Range> all = ranges_;
  all.insert(all.end(), other.ranges_.begin(), other.ranges_.end());
  std::sort(all.begin(), all.end(), [](const Range& a, const Range& b) { return a.begin < b.begin; });
  ranges_.clear();
  for (const Range& r : all) {
    if (!ranges_.empty() && r.begin <= ranges_.back().end)
      ranges_.back().end = std::max(ranges_.back().end, r.end);
    else
      ranges_.push_back(r);
  }
}

PassSet PassSet::common(const PassSet& other) const {
  PassSet out;
  for (const Range& a : ranges_)
    for (const Range& b : other.ranges_) out.add(PassSet(std::max(a.begin, b.begin), std::min(a.end, b.end)));
  return out;
}

PassSet PassSet::without(const PassSet& other) const {
  PassSet gaps;  // the complement of other
  uint64_t begin = 0;
  for (const Range& r : other.ranges_) {
    gaps.add(PassSet(begin, r.begin));
    begin = r.end;
  }
  gaps.add(PassSet(begin, ~uint64_t{0}));
  return common(gaps);
}

uint64_t PassSet::count() const {
  uint64_t n = 0;
  for (const Range& r : ranges_) n += r.end - r.begin;
  return n;
}

}  // namespace kaustik::render
