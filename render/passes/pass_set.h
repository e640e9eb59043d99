#pragma once
// A set of passes: their indices, as half-open ranges.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kaustik::render {

// Exclusive upper bound of pass indices.
inline constexpr uint64_t kMostPasses = (uint64_t{1} << 31) - 1;

class PassSet {
 public:
  struct Range {
    uint64_t begin = 0, end = 0;
    bool operator==(const Range&) const = default;
  };

  PassSet() = default;
  // The passes begin ... end - 1; empty if begin >= end.
  PassSet(uint64_t begin, uint64_t end);

  // Parses a list such as "0:16,32:48" of ranges that are not empty and do not overlap, in any order. Nothing
  // is returned if the text is no such list or exceeds kMostPasses.
  static std::optional<PassSet> parse(std::string_view text);
  std::string text() const;  // the form that parse() reads, in ascending order; "none" if empty

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
  std::vector<Range> ranges_;  // in ascending order, with gaps between them
};

}  // namespace kaustik::render
