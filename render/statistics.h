#pragma once
// What a render counts and measures. Counts are whole numbers, so that those of its passes add up to the same
// in any order.

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "photon/trace/tracer.h"

namespace kaustik::render {

struct RayCounters {
  uint64_t camera = 0, specular = 0, shadow = 0, bounce = 0;  // paths' segments by what they are traced for
  uint64_t all() const { return camera + specular + shadow + bounce; }
  RayCounters& operator+=(const RayCounters& o);
};

// How the lecture's direct estimator answered (per shading point).
struct LectureCounters {
  uint64_t from_photons = 0, climbed = 0;  // climbed: used a parent of the leaf
  uint64_t fallback_few = 0, fallback_shadow = 0,
           fallback_face = 0;  // M <= M0, shadow photon in the node, too near a face
  LectureCounters& operator+=(const LectureCounters& o);
};

// A sample that was NaN, infinite or negative: what reproduces it, by rows.
struct DroppedSample {
  int y = 0, x = 0;     // of the full image
  uint64_t sample = 0;  // number within the pixel, over all passes
  auto operator<=>(const DroppedSample&) const = default;
  std::string text() const;  // "pixel X Y sample S"
};
inline constexpr size_t kDropExamples = 10;

// Adds to a sorted list of at most kDropExamples, the first of all.
void add_examples(const std::vector<DroppedSample>& more, std::vector<DroppedSample>* examples);

// Of photons emitted for one kind alone, where that is guided. Their flux adds up to the lights' power on the
// mean only, so it is not in the energy ledger.
struct GuidedCounters {
  uint64_t emitted = 0, rays = 0, dropped_invalid = 0;
  std::array<uint64_t, photon::kPhotonKinds> stored{};
  GuidedCounters& operator+=(const GuidedCounters& o);
};

struct RenderStatistics {
  photon::TraceCounters photons;  // all that are not guided
  GuidedCounters guided;
  // Emitted to learn from, once in a process, and what came of them; not among the above.
  uint64_t guide_photons = 0, guide_hits = 0, guide_boxes = 0;
  RayCounters rays;
  LectureCounters lecture;
  uint64_t gather_queries = 0, gather_candidates = 0, gather_accepted = 0;
  uint64_t dropped_samples = 0;  // NaN, infinite or negative; reported with pixel and sample
  std::vector<DroppedSample> dropped_examples;
  uint64_t clamped_sums = 0;  // sums of a pass that were out of the range of the exact totals
  double photon_trace_s = 0, photon_build_s = 0, render_s = 0;
  // r0 used, metres: the largest of the maps' radii in the first pass; 0 when no map was read
  float radius = 0;
  float direct_radius = 0, caustic_radius = 0, indirect_radius = 0;  // 0 where the map was not built
  uint64_t photon_bytes = 0;  // maps of a pass, index included; the largest
  uint64_t octree_nodes = 0;  // of all maps
  uint64_t passes = 0;        // finished

  bool any_photons() const { return photons.emitted + guided.emitted > 0; }
  // Of other passes of the same render.
  RenderStatistics& operator+=(const RenderStatistics& o);
};

}  // namespace kaustik::render
