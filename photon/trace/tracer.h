#pragma once
// Traces photons from light to absorption and records those that arrive on non-specular surfaces.
//
// Path classes (Heckbert 1990; Jensen 2001, chapter 5; Jensen and Christensen 1995 for shadow photons):
//   direct    L D            at the first surface, if it is non-specular
//   shadow    L D ...        where the direct photon's straight ray, continued through the scene, meets each
//                            further non-specular surface, until it leaves the scene
//   caustic   L S+ D         at the first non-specular surface after specular ones
//   indirect  L (S|D)* D (S|D)* D
// S is scattering by the specular lobes of a BSDF (delta and narrow glossy ones), D by its diffuse lobes,
// those under which photons are gathered. A surface is specular when it has no diffuse lobes. A surface with
// both kinds keeps photons, and the path continues by either. A path whose first surface is specular leaves
// no direct photon. It leaves shadow photons only if TraceSettings::shadow_behind_specular is set: then the
// straight ray behind any first surface leaves them, since mirrors and glass block direct light. A straight
// ray passes through specular surfaces.
//
// Media absorb light on its way, and scatter it, which counts like scattering by diffuse lobes: M in the
// classes of photon/record/photon.h. Where no indirect light is wanted, what is scattered is lost. Straight
// rays stay in the medium where their light shines, as direct light without occlusion does.

#include <cstdint>

#include "accel/bvh.h"
#include "photon/emission/emission_guide.h"
#include "photon/record/photon.h"
#include "photon/sources/source_split.h"
#include "photon/trace/lanes/energy_lanes.h"
#include "photon/trace/lanes/vertex_lanes.h"
#include "photon/trace/trace_settings.h"

namespace kaustik::photon {

// Dimensions of a photon's random point: the first 8 are for emission, each vertex takes the next 4.
inline constexpr uint32_t kEmissionDimensions = 8;
inline constexpr uint32_t kVertexDimensions = 4;
// The last of the dimensions for emission chooses the wavelength, for photons that meet dispersive glass.
inline constexpr uint32_t kWavelengthDimension = kEmissionDimensions - 1;
// Those before decide whether the photon carries the light of its source: of its light, and of the surface
// where it is first scattered.
inline constexpr uint32_t kLightShareDimension = kEmissionDimensions - 3;
inline constexpr uint32_t kSurfaceShareDimension = kEmissionDimensions - 2;

// A straight ray leaves at most this many shadow photons, far more than any real scene has surfaces in a row.
inline constexpr uint32_t kMaxStraightSurfaces = 1 << 16;

// Number of photons that take a step together.
inline constexpr uint64_t kGroupSize = kPhotonLanes;

// Traces photons first ... end - 1 of settings.photons and calls sink(PhotonKind, const Photon&) for each
// photon of a kind in settings.kinds. A sink may also take the photon's index as a third argument, or be
// called with whole lanes: see RecordSink. If it has a function meet_source(index, L), that receives the
// radiance of the glossy surface that light from a point, spot or distant light meets first. The order of the
// calls is a pure function of (scene, settings, first, end). The photons that one index leaves are a pure
// function of (scene, settings, index), with two exceptions:
//   - leaving out a kind may shorten the path, which does not change the photons of the other kinds, unless
//     media scatter: without indirect kinds their share is taken from every photon instead of some photons;
//   - where a ray meets two surfaces at exactly the same distance, as at an edge, the other photons of
//     its packet may decide which of the two is reported.
// Photons without flux are skipped; those of invalid flux are skipped and counted. counters are added to.
// Accel: accel::Bvh, or any type with Hit intersect(const Ray&) const. surfaces must have been made from
// scene. Thread-safe.
template <class Accel, class Sink>
void trace_photons(const Scene& scene, const SurfaceTable& surfaces, const Accel& bvh,
                   const TraceSettings& settings, uint64_t first, uint64_t end, Sink&& sink,
                   TraceCounters& counters);

// Overload that makes the SurfaceTable itself.
template <class Accel, class Sink>
void trace_photons(const Scene& scene, const Accel& bvh, const TraceSettings& settings, uint64_t first,
                   uint64_t end, Sink&& sink, TraceCounters& counters) {
  trace_photons(scene, SurfaceTable(scene), bvh, settings, first, end, sink, counters);
}

// Traces the single photon `index`.
template <class Accel, class Sink>
void trace_photon(const Scene& scene, const Accel& bvh, const TraceSettings& settings, uint64_t index,
                  Sink&& sink, TraceCounters& counters) {
  trace_photons(scene, bvh, settings, index, index + 1, sink, counters);
}

}  // namespace kaustik::photon

#include "photon/trace/tracer-inl.h"
