#pragma once
// One photon's life: from light to absorption, leaving records on non-specular surfaces.
//
// Path classes (Heckbert 1990; Jensen 2001, chapter 5; Jensen and Christensen 1995 for shadow photons):
//   direct    L D            at the first surface, if it is non-specular
//   shadow    L D ...        where the direct photon's straight ray, continued through the scene, meets each
//                            further non-specular surface, until it leaves the scene
//   caustic   L S+ D         at the first non-specular surface after specular ones
//   indirect  L (S|D)* D (S|D)* D
// S is scattering by the specular part of a BSDF, delta and glossy lobes, D that by its broad part. A surface
// is specular when it has no broad part. One that has both keeps photons, and goes on by either.
// A path whose first surface is specular leaves no direct photon, and shadow photons only if
// TraceSettings::shadow_behind_specular asks for them: then the straight ray behind any first surface leaves
// them, since mirror and glass block direct light. A straight ray passes through specular surfaces.
//
// Not handled: participating media.

#include <array>
#include <cstdint>
#include <optional>

#include "accel/bvh.h"
#include "photon/emission/emission_guide.h"
#include "photon/record/photon.h"
#include "photon/trace/energy_lanes.h"
#include "photon/trace/vertex_lanes.h"

namespace kaustik::photon {

struct KindMask {
  bool direct = false, shadow = false, caustic = false, indirect = false;
  bool operator[](PhotonKind k) const {
    const bool kinds[] = {direct, shadow, caustic, indirect};
    return kinds[static_cast<int>(k)];
  }
  bool any() const { return direct || shadow || caustic || indirect; }
};

struct TraceSettings {
  uint64_t seed = 0;
  uint64_t pass = 0;
  uint64_t photons = 0;  // emitted in this pass
  // Longest path L x1 ... xj whose photon at xj is kept: j <= max_bounces. The deposit counts as a scattering
  // (it sends light to the eye): 1 is direct light alone, 2 adds one reflection before the deposit.
  int max_bounces = 16;
  EmissionMode emission = EmissionMode::kCosine;
  bool shadow_behind_specular = false;
  std::optional<uint32_t> light{};       // the only one that emits, with all photons; else each by its power
  const EmissionGuide* guide = nullptr;  // not empty: draws the starts, of all lights; else uniform
  KindMask kinds;  // only what is asked for is traced: without `indirect` a photon ends at its first diffuse
                   // surface
};

// Exact counters, merged by integer sums.
struct TraceCounters {
  uint64_t emitted = 0;
  uint64_t rays = 0;         // path segments traced
  uint64_t shadow_rays = 0;  // segments of straight paths behind the first surface
  std::array<uint64_t, kPhotonKinds> stored{};
  uint64_t dropped_invalid = 0;  // NaN, infinite or negative flux
  EnergyLedger energy;
  TraceCounters& operator+=(const TraceCounters& o);
};

// Key of the random sequence of a pass: independent of those of the camera paths.
uint64_t photon_stream(const TraceSettings& settings);

// Dimensions of a photon's random point: emission has the first 8, each vertex the next 4.
inline constexpr uint32_t kEmissionDimensions = 8;
inline constexpr uint32_t kVertexDimensions = 4;

// A straight ray leaves at most so many shadow photons: no scene in use comes near.
inline constexpr uint32_t kMaxStraightSurfaces = 1 << 16;

// Photons that take a step side by side.
inline constexpr uint64_t kGroupSize = VertexLanes::kLanes;

// Traces photons first ... end - 1 of settings.photons and calls sink(PhotonKind, const Photon&) for each
// photon of a kind in settings.kinds. A sink may also take the photon's index as a third argument, or be
// called with whole lanes: see RecordSink. The order of the calls is a pure function of (scene, settings,
// first, end). What a photon leaves is one of (scene, settings, index), save that
//   - a kind that is not asked for may shorten its path: the photons of the other kinds do not change;
//   - of two surfaces met at exactly the same distance, as by a ray through an edge, the photons that are
//     traced beside it may decide which one is named.
// Photons without flux are not handed over; those of invalid flux are counted. counters are added to.
// Accel: accel::Bvh or anything with its Hit intersect(const Ray&) const. Thread-safe.
// surfaces: of scene.
template <class Accel, class Sink>
void trace_photons(const Scene& scene, const SurfaceTable& surfaces, const Accel& bvh,
                   const TraceSettings& settings, uint64_t first, uint64_t end, Sink&& sink,
                   TraceCounters& counters);

// The same with a table made for this call.
template <class Accel, class Sink>
void trace_photons(const Scene& scene, const Accel& bvh, const TraceSettings& settings, uint64_t first,
                   uint64_t end, Sink&& sink, TraceCounters& counters) {
  trace_photons(scene, SurfaceTable(scene), bvh, settings, first, end, sink, counters);
}

// One photon: trace_photons of index alone.
template <class Accel, class Sink>
void trace_photon(const Scene& scene, const Accel& bvh, const TraceSettings& settings, uint64_t index,
                  Sink&& sink, TraceCounters& counters) {
  trace_photons(scene, bvh, settings, index, index + 1, sink, counters);
}

}  // namespace kaustik::photon

#include "photon/trace/tracer-inl.h"
