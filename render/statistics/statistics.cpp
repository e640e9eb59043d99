// Sums of statistics.

#include "render/statistics/statistics.h"

#include <fmt/format.h>

#include <algorithm>

namespace kaustik::render {

RayCounters& RayCounters::operator+=(const RayCounters& o) {
  camera += o.camera;
  specular += o.specular;
  shadow += o.shadow;
  bounce += o.bounce;
  return *this;
}

LectureCounters& LectureCounters::operator+=(const LectureCounters& o) {
  from_photons += o.from_photons;
  climbed += o.climbed;
  fallback_few += o.fallback_few;
  fallback_shadow += o.fallback_shadow;
  fallback_face += o.fallback_face;
  return *this;
}

GuidedCounters& GuidedCounters::operator+=(const GuidedCounters& o) {
  emitted += o.emitted;
  for (size_t k = 0; k < stored.size(); ++k) stored[k] += o.stored[k];
  rays += o.rays;
  dropped_invalid += o.dropped_invalid;
  return *this;
}

std::string DroppedSample::text() const {
  return fmt::format("pixel {} {} sample {}", x, y, sample);
}

void add_examples(const std::vector<DroppedSample>& more, std::vector<DroppedSample>* examples) {
  examples->insert(examples->end(), more.begin(), more.end());
  std::sort(examples->begin(), examples->end());
  if (examples->size() > kDropExamples) examples->resize(kDropExamples);
}

RenderStatistics& RenderStatistics::operator+=(const RenderStatistics& o) {
  photons += o.photons;
  guided += o.guided;
  guide_photons = std::max(guide_photons, o.guide_photons);
  guide_hits = std::max(guide_hits, o.guide_hits);
  guide_boxes = std::max(guide_boxes, o.guide_boxes);
  rays += o.rays;
  lecture += o.lecture;
  gather_queries += o.gather_queries;
  gather_candidates += o.gather_candidates;
  gather_accepted += o.gather_accepted;
  dropped_samples += o.dropped_samples;
  add_examples(o.dropped_examples, &dropped_examples);
  clamped_sums += o.clamped_sums;
  photon_trace_s += o.photon_trace_s;
  photon_build_s += o.photon_build_s;
  render_s += o.render_s;
  radius = std::max(radius, o.radius);
  direct_radius = std::max(direct_radius, o.direct_radius);
  caustic_radius = std::max(caustic_radius, o.caustic_radius);
  indirect_radius = std::max(indirect_radius, o.indirect_radius);
  medium_caustic_radius = std::max(medium_caustic_radius, o.medium_caustic_radius);
  medium_indirect_radius = std::max(medium_indirect_radius, o.medium_indirect_radius);
  photon_bytes = std::max(photon_bytes, o.photon_bytes);
  octree_nodes += o.octree_nodes;
  passes += o.passes;
  adaptive_work = std::max(adaptive_work, o.adaptive_work);
  return *this;
}

}  // namespace kaustik::render
