#pragma once
// Settings and counters of the tracer.

#include <array>
#include <cstdint>
#include <optional>

#include "core/light/interface/light_types.h"
#include "photon/record/photon.h"
#include "photon/trace/energy/energy_ledger.h"

namespace kaustik::photon {

class EmissionGuide;
class SourceSplit;

struct KindMask {
  bool direct = false, shadow = false, caustic = false, indirect = false;
  bool medium_caustic = false, medium_indirect = false;
  bool& operator[](PhotonKind k) {
    bool* const kinds[] = {&direct, &shadow, &caustic, &indirect, &medium_caustic, &medium_indirect};
    return *kinds[static_cast<int>(k)];
  }
  bool operator[](PhotonKind k) const { return const_cast<KindMask&>(*this)[k]; }
  bool any() const { return direct || shadow || caustic || indirect || medium_caustic || medium_indirect; }
};

struct TraceSettings {
  uint64_t seed = 0;
  uint64_t pass = 0;
  uint64_t photons = 0;  // emitted in this pass, by all lights together
  // Longest path L x1 ... xj whose photon at xj is kept: j <= max_bounces. The deposit counts as a scattering
  // (it sends light to the eye): 1 is direct light alone, 2 adds one reflection before the deposit.
  int max_bounces = 16;
  EmissionMode emission = EmissionMode::kCosine;
  bool shadow_behind_specular = false;
  // Index of the only light that emits, with all photons; unset: each emits in proportion to its power.
  std::optional<uint32_t> light{};
  // Draws the starts of all lights; must not be empty. Null: starts are uniform.
  const EmissionGuide* guide = nullptr;
  // Leave caustic photons under the glossy lobes of surfaces that only reflect, too.
  bool under_glossy = false;
  // Number of photons that a caustic leaves on each of its segments in a medium, all together with the light
  // that the medium scatters there. At least 1.
  uint32_t photons_on_segments = 1;
  // The shares of photons in the light of its sources; null: they carry all. Photons that do not carry the
  // light of their source end where they would scatter it.
  const SourceSplit* split = nullptr;
  // What is divided: caustics, and what photons carry on from the surfaces where they are first scattered.
  bool split_caustics = false, split_indirect = false;
  // Photons carry what they would leave to paths instead, and all that reaches a diffuse surface by way of
  // others, specular ones included, is left as indirect photons. Needs `split`.
  bool of_paths = false;
  // Only the requested kinds are traced: without `indirect`, for instance, a photon ends at its first diffuse
  // surface.
  KindMask kinds;
};

// Exact counters; merging them adds integers.
struct TraceCounters {
  uint64_t emitted = 0;
  uint64_t rays = 0;         // path segments traced
  uint64_t shadow_rays = 0;  // segments of straight rays behind the first surface
  std::array<uint64_t, kPhotonKinds> stored{};
  uint64_t dropped_invalid = 0;  // photons of NaN, infinite or negative flux
  EnergyLedger energy;
  TraceCounters& operator+=(const TraceCounters& o);
};

// Key of the pass's random sequence, independent of that of the camera paths.
uint64_t photon_stream(const TraceSettings& settings);

}  // namespace kaustik::photon
