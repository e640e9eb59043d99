#pragma once
// History of a photon on its way, packed into one word.

#include <cstdint>

#include "core/medium/medium.h"
#include "photon/record/photon.h"

namespace kaustik::photon {

// The events that a photon has met, the number of rays it has followed, the medium that it is in, and whether
// it has only one wavelength.
class WalkState {
 public:
  WalkState() = default;
  // State of the straight ray behind a direct photon's first surface.
  static WalkState straight() { return WalkState(kStraight); }
  // The same state in another medium.
  WalkState in(MediumIndex medium) const { return WalkState((bits_ & ~(255 * kMedium)) | kMedium * medium); }

  bool is_straight() const { return bits_ & kStraight; }
  uint32_t rays() const { return bits_ / kOneRay; }  // completed, not counting the current one
  MediumIndex medium() const { return static_cast<MediumIndex>(bits_ / kMedium); }
  PhotonKind kind() const {  // of the photon left at a non-specular surface
    using enum PhotonKind;
    constexpr PhotonKind kKinds[] = {kDirect, kCaustic, kIndirect, kIndirect,
                                     kShadow, kShadow,  kShadow,   kShadow};
    return kKinds[bits_ % kDispersed];
  }
  WalkState behind_specular() const { return WalkState((bits_ | kSpecular) + kOneRay); }
  WalkState behind_diffuse() const { return WalkState((bits_ | kDiffuse) + kOneRay); }
  // The state of one of the parts into which a photon was divided, each with a wavelength of its own.
  static constexpr uint32_t kParts = 4;
  WalkState of_part(uint32_t part) const {
    return WalkState((bits_ & ~((kParts - 1) * kPart)) | kDivided | part * kPart);
  }
  uint32_t part() const { return bits_ / kPart % kParts; }
  bool is_divided() const { return bits_ & kDivided; }
  // Whether the photon carries what its light sends through specular surfaces (SourceSplit::of_light).
  WalkState carrier(bool carries) const { return WalkState(carries ? bits_ | kCarrier : bits_ & ~kCarrier); }
  bool is_carrier() const { return bits_ & kCarrier; }
  // The state of what dispersive glass refracts.
  WalkState dispersed() const { return WalkState(bits_ | kDispersed); }
  bool is_dispersed() const { return bits_ & kDispersed; }
  WalkState behind_any() const { return WalkState(bits_ + kOneRay); }

  // Access to arrays of states as arrays of words.
  static uint32_t* words(WalkState* states) { return &states->bits_; }
  static const uint32_t* words(const WalkState* states) { return &states->bits_; }

 private:
  explicit WalkState(uint32_t bits) : bits_(bits) {}
  static constexpr uint32_t kSpecular = 1, kDiffuse = 2, kStraight = 4, kDispersed = 8, kDivided = 16,
                            kCarrier = 32, kPart = 64, kMedium = kPart * kParts, kOneRay = 256 * kMedium;
  uint32_t bits_ = 0;
};

}  // namespace kaustik::photon
