#pragma once
// The lecture's test (TNCG15): whether direct light at x may come from the photon map or needs shadow rays.

#include <cstdint>

#include "photon/map/photon_map.h"

namespace kaustik::photon {

struct LectureSettings {
  float radius = 0;            // r0, metres
  uint32_t node_photons = 64;  // N0: a cell with more photons is split
  uint32_t min_photons = 8;    // M0: a cell with more photons may answer
};

// The reason for shadow rays is that of the largest cell without a shadow photon: the next larger cell holds
// one, or there is none. Where the leaf itself holds one, it is the leaf's.
enum class LectureOutcome : uint8_t {
  kPhotons,  // the leaf answers
  kClimbed,  // an ancestor of the leaf answers
  kFew,      // the cell holds no more than M0 photons
  kFace,     // the point is nearer than r0 to a face of the cell
  kShadow    // the leaf itself holds a shadow photon
};

struct LectureAnswer {
  LectureOutcome outcome = LectureOutcome::kFew;
  PhotonRange range;                                 // direct photons of the cell that decided
  int depth = 0;                                     // depth of that cell
  int climbed = 0;                                   // levels between that cell and the leaf
  uint64_t photons() const { return range.size(); }  // M
  bool use_photons() const { return outcome <= LectureOutcome::kClimbed; }
};

// Classifies point p. direct and shadow must have been built in the same cube, so that a cell is a range of
// keys in both; otherwise throws std::invalid_argument. Thread-safe.
LectureAnswer lecture_lookup(const PhotonMap& direct, const PhotonMap& shadow, const Point3& p,
                             const LectureSettings& settings);

}  // namespace kaustik::photon
