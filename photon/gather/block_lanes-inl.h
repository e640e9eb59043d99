// Building blocks of the searches, compiled once per instruction set by foreach_target.h: which blocks of
// photons a sphere meets, and which of a block's photons count. Nothing is fused, so the decisions are the
// same on every instruction set.

#if defined(KAUSTIK_BLOCK_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef KAUSTIK_BLOCK_LANES
#undef KAUSTIK_BLOCK_LANES
#else
#define KAUSTIK_BLOCK_LANES
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "photon/gather/photon_discs.h"
#include "photon/map/box_tree.h"

HWY_BEFORE_NAMESPACE();
namespace kaustik::photon::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, BoxTree::kBlockPhotons>;
using Words = hn::RebindToUnsigned<Floats>;
using Vf = hn::Vec<Floats>;
using Vu = hn::Vec<Words>;
using Mask = hn::Mask<Floats>;

// The query's sphere, broadcast to all lanes. Passed by value to keep it in registers.
struct Sphere {
  Vf x, y, z, radius_squared;
};
HWY_INLINE Sphere MakeSphere(const Point3& p, float radius_squared) {
  const Floats d;
  return {hn::Set(d, p.x), hn::Set(d, p.y), hn::Set(d, p.z), hn::Set(d, radius_squared)};
}

HWY_INLINE Vf LengthSquared(Vf x, Vf y, Vf z) {
  return hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
}

// Squared distances of the photons from i on.
HWY_INLINE Vf DistanceSquared(Sphere q, const PhotonColumns& c, uint64_t i) {
  const Floats d;
  return LengthSquared(hn::Sub(hn::LoadU(d, c.x + i), q.x), hn::Sub(hn::LoadU(d, c.y + i), q.y),
                       hn::Sub(hn::LoadU(d, c.z + i), q.z));
}

// Returns first, first + 1, ... Calling hn::Iota with a value that is not a compile-time constant goes
// through memory and stalls.
HWY_INLINE Vu Numbers(uint32_t first) {
  return hn::Add(hn::Iota(Words(), 0), hn::Set(Words(), first));
}

// Squared distances to the boxes from b on. Never larger than the computed distance to any point in the box,
// since rounding is monotone.
HWY_INLINE Vf DistanceSquared(Sphere q, const BoxNode& node, uint32_t b) {
  const Floats d;
  const auto gap = [&](Vf p, int axis) HWY_ATTR {
    return hn::Sub(p, hn::Min(hn::Max(p, hn::Load(d, node.lo[axis] + b)), hn::Load(d, node.hi[axis] + b)));
  };
  return LengthSquared(gap(q.x, 0), gap(q.y, 1), gap(q.z, 2));
}

// The distances of photons and boxes as they are compared with the query's radius: unchanged.
struct OneRadius {
  HWY_INLINE Vf OfPhotons(Vf distance_squared, uint64_t) const { return distance_squared; }
  HWY_INLINE Vf OfBoxes(Vf distance_squared, size_t, uint32_t) const { return distance_squared; }
};

// The same where photons have their own discs. A box is stretched no more than any photon in it.
struct OwnRadii {
  const float* stretch;
  const PhotonDiscs::Least* least;

  explicit OwnRadii(const PhotonDiscs& discs) : stretch(discs.stretch()), least(discs.least()) {}
  // i: number of the first photon.
  HWY_INLINE Vf OfPhotons(Vf distance_squared, uint64_t i) const {
    return hn::Mul(distance_squared, hn::LoadU(Floats(), stretch + i));
  }
  // node: number among all nodes of the tree; b: number of the first box.
  HWY_INLINE Vf OfBoxes(Vf distance_squared, size_t node, uint32_t b) const {
    return hn::Mul(distance_squared, hn::Load(Floats(), least[node].of_box + b));
  }
};

// Mask of the boxes of node `number` that the sphere meets. Empty boxes have infinite distance, so even an
// infinite sphere does not meet them.
template <class Reach>
HWY_INLINE Mask Meets(Sphere q, const BoxNode& node, Reach reach, size_t number, uint32_t b) {
  const Vf most = hn::Min(q.radius_squared, hn::Set(Floats(), std::numeric_limits<float>::max()));
  return hn::Le(reach.OfBoxes(DistanceSquared(q, node, b), number, b), most);
}

// Positions of the set bits of each byte, in ascending order.
struct BitPlaces {
  uint8_t place[256][8];
};
inline constexpr BitPlaces kBitPlaces = [] {
  BitPlaces places{};
  for (uint32_t bits = 0; bits < 256; ++bits) {
    for (uint32_t i = 0, n = 0; i < 8; ++i)
      if (bits >> i & 1) places.place[bits][n++] = uint8_t(i);
  }
  return places;
}();

// Stores the lanes of the mask consecutively and returns their number; as many elements as there are lanes
// are overwritten. Instruction sets without a compress instruction use kBitPlaces, because Highway's own
// table is copied to the stack at every call (version 1.0.3, GCC 12).
template <class D>
HWY_INLINE size_t StoreLanes(D d, hn::Vec<D> v, Mask mask, hn::TFromD<D>* to) {
  if constexpr (hn::MaxLanes(D()) > 8) {
    hn::StoreU(hn::Compress(v, hn::RebindMask(d, mask)), d, to);
  } else {
    uint8_t bits[8];
    hn::StoreMaskBits(Floats(), mask, bits);
    const hn::Rebind<uint8_t, Words> bytes;
    const Vu places = hn::PromoteTo(Words(), hn::LoadU(bytes, kBitPlaces.place[bits[0]]));
    hn::StoreU(hn::TableLookupLanes(v, hn::IndicesFromVec(d, places)), d, to);
  }
  return hn::CountTrue(Floats(), mask);
}

// A query, prepared for SIMD lanes.
struct LaneQuery {
  Sphere sphere;
  uint32_t surface;  // packed normal and surface group
  float nx, ny, nz;
  uint32_t begin, end;  // range of photons that may count
  bool all;             // the range contains all photons

  HWY_INLINE LaneQuery(const GatherQuery& q, uint64_t size)
      : sphere(MakeSphere(q.p, q.radius_squared())),
        surface(pack_surface(q.n, q.surface_group)),
        nx(q.n.x),
        ny(q.n.y),
        nz(q.n.z),
        begin(uint32_t(std::min(q.within.begin, size))),
        end(uint32_t(std::min(q.within.end, size))),
        all(begin == 0 && end == size) {}
};

// For each lane: normal_counts(), and whether the surface group is the same.
HWY_INLINE Mask SurfaceCounts(Vu surface, const LaneQuery& q) {
  const Floats d;
  const Words u;
  const hn::RebindToSigned<Floats> s;
  const auto coordinate = [&](Vu bits) HWY_ATTR {
    return hn::ConvertTo(d, hn::Sub(hn::BitCast(s, hn::And(bits, hn::Set(u, 255u))), hn::Set(s, 127)));
  };
  Vf a = coordinate(surface), b = coordinate(hn::ShiftRight<8>(surface));
  const Vf c = hn::Sub(hn::Sub(hn::Set(d, 127.0f), hn::Abs(a)), hn::Abs(b));
  const Vf fold = hn::Max(hn::Neg(c), hn::Zero(d));
  a = hn::Sub(a, hn::CopySign(fold, a));
  b = hn::Sub(b, hn::CopySign(fold, b));
  const Vf dot = hn::Add(hn::Add(hn::Mul(a, hn::Set(d, q.nx)), hn::Mul(b, hn::Set(d, q.ny))),
                         hn::Mul(c, hn::Set(d, q.nz)));
  const Vf bound = hn::Mul(hn::Set(d, kNormalCosine * kNormalCosine), LengthSquared(a, b, c));
  const Mask near = hn::And(hn::Gt(dot, hn::Zero(d)), hn::Gt(hn::Mul(dot, dot), bound));
  const auto same_group = hn::Eq(hn::ShiftRight<16>(surface), hn::Set(u, q.surface >> 16));
  return hn::And(near, hn::RebindMask(d, same_group));
}

// Mask of the lanes of `inside` whose photon, i + lane, lies on the query's surface. A photon with exactly
// the query's packed surface needs no decoding.
HWY_INLINE Mask OnSurface(const LaneQuery& q, const PhotonColumns& c, uint64_t i, Mask inside) {
  const Floats d;
  const Words u;
  const Vu surface = hn::LoadU(u, c.surface + i);
  const Mask same = hn::RebindMask(d, hn::Eq(surface, hn::Set(u, q.surface)));
  if (HWY_LIKELY(hn::AllFalse(d, hn::AndNot(same, inside)))) return inside;
  return hn::And(inside, hn::Or(same, SurfaceCounts(surface, q)));
}

// Mask of the lanes whose number is in [begin, end).
HWY_INLINE Mask LanesWithin(Vu number, uint32_t begin, uint32_t end) {
  const Words u;
  const auto within = hn::AndNot(hn::Lt(number, hn::Set(u, begin)), hn::Lt(number, hn::Set(u, end)));
  return hn::RebindMask(Floats(), within);
}

// Mask of the photons from i on that count.
HWY_INLINE Mask Counts(const LaneQuery& q, const PhotonColumns& c, uint64_t i, Vf distance_squared) {
  Mask inside = hn::Le(distance_squared, q.sphere.radius_squared);
  if (!q.all) inside = hn::And(inside, LanesWithin(Numbers(uint32_t(i)), q.begin, q.end));
  return OnSurface(q, c, i, inside);
}

// Blocks that a sphere meets, named by their first photons. All photons of the blocks in `same` have the
// query's own packed surface and lie in its range, so only the distance decides. The blocks in `other` may
// contain photons that count.
struct FoundBlocks {
  static constexpr size_t kNodes = 16;  // most nodes that are searched for one list
  static constexpr size_t kRoom = (kNodes + 1) * BoxNode::kBoxes;
  uint32_t same[kRoom], other[kRoom];
  size_t same_size, other_size;
};

// Finds the blocks in nodes of the lowest level, at most FoundBlocks::kNodes of them.
template <class Reach>
HWY_INLINE void FindBlocks(const BoxTree& tree, const LaneQuery& q, Reach reach, const uint32_t* nodes,
                           size_t size, FoundBlocks& found) {
  const Floats d;
  const Words u;
  const BoxNode* const boxes = tree.level(0).data();
  const BoxTree::Surfaces* const surfaces = tree.surfaces().data();
  const Sphere sphere = q.sphere;
  const Vu packed = hn::Set(u, q.surface), group = hn::Set(u, q.surface >> 16);
  size_t same_size = 0, other_size = 0;
  for (const uint32_t* node = nodes; node < nodes + size; ++node) {
    for (uint32_t b = 0; b < BoxNode::kBoxes; b += uint32_t(hn::Lanes(d))) {
      const uint32_t block = *node * BoxNode::kBoxes + b;
      const Vu first = hn::ShiftLeft<4>(Numbers(block));
      static_assert(BoxTree::kBlockPhotons == 1 << 4);
      const Vu surface = hn::Load(u, surfaces[*node].of_block + b);
      Mask meets = Meets(sphere, boxes[*node], reach, *node, b);
      Mask is_same = hn::RebindMask(d, hn::Eq(surface, packed));
      if (HWY_UNLIKELY(!q.all)) {
        const Vu last = hn::Add(first, hn::Set(u, BoxTree::kBlockPhotons - 1));
        is_same =
            hn::And(is_same, hn::And(LanesWithin(first, q.begin, q.end), LanesWithin(last, q.begin, q.end)));
        meets = hn::And(meets, hn::And(LanesWithin(last, q.begin, ~0u), LanesWithin(first, 0, q.end)));
      }
      same_size += StoreLanes(u, first, hn::And(meets, is_same), found.same + same_size);
      const auto any = hn::Eq(surface, hn::Set(u, BoxTree::kAnySurface));
      const auto may = hn::RebindMask(d, hn::Or(hn::Eq(hn::ShiftRight<16>(surface), group), any));
      const Mask is_other = hn::AndNot(is_same, hn::And(meets, may));
      if (HWY_UNLIKELY(!hn::AllFalse(d, is_other)))
        other_size += StoreLanes(u, first, is_other, found.other + other_size);
    }
  }
  found.same_size = same_size;
  found.other_size = other_size;
}

// Calls visit(FoundBlocks) for the blocks below nodes of a level. The nodes must be in ascending order; the
// blocks then ascend from one call to the next.
template <class Reach, class Fn>
void VisitBlocks(const BoxTree& tree, const LaneQuery& q, Reach reach, int level, const uint32_t* nodes,
                 size_t size, const Fn& visit) {
  const Floats d;
  const Words u;
  const BoxNode* const boxes = tree.level(level).data();
  const size_t first = size_t(boxes - tree.nodes().data());
  for (; size > 0;
       nodes += std::min(size, FoundBlocks::kNodes), size -= std::min(size, FoundBlocks::kNodes)) {
    const size_t some = std::min(size, FoundBlocks::kNodes);
    if (level == 0) {
      FoundBlocks found;
      FindBlocks(tree, q, reach, nodes, some, found);
      visit(found);
      continue;
    }
    uint32_t below[FoundBlocks::kRoom];
    size_t found = 0;
    for (size_t i = 0; i < some; ++i) {
      for (uint32_t b = 0; b < BoxNode::kBoxes; b += uint32_t(hn::Lanes(d))) {
        const Mask meets = Meets(q.sphere, boxes[nodes[i]], reach, first + nodes[i], b);
        found += StoreLanes(u, Numbers(nodes[i] * BoxNode::kBoxes + b), meets, below + found);
      }
    }
    VisitBlocks(tree, q, reach, level - 1, below, found, visit);
  }
}

template <class Reach, class Fn>
HWY_INLINE void VisitBlocks(const BoxTree& tree, const BoxTree::Start& start, const LaneQuery& q, Reach reach,
                            const Fn& visit) {
  VisitBlocks(tree, q, reach, start.level, start.nodes, start.size, visit);
}

}  // namespace kaustik::photon::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
