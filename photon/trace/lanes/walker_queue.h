#pragma once
// Queue of photons that wait for their next step.

#include <cmath>
#include <cstring>

#include "photon/trace/lanes/walker_rows.h"

namespace kaustik::photon {

// Photons whose rays point into one octant. Stored as rows, so that a push touches three cache lines.
class WalkerQueue {
 public:
  static constexpr size_t kGroup = kPhotonLanes;
  // The tracer emits a group only when none of the eight queues holds a whole one, and each emitted photon
  // adds at most so many entries: its parts and its straight ray.
  static constexpr size_t kCapacity = (WalkState::kParts + 1) * (8 * kGroup + kGroup);

  size_t size() const { return size_; }

  // Adds one photon.
  void push(const glm::vec3& o, const glm::vec3& d, const Rgb& flux, uint32_t reversed_index, WalkState state,
            int32_t energy = 0) {
    const float floats[] = {o.x, o.y, o.z, d.x, d.y, d.z, flux.x, flux.y, flux.z};
    uint32_t words[12]{};
    std::memcpy(words, floats, sizeof(floats));
    words[9] = reversed_index;
    std::memcpy(words + 10, &state, sizeof(state));
    std::memcpy(words + 11, &energy, sizeof(energy));
    for (int i = 0; i < 3; ++i) std::memcpy(part_[i][size_], words + 4 * i, sizeof(Part));
    ++size_;
  }

  // Adds row k if `keep`. Always writes behind the last row instead of branching, since the branch would be
  // mispredicted.
  void push(const WalkerRows& rows, size_t k, bool keep) {
    for (int i = 0; i < 3; ++i) std::memcpy(part_[i][size_], rows.part[i][k], sizeof(Part));
    size_ += keep;
  }

  // Removes the last `count` photons.
  void take(size_t count, VertexLanes& lanes, WalkerLanes& walkers) {
    size_ -= count;
    from_rows({part_[0][size_], part_[1][size_], part_[2][size_]}, count, &lanes.ray, lanes.flux, &walkers);
  }

  static size_t octant(const glm::vec3& d) {
    return static_cast<size_t>(std::signbit(d.x)) | static_cast<size_t>(std::signbit(d.y)) << 1 |
           static_cast<size_t>(std::signbit(d.z)) << 2;
  }

 private:
  using Part = uint32_t[4];
  size_t size_ = 0;
  // Has room for the whole vectors that take() reads of a group that is not full.
  alignas(64) Part part_[3][kCapacity + kGroup];
};

}  // namespace kaustik::photon
