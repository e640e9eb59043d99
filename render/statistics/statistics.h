#pragma once
// Counts and times of a render. Counts are integers, so those of several passes add up to the same total in
// any order.

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "photon/trace/trace_settings.h"

namespace kaustik::render {

struct RayCounters {
  // Segments of camera paths, by what they are traced for.
  uint64_t camera = 0, specular = 0, shadow = 0, bounce = 0;
  uint64_t all() const { return camera + specular + shadow + bounce; }
  RayCounters& operator+=(const RayCounters& o);
};

// How the lecture's direct estimator answered, counted per shading point.
struct LectureCounters {
  uint64_t from_photons = 0, climbed = 0;  // climbed: an ancestor of the leaf answered
  uint64_t fallback_few = 0, fallback_shadow = 0,
           fallback_face = 0;  // M <= M0, shadow photon in the node, too near a face
  LectureCounters& operator+=(const LectureCounters& o);
};

// Identifies a sample that was NaN, infinite or negative, so that it can be reproduced. Ordered by image row.
struct DroppedSample {
  int y = 0, x = 0;     // position in the full image
  uint64_t sample = 0;  // number within the pixel, counted over all passes
  auto operator<=>(const DroppedSample&) const = default;
  std::string text() const;  // "pixel X Y sample S"
};
inline constexpr size_t kDropExamples = 10;

// Merges `more` into a sorted list, of which only the first kDropExamples are kept.
void add_examples(const std::vector<DroppedSample>& more, std::vector<DroppedSample>* examples);

// Photons of guided shoots, each for one kind. Their flux equals the lights' power only on average, so it is
// not booked in the energy ledger.
struct GuidedCounters {
  uint64_t emitted = 0, rays = 0, dropped_invalid = 0;
  std::array<uint64_t, photon::kPhotonKinds> stored{};
  GuidedCounters& operator+=(const GuidedCounters& o);
};

struct RenderStatistics {
  photon::TraceCounters photons;  // photons that are not guided
  GuidedCounters guided;
  // Learning photons of guided emission, made once in a process and not contained in the counts above; useful
  // starts among them; boxes learned.
  uint64_t guide_photons = 0, guide_hits = 0, guide_boxes = 0;
  RayCounters rays;
  LectureCounters lecture;
  uint64_t gather_queries = 0, gather_candidates = 0, gather_accepted = 0;
  uint64_t dropped_samples = 0;  // NaN, infinite or negative; reported with pixel and sample
  std::vector<DroppedSample> dropped_examples;
  uint64_t clamped_sums = 0;  // sums of a pass that exceeded the range of the exact totals
  double photon_trace_s = 0, photon_build_s = 0, render_s = 0;
  // Gather radius r0 used, in metres: the largest of the maps' radii in the first pass; 0 if there was no
  // map.
  float radius = 0;
  float direct_radius = 0, caustic_radius = 0, indirect_radius = 0;  // 0 if the map was not built
  float medium_caustic_radius = 0, medium_indirect_radius = 0;       // also 0 then
  uint64_t photon_bytes = 0;  // maps of a pass with their index; maximum over passes
  uint64_t octree_nodes = 0;  // in all maps
  uint64_t passes = 0;        // number of finished passes
  double adaptive_work = 0;   // that adaptive samples were allowed (PassSamples); maximum over passes

  bool any_photons() const { return photons.emitted + guided.emitted > 0; }
  // Adds the statistics of further passes of the same render.
  RenderStatistics& operator+=(const RenderStatistics& o);
};

}  // namespace kaustik::render
