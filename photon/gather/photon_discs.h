#pragma once
// A disc of its own for each photon of a map: narrow at edges and where photons are dense, wide where light
// is faint and even.
//
// A kernel whose radius follows the density around the query point gains energy at edges of light: on the
// dark side the disc is wide and reaches over the edge, on the bright side it is narrow and loses nothing. If
// the radius belongs to the photon, the kernel around the photon integrates to one over the plane, whatever
// the radius is: each photon adds exactly its flux (the sample-point estimator: Breiman, Meisel and Purcell
// 1977; Abramson 1982; Silverman 1986, section 5.3).

#include <cstdint>

#include "core/memory/shared_array.h"
#include "photon/map/photon_map.h"

namespace kaustik::photon {

// How many photons lie in the discs.
struct DiscRule {
  uint32_t fewest = 8;  // other photons in a disc at an edge; > 0
  uint32_t most = 8;    // discs of about this many photons grow no further
  float largest = 0;    // radius in metres that no disc exceeds
};

// Immutable after construction; const members may be called from any thread. 4.3 bytes per photon.
class PhotonDiscs {
 public:
  // A disc begins with `fewest` photons and grows while those in it lie as evenly as chance has it. A photon
  // that is brighter than its neighbours gets a wider disc, so that it does not show as a coin. The result
  // does not depend on the number of threads, and radii scale exactly with the map for powers of two. `map`
  // may be gone afterwards.
  PhotonDiscs(const PhotonMap& map, const DiscRule& rule);

  float largest() const { return largest_; }  // metres

  // (largest / r)^2 of each photon's radius r, at least 1: a photon covers a point at the distance d if
  // d^2 stretch <= largest^2. Infinite for at least kColumnPadding elements beyond the last photon.
  const float* stretch() const { return stretch_.data(); }

  // The smallest stretch in each box of a node. One for each of BoxTree::nodes(); infinite for empty boxes.
  struct alignas(64) Least {
    float of_box[BoxNode::kBoxes];
  };
  const Least* least() const { return least_.data(); }

  uint64_t memory_bytes() const { return stretch_.bytes() + least_.bytes(); }

 private:
  float largest_;
  SharedArray<float> stretch_;
  SharedArray<Least> least_;
};

}  // namespace kaustik::photon
