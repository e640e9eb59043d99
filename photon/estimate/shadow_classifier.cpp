// The lecture's three conditions, checked from the leaf upwards.

#include "photon/estimate/shadow_classifier.h"

#include <stdexcept>

namespace kaustik::photon {

LectureAnswer lecture_lookup(const PhotonMap& direct, const PhotonMap& shadow, const Point3& p,
                             const LectureSettings& settings) {
  const Octree& octree = direct.octree();
  if (direct.cube() != shadow.cube()) {
    throw std::invalid_argument("direct and shadow photons must be built with the same bounds");
  }
  // The leaf of the direct photons and its ancestors, and the ranges of shadow photons in the same cells.
  PhotonRange lit[kMortonBits + 1], dark[kMortonBits + 1];
  const uint64_t key = morton_key(octree.cube().cell(p));
  const int leaf = octree.descend(direct.positions(), key, lit, [&](int depth, PhotonRange range) {
    return range.size() <= settings.node_photons || !octree.children_hold(settings.radius, depth);
  });
  shadow.octree().descend(shadow.positions(), key, dark,
                          [&](int depth, PhotonRange) { return depth == leaf; });

  LectureAnswer answer{LectureOutcome::kShadow, lit[leaf], leaf, 0};
  for (int depth = leaf; depth >= 0 && dark[depth].empty(); --depth) {
    const bool enough = lit[depth].size() > settings.min_photons;
    if (enough && octree.keeps_from_faces(p, settings.radius, depth)) {
      return {depth == leaf ? LectureOutcome::kPhotons : LectureOutcome::kClimbed, lit[depth], depth,
              leaf - depth};
    }
    answer = {enough ? LectureOutcome::kFace : LectureOutcome::kFew, lit[depth], depth, leaf - depth};
  }
  return answer;
}

}  // namespace kaustik::photon
