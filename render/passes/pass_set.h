#pragma once
// Which passes of a render: a set of indices, as half-open ranges.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kaustik::render {

// Indices are below it.
inline constexpr uint64_t kMostPasses = (uint64_t{1} << 31) - 1;

class PassSet {
 public:
  struct Range {
    uint64_t begin = 0, end = 0;
    bool operator==(const Range&) const = default;
  };

  PassSet() = default;
  // begin ... end - 1; empty when there are none.
  PassSet(uint64_t begin, uint64_t end);

  // "0:16,32:48": ranges that hold something, in any order, without overlap. Nothing when text is no such
  // list or goes beyond kMostPasses.
  static std::optional<PassSet> parse(std::string_view text);
  std::string text() const;  // the same, in order; "none" when empty

  void add(const PassSet& other);  // union
  PassSet common(const PassSet& other) const;
  PassSet without(const PassSet& other) const;

  bool empty() const { return ranges_.empty(); }
  uint64_t count() const;
  uint64_t first() const { return ranges_.empty() ? 0 : ranges_.front().begin; }
  uint64_t end() const { return ranges_.empty() ? 0 : ranges_.back().end; }  // one beyond the last
  const std::vector<Range>& ranges() const { return ranges_; }
  bool operator==(const PassSet&) const = default;

 private:
  std::vector<Range> ranges_;  // in order, apart from each other
};

}  // namespace kaustik::render
