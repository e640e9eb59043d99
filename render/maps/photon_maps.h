#pragma once
// The photon maps of one pass, and how they are gathered.

#include <memory>

#include "photon/estimate/radiance_estimate.h"
#include "photon/estimate/shadow_classifier.h"
#include "photon/map/photon_map.h"
#include "render/maps/learn_split.h"
#include "render/maps/path_ends.h"

namespace kaustik::render {

// A map and the settings with which it is gathered.
struct GatherMap {
  photon::PhotonMap map;
  photon::EstimateSettings estimate;
  // Keep alive what the estimate points to.
  std::shared_ptr<const photon::SurfaceAreas> areas;
  std::shared_ptr<const photon::PhotonDiscs> discs;
  std::shared_ptr<const photon::ClearRadius> clear;
};

// Maps of kinds that the plan does not need are empty.
struct PhotonMaps {
  GatherMap direct, caustic, indirect;
  GatherMap medium_caustic, medium_indirect;  // gathered along rays: only the radius of the estimate is used
  photon::PhotonMap shadow;  // for `lecture`, and for `signed`, which gathers from it with direct.estimate
  photon::LectureSettings lecture;
  const PathEnds* ends = nullptr;       // null: paths go on
  const LearnedSplit* split = nullptr;  // null: photons carry all light of their classes

  photon::PhotonMap& of(photon::PhotonKind kind) {
    photon::PhotonMap* const maps[] = {
        &direct.map, &shadow, &caustic.map, &indirect.map, &medium_caustic.map, &medium_indirect.map};
    return *maps[size_t(kind)];
  }
  const photon::PhotonMap& of(photon::PhotonKind kind) const {
    return const_cast<PhotonMaps&>(*this).of(kind);
  }
};

}  // namespace kaustik::render
