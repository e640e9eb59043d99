// Sums of flux for queries that are neighbours: they look for cells, nodes and blocks together, and what a
// block of photons says is decoded once for several of them. Every sum is that of the query alone, to the
// last bit: blocks that only the others reach add zeros.

#include "photon/gather/gather_packet.h"

#include <algorithm>

#include "photon/map/octree.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "photon/gather/gather_packet.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "photon/gather/flux_sum-inl.h"

HWY_BEFORE_NAMESPACE();
namespace kaustik::photon::HWY_NAMESPACE {

constexpr size_t kQueries = QueryPacket::kMost;

// Queries whose sums stay in registers at once.
constexpr size_t kTogether = hn::MaxLanes(Floats()) >= 16 ? 4 : 2;
constexpr size_t kParts = kQueries / kTogether;

// Nodes of the lowest level that a packet may meet.
constexpr size_t kMostNodes = 64;

// First photons of the blocks that each part of the packet reads, and how many blocks each query reaches.
struct PacketBlocks {
  static constexpr size_t kRoom = (kMostNodes + 1) * BoxNode::kBoxes;
  uint32_t same[kParts][kRoom], other[kParts][kRoom];
  size_t same_size[kParts] = {}, other_size[kParts] = {};
  alignas(64) uint32_t reached[kQueries] = {};

  HWY_INLINE PacketBlocks() {}
};

// Bit i: query i meets box b of the node. The same arithmetic as Meets().
HWY_INLINE uint32_t QueriesThatMeet(const QueryPacket& packet, const BoxNode& node, uint32_t b,
                                    uint32_t* reached) {
  const Floats d;
  const Words u;
  uint32_t bits = 0;
  for (size_t i = 0; i < kQueries; i += hn::Lanes(d)) {
    const auto gap = [&](int axis) HWY_ATTR {
      const Vf p = hn::Load(d, packet.p[axis] + i);
      const Vf lo = hn::Set(d, node.lo[axis][b]), hi = hn::Set(d, node.hi[axis][b]);
      return hn::Sub(p, hn::Min(hn::Max(p, lo), hi));
    };
    const Vf reach =
        hn::Min(hn::Load(d, packet.radius_squared + i), hn::Set(d, std::numeric_limits<float>::max()));
    const Mask meets = hn::Le(LengthSquared(gap(0), gap(1), gap(2)), reach);
    uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, meets, bytes);
    bits |= (bytes[0] | uint32_t(bytes[1]) << 8) << i;
    const Vu one = hn::IfThenElseZero(hn::RebindMask(u, meets), hn::Set(u, 1));
    hn::Store(hn::Add(hn::Load(u, reached + i), one), u, reached + i);
  }
  return bits;
}

// Which boxes of the node are within the packet's radius of the box around its points.
HWY_INLINE Mask MeetsPacket(const QueryPacket& packet, const BoxNode& node, uint32_t b) {
  const Floats d;
  const auto gap = [&](int axis) HWY_ATTR {
    const Vf below = hn::Sub(hn::Set(d, packet.lo[axis]), hn::Load(d, node.hi[axis] + b));
    const Vf above = hn::Sub(hn::Load(d, node.lo[axis] + b), hn::Set(d, packet.hi[axis]));
    return hn::Max(hn::Max(below, above), hn::Zero(d));
  };
  const Vf reach = hn::Set(d, std::min(packet.most_squared, std::numeric_limits<float>::max()));
  return hn::Le(LengthSquared(gap(0), gap(1), gap(2)), reach);
}

struct PacketNodes {
  uint32_t node[kMostNodes + 2 * BoxNode::kBoxes];
  size_t size = 0;

  HWY_INLINE PacketNodes() {}
};

// Those of the lowest level; false when they are too many.
HWY_INLINE bool FindPacketNodes(const BoxTree& tree, const QueryPacket& packet, const BoxTree::Start& start,
                                PacketNodes& nodes) {
  static_assert(BoxTree::Start::kMost <= kMostNodes);
  std::copy_n(start.nodes, start.size, nodes.node);
  nodes.size = start.size;
  for (int level = start.level; level > 0; --level) {
    const PacketNodes above = nodes;
    nodes.size = 0;
    for (size_t i = 0; i < above.size; ++i) {
      for (uint32_t b = 0; b < BoxNode::kBoxes; b += uint32_t(hn::Lanes(Floats()))) {
        const Mask meets = MeetsPacket(packet, tree.level(level)[above.node[i]], b);
        nodes.size +=
            StoreLanes(Words(), Numbers(above.node[i] * BoxNode::kBoxes + b), meets, nodes.node + nodes.size);
      }
      if (nodes.size > kMostNodes) return false;
    }
  }
  return true;
}

HWY_INLINE void AppendBlock(const QueryPacket& packet, const BoxNode& node, uint32_t block, bool same,
                            PacketBlocks& found) {
  const uint32_t bits = QueriesThatMeet(packet, node, block % BoxNode::kBoxes, found.reached);
  auto& lists = same ? found.same : found.other;
  auto& sizes = same ? found.same_size : found.other_size;
  for (size_t part = 0; part < kParts; ++part) {
    lists[part][sizes[part]] = block * BoxTree::kBlockPhotons;
    sizes[part] += (bits >> (part * kTogether) & ((1u << kTogether) - 1)) != 0;
  }
}

HWY_INLINE void FindPacketBlocks(const BoxTree& tree, const QueryPacket& packet, const PacketNodes& nodes,
                                 PacketBlocks& found) {
  const Floats d;
  const Words u;
  for (const uint32_t* n = nodes.node; n < nodes.node + nodes.size; ++n) {
    const BoxNode& node = tree.level(0)[*n];
    const uint32_t* const surfaces = tree.surfaces()[*n].of_block;
    for (uint32_t b = 0; b < BoxNode::kBoxes; b += uint32_t(hn::Lanes(d))) {
      const Vu surface = hn::Load(u, surfaces + b);
      const auto any = hn::Eq(surface, hn::Set(u, BoxTree::kAnySurface));
      const auto group = hn::Eq(hn::ShiftRight<16>(surface), hn::Set(u, packet.surface >> 16));
      const Mask may = hn::And(MeetsPacket(packet, node, b), hn::RebindMask(d, hn::Or(group, any)));
      uint32_t blocks[2 * BoxNode::kBoxes];
      const size_t size = StoreLanes(u, Numbers(*n * BoxNode::kBoxes + b), may, blocks);
      for (size_t i = 0; i < size; ++i) {
        const bool same = surfaces[blocks[i] % BoxNode::kBoxes] == packet.surface;
        AppendBlock(packet, node, blocks[i], same, found);
      }
    }
  }
}

// One query of a part, spread over the lanes.
struct PartQuery {
  Sphere sphere;
  Vf slope;

  HWY_INLINE PartQuery(const QueryPacket& packet, size_t i)
      : sphere(MakeSphere({packet.p[0][i], packet.p[1][i], packet.p[2][i]}, packet.radius_squared[i])),
        slope(hn::Set(Floats(), packet.slope[i])) {}
};

// Of blocks whose photons have the packet's surface. Queries beyond the packet's size reach nothing.
template <KernelType kType>
HWY_INLINE void AddPart(const PhotonColumns& c, const QueryPacket& packet, size_t first,
                        const uint32_t* blocks, size_t size, GatherSum* sums) {
  const Floats d;
  using Sum = FluxSum<kType>;
  // By name: an array would not stay in registers.
  Sum s0, s1, s2, s3;
  const size_t third = first + kTogether / 2, fourth = first + kTogether - 1;
  const PartQuery q0(packet, first), q1(packet, first + 1), q2(packet, third), q3(packet, fourth);
  for (size_t b = 0; b < size;) {
    const uint32_t run = blocks[b] >> Sum::kShift;
    s0.Reach(blocks[b]), s1.Reach(blocks[b]), s2.Reach(blocks[b]), s3.Reach(blocks[b]);
    for (; b < size && blocks[b] >> Sum::kShift == run; ++b) {
      for (uint32_t j = 0; j < BoxTree::kBlockPhotons; j += uint32_t(hn::Lanes(d))) {
        const uint64_t i = uint64_t(blocks[b]) + j;
        const Vf x = hn::LoadU(d, c.x + i), y = hn::LoadU(d, c.y + i), z = hn::LoadU(d, c.z + i);
        const Rgb9e5Power power(c, i);
        const auto add = [&](const PartQuery& q, Sum& sum) HWY_ATTR {
          const Vf distance_squared =
              LengthSquared(hn::Sub(x, q.sphere.x), hn::Sub(y, q.sphere.y), hn::Sub(z, q.sphere.z));
          const Vf weight = hn::Mul(Weight<kType>(distance_squared, q.slope), power.scale);
          sum.Add(power, weight, hn::Le(distance_squared, q.sphere.radius_squared));
        };
        add(q0, s0);
        add(q1, s1);
        if constexpr (kTogether > 2) add(q2, s2), add(q3, s3);
      }
    }
  }
  s0.AddTo(sums[first]);
  s1.AddTo(sums[first + 1]);
  if constexpr (kTogether > 2) s2.AddTo(sums[third]), s3.AddTo(sums[fourth]);
}

// sums: of all kQueries, zero before. False when the packet meets too much; then sums stay as they are.
bool GatherPacket(const IndexedPhotons& photons, const QueryPacket& packet, const BoxTree::Start& start,
                  std::span<const GatherQuery> queries, KernelType kernel, GatherSum* sums) {
  const PhotonColumns& c = photons.columns;
  PacketNodes nodes;
  if (!FindPacketNodes(*photons.tree, packet, start, nodes)) return false;
  PacketBlocks found;
  FindPacketBlocks(*photons.tree, packet, nodes, found);
  return WithKernel(kernel, [&]<KernelType kType>() HWY_ATTR {
    for (size_t part = 0; part < kParts; ++part)
      AddPart<kType>(c, packet, part * kTogether, found.same[part], found.same_size[part], sums);
    for (size_t q = 0; q < queries.size(); ++q) {
      const size_t part = q / kTogether;
      sums[q].candidates += uint64_t(found.reached[q]) * BoxTree::kBlockPhotons;
      if (HWY_LIKELY(found.other_size[part] == 0)) continue;
      FluxSum<kType> others;
      AddOthers(c, LaneQuery(queries[q], photons.size), found.other[part], found.other_size[part],
                hn::Set(Floats(), packet.slope[q]), others);
      others.AddTo(sums[q]);
    }
    return true;
  });
}

}  // namespace kaustik::photon::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kaustik::photon {

HWY_EXPORT(GatherPacket);

namespace {

// Fewer are answered one by one: the work they would share is less than what they would read in vain.
constexpr size_t kFewest = 6;

// The lanes of queries that share a surface and read the whole map.
QueryPacket make_packet(std::span<const GatherQuery> queries, const float* slopes, uint32_t surface) {
  QueryPacket packet;
  packet.surface = surface;
  for (size_t i = 0; i < QueryPacket::kMost; ++i) {
    const GatherQuery& q = queries[std::min(i, queries.size() - 1)];
    const bool used = i < queries.size();
    for (int a = 0; a < 3; ++a) {
      packet.p[a][i] = q.p[a];
      packet.lo[a] = std::min(packet.lo[a], q.p[a]);
      packet.hi[a] = std::max(packet.hi[a], q.p[a]);
    }
    packet.radius_squared[i] = used ? q.radius_squared() : -1.0f;
    packet.slope[i] = used ? slopes[i] : 0;
    packet.most = std::max(packet.most, q.radius);
    packet.most_squared = std::max(packet.most_squared, q.radius_squared());
  }
  return packet;
}

// How far apart queries of a packet are at most, in radii: wider ones read too much that few of them reach.
constexpr float kWidest = 2.5f;

// How many of the queries from the first on go together: on one surface, reading the whole map, near each
// other.
size_t packet_size(std::span<const GatherQuery> queries, uint64_t size, uint32_t surface) {
  const auto joins = [&](const GatherQuery& q) {
    return q.within.begin == 0 && q.within.end >= size && pack_surface(q.n, q.surface_group) == surface;
  };
  Bounds3 bounds;
  size_t count = 0;
  while (count < std::min(queries.size(), QueryPacket::kMost) && joins(queries[count])) {
    bounds.add(queries[count].p);
    if (!(max_component(bounds.diagonal()) <= kWidest * queries[0].radius)) break;
    ++count;
  }
  return count;
}

bool gather_packet(const IndexedPhotons& photons, std::span<const GatherQuery> queries, uint32_t surface,
                   KernelType kernel, const float* slopes, GatherSum* sums) {
  const QueryPacket packet = make_packet(queries, slopes, surface);
  const CellRanges ranges = photons.octree->ranges_near(packet.lo, packet.hi, packet.most, kAllPhotons);
  GatherSum found[QueryPacket::kMost];
  if (!HWY_DYNAMIC_DISPATCH(GatherPacket)(photons, packet, photons.tree->start_at(ranges), queries, kernel,
                                          found))
    return false;
  std::copy_n(found, queries.size(), sums);
  return true;
}

}  // namespace

void gather_photons(const IndexedPhotons& photons, std::span<const GatherQuery> queries, KernelType kernel,
                    const float* slopes, GatherSum* sums) {
  while (!queries.empty()) {
    const uint32_t surface = pack_surface(queries[0].n, queries[0].surface_group);
    const size_t count = std::max<size_t>(1, packet_size(queries, photons.size, surface));
    const std::span<const GatherQuery> some = queries.first(count);
    if (count < kFewest || !gather_packet(photons, some, surface, kernel, slopes, sums))
      for (size_t i = 0; i < count; ++i) sums[i] = gather_photons(photons, some[i], kernel, slopes[i]);
    queries = queries.subspan(count);
    slopes += count;
    sums += count;
  }
}

}  // namespace kaustik::photon
#endif
