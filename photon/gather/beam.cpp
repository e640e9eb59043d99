// The search along a ray, compiled once per instruction set (Google Highway) and chosen at run time.

#include "photon/gather/beam.h"

#include <cmath>
#include <numeric>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "photon/gather/beam.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "hwy/contrib/math/math-inl.h"
#include "photon/gather/flux_sum-inl.h"

HWY_BEFORE_NAMESPACE();
namespace kaustik::photon::HWY_NAMESPACE {

// One axis of the ray, prepared for boxes that are widened by the radius.
struct BeamAxis {
  float origin, direction, inverse;
  float before_near, behind_far;  // added to the sides of a box that the ray enters and leaves by
  bool backwards;

  BeamAxis(float o, float d, float radius) : origin(o), direction(d) {
    // An axis along which the ray does not move decides all the same, with places that are very far.
    constexpr float kHardlyMoves = 1e-20f;
    inverse = 1 / (std::abs(d) < kHardlyMoves ? std::copysign(kHardlyMoves, d) : d);
    backwards = std::signbit(d);
    before_near = backwards ? radius : -radius;
    behind_far = -before_near;
  }
  const float* near(const BoxNode& node, int axis) const { return backwards ? node.hi[axis] : node.lo[axis]; }
  const float* far(const BoxNode& node, int axis) const { return backwards ? node.lo[axis] : node.hi[axis]; }
};

struct LaneBeam {
  BeamAxis axes[3];
  float distance, radius_squared;
  uint32_t medium;

  explicit LaneBeam(const BeamQuery& q)
      : axes{{q.ray.o.x, q.ray.d.x, q.radius},
             {q.ray.o.y, q.ray.d.y, q.radius},
             {q.ray.o.z, q.ray.d.z, q.radius}},
        distance(q.distance),
        radius_squared(q.radius >= 0 ? q.radius * q.radius : -1.0f),
        medium(q.medium & 0xffff) {}
};

// Mask of the boxes from b on that the beam meets. The sides of empty boxes are the wrong way round, so that
// none meets them.
HWY_INLINE Mask Meets(const LaneBeam& beam, const BoxNode& node, uint32_t b) {
  const Floats d;
  Vf enter = hn::Zero(d), leave = hn::Set(d, beam.distance);
  for (int a = 0; a < 3; ++a) {
    const BeamAxis& axis = beam.axes[a];
    const auto at = [&](const float* side, float widened) HWY_ATTR {
      const Vf place = hn::Add(hn::Sub(hn::Load(d, side + b), hn::Set(d, axis.origin)), hn::Set(d, widened));
      return hn::Mul(place, hn::Set(d, axis.inverse));
    };
    enter = hn::Max(enter, at(axis.near(node, a), axis.before_near));
    leave = hn::Min(leave, at(axis.far(node, a), axis.behind_far));
  }
  return hn::Le(enter, leave);
}

// Where the photons from i on are abreast of the ray, how far from it, and which of them count.
struct BesideBeam {
  Vf t, squared;
  Mask counts;

  HWY_INLINE BesideBeam(const LaneBeam& beam, const PhotonColumns& c, uint32_t i) {
    const Floats d;
    const Words u;
    const float* const columns[] = {c.x, c.y, c.z};
    Vf from[3];
    t = hn::Zero(d);
    for (int a = 0; a < 3; ++a) {
      from[a] = hn::Sub(hn::LoadU(d, columns[a] + i), hn::Set(d, beam.axes[a].origin));
      t = hn::Add(t, hn::Mul(from[a], hn::Set(d, beam.axes[a].direction)));
    }
    // From the vector across the ray, since the difference of two squares would cancel far from its start.
    squared = hn::Zero(d);
    for (int a = 0; a < 3; ++a) {
      const Vf across = hn::Sub(from[a], hn::Mul(t, hn::Set(d, beam.axes[a].direction)));
      squared = hn::Add(squared, hn::Mul(across, across));
    }
    const Mask abreast = hn::And(hn::Ge(t, hn::Zero(d)), hn::Le(t, hn::Set(d, beam.distance)));
    const auto medium = hn::Eq(hn::ShiftRight<16>(hn::LoadU(u, c.surface + i)), hn::Set(u, beam.medium));
    const Mask near = hn::Le(squared, hn::Set(d, beam.radius_squared));
    counts = hn::And(hn::And(abreast, near), hn::RebindMask(d, medium));
  }
};

// Visits the blocks below one node of a level.
template <class Fn>
void VisitAlong(const BoxTree& tree, const LaneBeam& beam, int level, uint32_t node, const Fn& visit) {
  const Floats d;
  uint32_t below[2 * BoxNode::kBoxes];
  size_t found = 0;
  for (uint32_t b = 0; b < BoxNode::kBoxes; b += uint32_t(hn::Lanes(d))) {
    const Mask meets = Meets(beam, tree.level(level)[node], b);
    found += StoreLanes(Words(), Numbers(node * BoxNode::kBoxes + b), meets, below + found);
  }
  for (size_t i = 0; i < found; ++i) {
    if (level > 0)
      VisitAlong(tree, beam, level - 1, below[i], visit);
    else
      visit(below[i] * BoxTree::kBlockPhotons);
  }
}

// Calls visit(first photon of a block) for the blocks that the beam meets, in ascending order.
template <class Fn>
void VisitAlong(const PhotonMap& map, const LaneBeam& beam, const Fn& visit) {
  VisitAlong(map.boxes(), beam, map.boxes().levels() - 1, 0, visit);
}

void SelectAlong(const PhotonMap& map, const BeamQuery& query, GatherCounters& counters, TakeBeamPhotons take,
                 void* to) {
  const Floats d;
  const LaneBeam beam(query);
  VisitAlong(map, beam, [&](uint32_t block) HWY_ATTR {
    uint32_t index[2 * BoxTree::kBlockPhotons];
    float t[2 * BoxTree::kBlockPhotons], squared[2 * BoxTree::kBlockPhotons];
    size_t size = 0;
    for (uint32_t j = 0; j < BoxTree::kBlockPhotons; j += uint32_t(hn::Lanes(d))) {
      const BesideBeam photons(beam, map.columns(), block + j);
      StoreLanes(d, photons.t, photons.counts, t + size);
      StoreLanes(d, photons.squared, photons.counts, squared + size);
      size += StoreLanes(Words(), Numbers(block + j), photons.counts, index + size);
    }
    counters.candidates += BoxTree::kBlockPhotons;
    counters.accepted += size;
    if (size > 0) take(to, {index, t, squared, size});
  });
}

uint64_t CountAlong(const PhotonMap& map, const BeamQuery& query) {
  const LaneBeam beam(query);
  uint64_t count = 0;
  VisitAlong(map, beam, [&](uint32_t block) HWY_ATTR {
    for (uint32_t j = 0; j < BoxTree::kBlockPhotons; j += uint32_t(hn::Lanes(Floats())))
      count += hn::CountTrue(Floats(), BesideBeam(beam, map.columns(), block + j).counts);
  });
  return count;
}

// Cosines between the directions of the photons from i on, towards where they came from, and the ray: those
// of unpack_direction().
HWY_INLINE Vf Cosines(const LaneBeam& beam, const PhotonColumns& c, uint32_t i) {
  const Floats d;
  const Words u;
  const hn::RebindToSigned<Floats> s;
  const Vu bits = hn::LoadU(u, c.direction + i);
  const auto coordinate = [&](Vu part) HWY_ATTR {
    return hn::ConvertTo(d, hn::Sub(hn::BitCast(s, hn::And(part, hn::Set(u, 0xffffu))), hn::Set(s, 0x7fff)));
  };
  Vf x = coordinate(bits), y = coordinate(hn::ShiftRight<16>(bits));
  const Vf z = hn::Sub(hn::Sub(hn::Set(d, 32767.0f), hn::Abs(x)), hn::Abs(y));
  const Vf fold = hn::Max(hn::Neg(z), hn::Zero(d));
  x = hn::Sub(x, hn::CopySign(fold, x));
  y = hn::Sub(y, hn::CopySign(fold, y));
  const Vf dot = hn::MulAdd(
      x, hn::Set(d, beam.axes[0].direction),
      hn::MulAdd(y, hn::Set(d, beam.axes[1].direction), hn::Mul(z, hn::Set(d, beam.axes[2].direction))));
  return hn::Div(dot, hn::Sqrt(LengthSquared(x, y, z)));
}

// phase() without its constant factor: the light goes on against the ray.
HWY_INLINE Vf Phase(const LaneBeam& beam, const PhotonColumns& c, uint32_t i, float g) {
  const Floats d;
  const float a = std::abs(g);
  const Vf cosine = Cosines(beam, c, i), one = hn::Set(d, 1.0f);
  const Vf from_lobe = g < 0 ? hn::Add(one, cosine) : hn::Sub(one, cosine);
  const Vf s = hn::MulAdd(hn::Set(d, 2 * a), from_lobe, hn::Set(d, (1 - a) * (1 - a)));
  return hn::Div(one, hn::Mul(s, hn::Sqrt(s)));
}

// The power of photons in RGB, which coloured media absorb.
struct RgbOfPower {
  Vf scale, component[3];

  HWY_INLINE RgbOfPower(const Rgb9e5Power& power, bool converts) : scale(power.scale) {
    const Floats d;
    for (int k = 0; k < 3; ++k) component[k] = converts ? hn::Zero(d) : power.component[k];
    if (!converts) return;
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        component[k] =
            hn::MulAdd(power.component[j],
                       hn::Set(d, float(white_xyz_to_ours()[j][k]) * Rgb9e5Power::kUnit[j]), component[k]);
  }
  static float unit(int k, bool converts) { return converts ? 1 : Rgb9e5Power::kUnit[k]; }
};

// The column densities up to these places.
HWY_INLINE Vf Columns(const ColumnTable& table, Vf t) {
  const Floats d;
  float lanes[HWY_MAX_BYTES / sizeof(float)];
  hn::StoreU(t, d, lanes);
  table.replace({lanes, hn::Lanes(d)});
  return hn::LoadU(d, lanes);
}

// The weights of photons over the shares of the kernel that the ray sees.
HWY_INLINE Vf OverShares(const BeamSight& sight, const BesideBeam& photons, Vf weight) {
  const Floats d;
  float t[HWY_MAX_BYTES / sizeof(float)], share[HWY_MAX_BYTES / sizeof(float)];
  hn::StoreU(hn::IfThenElseZero(photons.counts, photons.t), d, t);
  for (size_t k = 0; k < hn::Lanes(d); ++k) share[k] = sight.share(t[k]);
  return hn::Div(weight, hn::LoadU(d, share));
}

// What the photons of one block add to the sum, and where they are abreast of the ray.
struct BlockParts {
  static constexpr uint32_t kSize = BoxTree::kBlockPhotons;

  float part[2 * kSize] = {}, t[2 * kSize] = {};
  glm::dvec3 sum{0};
  uint64_t accepted = 0;

  float all() const { return std::accumulate(part, part + kSize, 0.0f); }
  // The photon at this place, from zero to all(), of the parts one after the other.
  uint32_t at(float place) const {
    uint32_t chosen = 0;
    for (uint32_t j = 0; j < kSize && place >= 0; ++j) {
      if (!(part[j] > 0)) continue;
      chosen = j;
      place -= part[j];
    }
    return chosen;
  }
};

// Adds blocks to a sum if the ray sees one of their photons, which is chosen in proportion to its part.
class SeenBlocks {
 public:
  SeenBlocks(const PhotonMap& map, const BeamSight* sight) : map_(map), sight_(sight) {}

  void add(uint32_t block, const BlockParts& parts) {
    waiting_ += parts.sum;
    const float part = sight_ ? parts.all() : 0;
    if (!(part > 0)) return;
    all_ += part;
    // Of the blocks that wait, each keeps its share of the choice.
    const float place = sight_->number(block) * all_;
    if (place < part) {
      const uint32_t j = parts.at(place);
      chosen_ = block + j;
      t_ = parts.t[j];
    }
    if (++blocks_ == kBlocksOfRay) decide();
  }

  glm::dvec3 sum() {
    decide();
    return sum_;
  }

 private:
  // Blocks of sixteen photons that share a ray; they are neighbours in the map.
  static constexpr int kBlocksOfRay = 4;

  void decide() {
    if (!sight_ || (blocks_ > 0 && sight_->sees(t_, map_.photon(chosen_).p))) sum_ += waiting_;
    waiting_ = glm::dvec3(0);
    all_ = 0;
    blocks_ = 0;
  }

  const PhotonMap& map_;
  const BeamSight* sight_;
  glm::dvec3 sum_{0}, waiting_{0};
  float all_ = 0, t_ = 0;
  uint32_t chosen_ = 0;
  int blocks_ = 0;
};

// The sum over the photons of one block, as if the ray saw them.
template <KernelType kType>
BlockParts PartsOfBlock(const PhotonColumns& c, const LaneBeam& beam, const BeamQuery& query,
                        const Medium& medium, float slope, bool converts, uint32_t block) {
  const Floats d;
  const Rgb sigma_t = medium.sigma_t();
  const bool grey = is_grey(sigma_t);
  Vf of_block[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  BlockParts parts;
  for (uint32_t j = 0; j < BoxTree::kBlockPhotons; j += uint32_t(hn::Lanes(d))) {
    const BesideBeam photons(beam, c, block + j);
    if (hn::AllFalse(d, photons.counts)) continue;
    parts.accepted += hn::CountTrue(d, photons.counts);
    const RgbOfPower power(Rgb9e5Power(c, block + j), converts);
    Vf weight = hn::Mul(Weight<kType>(photons.squared, hn::Set(d, slope)), power.scale);
    if (medium.g != 0) weight = hn::Mul(weight, Phase(beam, c, block + j, medium.g));
    weight = hn::IfThenElseZero(photons.counts, weight);
    if (query.sight) weight = OverShares(*query.sight, photons, weight);
    Vf column = hn::IfThenElseZero(photons.counts, photons.t);
    if (query.columns) column = Columns(*query.columns, column);
    Vf left = hn::Zero(d), part = hn::Zero(d);
    for (int k = 0; k < 3; ++k) {
      if (k == 0 || !grey) left = hn::Exp(d, hn::Mul(hn::Set(d, -sigma_t[k]), column));
      const Vf light = hn::Mul(weight, left);
      of_block[k] = hn::MulAdd(light, power.component[k], of_block[k]);
      const Vf watts = hn::Mul(power.component[k], hn::Set(d, RgbOfPower::unit(k, converts)));
      part = hn::MulAdd(light, watts, part);
    }
    hn::StoreU(part, d, parts.part + j);
    hn::StoreU(photons.t, d, parts.t + j);
  }
  for (int k = 0; k < 3; ++k)
    parts.sum[k] = double(hn::GetLane(hn::SumOfLanes(d, of_block[k])) * RgbOfPower::unit(k, converts));
  return parts;
}

glm::dvec3 GatherAlong(const PhotonMap& map, const BeamQuery& query, const Medium& medium, KernelType kernel,
                       float slope, GatherCounters& counters) {
  const LaneBeam beam(query);
  const bool converts = !is_grey(medium.sigma_t()) && map.colours() == FluxColours::kXyz;
  SeenBlocks seen(map, query.sight);
  with_kernel(kernel, [&]<KernelType kType>() HWY_ATTR {
    VisitAlong(map, beam, [&](uint32_t block) HWY_ATTR {
      const BlockParts parts =
          PartsOfBlock<kType>(map.columns(), beam, query, medium, slope, converts, block);
      counters.candidates += BoxTree::kBlockPhotons;
      counters.accepted += parts.accepted;
      if (parts.accepted > 0) seen.add(block, parts);
    });
  });
  return seen.sum();
}

}  // namespace kaustik::photon::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kaustik::photon {

HWY_EXPORT(SelectAlong);
HWY_EXPORT(CountAlong);
HWY_EXPORT(GatherAlong);

void select_along(const PhotonMap& map, const BeamQuery& query, GatherCounters& counters,
                  TakeBeamPhotons take, void* to) {
  ++counters.queries;
  if (!map.empty()) HWY_DYNAMIC_DISPATCH(SelectAlong)(map, query, counters, take, to);
}

uint64_t count_along(const PhotonMap& map, const BeamQuery& query) {
  return map.empty() ? 0 : HWY_DYNAMIC_DISPATCH(CountAlong)(map, query);
}

Rgb gather_along(const PhotonMap& map, const BeamQuery& query, const Medium& medium, const KernelSpec& kernel,
                 GatherCounters& counters) {
  const KernelTerms terms = kernel_terms(kernel, query.radius);
  if (map.empty() || !(terms.scale > 0)) return Rgb(0);
  const uint64_t before = counters.candidates;
  const glm::dvec3 sum =
      HWY_DYNAMIC_DISPATCH(GatherAlong)(map, query, medium, kernel.type, terms.slope, counters);
  counters.queries += 1 + (counters.candidates - before) / kCandidatesOfQuery;
  const double of_phase = double(0.25f * kInvPi * (1 - medium.g * medium.g));
  const glm::dvec3 light = sum * (of_phase * double(terms.scale) * double(map.flux_unit()));
  return Rgb(is_grey(medium.sigma_t()) ? rgb_of_flux(light, map.colours()) : light);
}

}  // namespace kaustik::photon
#endif
