#pragma once
// Photons on their way, waiting for the next step.

#include <cstdint>

#include "photon/photon.h"
#include "photon/vertex_lanes.h"

namespace kaustik::photon {

// What a photon has met, and how many rays it has followed.
class WalkState {
 public:
  WalkState() = default;
  // A direct photon's straight ray behind its first surface.
  static WalkState straight() { return WalkState(kStraight); }

  bool is_straight() const { return bits_ & kStraight; }
  uint32_t rays() const { return bits_ / kOneRay; }  // before the one it follows now
  PhotonKind kind() const {                          // of what it leaves at a non-specular surface
    using enum PhotonKind;
    constexpr PhotonKind kKinds[] = {kDirect, kCaustic, kIndirect, kIndirect,
                                     kShadow, kShadow,  kShadow,   kShadow};
    return kKinds[bits_ % kOneRay];
  }
  WalkState behind_specular() const { return WalkState((bits_ | kSpecular) + kOneRay); }
  WalkState behind_diffuse() const { return WalkState((bits_ | kDiffuse) + kOneRay); }
  WalkState behind_any() const { return WalkState(bits_ + kOneRay); }

 private:
  explicit WalkState(uint32_t bits) : bits_(bits) {}
  static constexpr uint32_t kSpecular = 1, kDiffuse = 2, kStraight = 4, kOneRay = 8;
  uint32_t bits_ = 0;
};

// Photons whose rays point into one octant, by columns.
class WalkerQueue {
 public:
  static constexpr size_t kGroup = VertexLanes::kLanes;
  // The tracer emits a group only when no queue of the eight holds one, and a photon that has been emitted
  // adds at most one more, its straight ray.
  static constexpr size_t kCapacity = 2 * (8 * kGroup + kGroup);

  size_t size() const { return size_; }

  // Writes behind the last, and keeps it if `keep`: nobody could predict a branch on that.
  void push(const glm::vec3& o, const glm::vec3& d, const Rgb& flux, uint32_t reversed_index, WalkState state,
            bool keep = true) {
    for (int c = 0; c < 3; ++c) {
      o_[c][size_] = o[c];
      d_[c][size_] = d[c];
      flux_[c][size_] = flux[c];
    }
    reversed_index_[size_] = reversed_index;
    state_[size_] = state;
    size_ += keep;
  }

  // Takes the last `count` out.
  void take(size_t count, VertexLanes& lanes, uint32_t* reversed_index, WalkState* state) {
    size_ -= count;
    for (int c = 0; c < 3; ++c) {
      std::copy_n(o_[c] + size_, count, lanes.ray.o[c]);
      std::copy_n(d_[c] + size_, count, lanes.ray.d[c]);
      std::copy_n(flux_[c] + size_, count, lanes.flux[c]);
    }
    std::copy_n(reversed_index_ + size_, count, reversed_index);
    std::copy_n(state_ + size_, count, state);
  }

  static size_t octant(const glm::vec3& d) {
    return static_cast<size_t>(std::signbit(d.x)) | static_cast<size_t>(std::signbit(d.y)) << 1 |
           static_cast<size_t>(std::signbit(d.z)) << 2;
  }

 private:
  size_t size_ = 0;
  float o_[3][kCapacity], d_[3][kCapacity], flux_[3][kCapacity];
  uint32_t reversed_index_[kCapacity];
  WalkState state_[kCapacity];
};

}  // namespace kaustik::photon
