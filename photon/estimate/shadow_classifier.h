#pragma once
// The lecture's test (TNCG15): may direct light at x come from the photon map, or must shadow rays be traced?

#include <cstdint>

#include "photon/map/photon_map.h"

namespace kaustik::photon {

struct LectureSettings {
  float radius = 0;            // r0, metres
  uint32_t node_photons = 64;  // N0: a cell splits while it holds more
  uint32_t min_photons = 8;    // M0: a cell answers when it holds more
};

// Reasons for falling back are those of the largest cell without a shadow photon: a still larger cell, which
// would mend it, holds one (or there is none).
enum class LectureOutcome : uint8_t {
  kPhotons,  // the leaf answers
  kClimbed,  // a parent of the leaf answers
  kFew,      // M <= M0
  kFace,     // nearer than r0 to a face
  kShadow    // the leaf itself holds a shadow photon
};

struct LectureAnswer {
  LectureOutcome outcome = LectureOutcome::kFew;
  PhotonRange range;  // direct photons of the cell that answered, else of the leaf
  int depth = 0;      // of that cell
  int climbed = 0;    // levels above the leaf
  uint64_t photons() const { return range.size(); }  // M
  bool use_photons() const { return outcome <= LectureOutcome::kClimbed; }
};

// direct and shadow must be built in the same cube (std::invalid_argument otherwise), so that one cell is a
// range of keys in both. Thread-safe; reads only.
LectureAnswer lecture_lookup(const PhotonMap& direct, const PhotonMap& shadow, const Point3& p,
                             const LectureSettings& settings);

}  // namespace kaustik::photon
