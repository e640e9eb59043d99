#pragma once
// What a photon has met on its way.

#include <cstdint>

#include "photon/record/photon.h"

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

  // As words, in arrays.
  static uint32_t* words(WalkState* states) { return &states->bits_; }
  static const uint32_t* words(const WalkState* states) { return &states->bits_; }

 private:
  explicit WalkState(uint32_t bits) : bits_(bits) {}
  static constexpr uint32_t kSpecular = 1, kDiffuse = 2, kStraight = 4, kOneRay = 8;
  uint32_t bits_ = 0;
};

}  // namespace kaustik::photon
