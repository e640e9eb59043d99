#pragma once
// One photon as the tracer hands it over, and the compact record that the maps hold.

#include <array>
#include <cstdint>
#include <string_view>

#include "core/math/vec.h"

namespace kaustik::photon {

// The path that brought it (Heckbert): direct L D, shadow (behind the first surface of a straight path),
// caustic L S+ D, indirect L (S|D)* D (S|D)* D.
enum class PhotonKind : uint8_t { kDirect, kShadow, kCaustic, kIndirect };
inline constexpr int kPhotonKinds = 4;
inline constexpr std::array<std::string_view, kPhotonKinds> kPhotonKindNames = {"direct", "shadow", "caustic",
                                                                                "indirect"};

// As traced: exact values.
struct Photon {
  Point3 p{0};
  Vector3 wi{0};  // unit, towards where the photon came from
  Rgb flux{0};    // watts, already divided by the number of photons emitted
  Normal3 n{0};   // geometric normal, unit, on the side of wi
  uint32_t surface_group = 0;
};

}  // namespace kaustik::photon
