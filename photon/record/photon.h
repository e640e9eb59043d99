#pragma once
// A photon as the tracer produces it. The maps store it as a PhotonRecord.

#include <array>
#include <cstdint>
#include <string_view>

#include "core/math/vec.h"
#include "core/spectrum/wavelength.h"

namespace kaustik::photon {

// Class of the path that brought the photon, in Heckbert's notation, with M for scattering by a medium:
// direct L D, shadow (behind the first surface of a straight path), caustic L S+ D, indirect L (S|D|M)* (D|M)
// (S|D)* D, caustic in a medium L S+ M, indirect in a medium L (S|D|M)* (D|M) S* M. Light that a medium
// scatters straight from a lamp leaves no photon.
enum class PhotonKind : uint8_t { kDirect, kShadow, kCaustic, kIndirect, kMediumCaustic, kMediumIndirect };
inline constexpr int kPhotonKinds = 6;
inline constexpr std::array<std::string_view, kPhotonKinds> kPhotonKindNames = {
    "direct", "shadow", "caustic", "indirect", "medium-caustic", "medium-indirect"};

// Photon with the exact values that were traced.
struct Photon {
  Point3 p{0};
  Vector3 wi{0};  // unit, towards where the photon came from
  // Watts, already divided by the number of photons emitted; in a medium what it scatters. If the photon has
  // a wavelength, then only the part of this light that has it arrives (core/spectrum/wavelength.h).
  Rgb flux{0};
  Normal3 n{0};                      // geometric normal, unit, on the side of wi; wi itself in a medium
  uint32_t surface_group = 0;        // in a medium: its index
  float wavelength = kNoWavelength;  // nm; records do not keep it
};

}  // namespace kaustik::photon
