#pragma once
// Finds the lines in a plane that a ray from the origin may meet, without a test of each.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace kaustik::photon {

inline double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

// The directions about the origin are divided into sectors. Each has the set of the lines that may reach into
// it: all that do, and perhaps a few that do not. kMost: largest number of lines, a multiple of 64.
template <size_t kMost>
class LineFan {
  static_assert(kMost % 64 == 0);

 public:
  static constexpr int kSectors = 64;

  // The sector of a direction of any length. Its borders are even in y / (|x| + |y|), which takes no
  // trigonometry.
  static int sector_of(const glm::dvec2& direction) {
    const double q = direction.x / (std::abs(direction.x) + std::abs(direction.y));
    const double turn = (direction.y >= 0 ? 1 - q : 3 + q) * (kSectors / 4);  // in [0, kSectors]; NaN of zero
    return turn > 0 ? std::min(int(turn), kSectors - 1) : 0;
  }

  // Adds a line from a to b. number: below kMost.
  void add(size_t number, const glm::dvec2& a, const glm::dvec2& b) {
    const double turn = cross(a, b);
    const int from = sector_of(turn > 0 ? a : b), to = sector_of(turn > 0 ? b : a);
    // Rounding may move an end by a sector, and a line through the origin has no side.
    const bool through = glm::dot(a, b) <= 0 && std::abs(turn) <= 1e-6 * glm::length(a) * glm::length(b);
    const int count = through ? kSectors : std::min((to - from + kSectors) % kSectors + 3, kSectors);
    for (int i = 0; i < count; ++i)
      sets_[size_t((from - 1 + i + kSectors) % kSectors)][number / 64] |= uint64_t{1} << (number % 64);
  }

  // Calls visit(number) for the lines that may lie in this direction, until it returns true. Returns whether
  // it did.
  template <class Visit>
  bool any_in(int sector, const Visit& visit) const {
    for (size_t word = 0; word < kWords; ++word)
      for (uint64_t set = sets_[size_t(sector)][word]; set != 0; set &= set - 1)
        if (visit(64 * word + size_t(std::countr_zero(set)))) return true;
    return false;
  }

 private:
  static constexpr size_t kWords = kMost / 64;

  std::array<std::array<uint64_t, kWords>, kSectors> sets_{};
};

}  // namespace kaustik::photon
