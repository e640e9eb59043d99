// Chooses the radii of photons' discs by a test of how evenly photons lie around them.

#include "photon/gather/photon_discs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/math/frame.h"
#include "core/parallel/parallel.h"
#include "photon/gather/gather.h"
#include "photon/gather/nearest.h"

namespace kaustik::photon {

namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

// Each step of a disc's growth makes its radius larger by this.
constexpr float kGrowth = 1.5f;
// A disc stops growing where the statistic of its evenness exceeds this. Of even photons one disc in 800
// exceeds it; a smaller bound stops discs by mere chance, one of their many steps after the other.
constexpr double kUneven = 20;
// Photons that are nearer than this fraction of a disc's radius take the same radius, so that few discs are
// searched for: an edge that keeps from one disc keeps two thirds of its radius from the other.
constexpr float kShared = 1.0f / 3;
// The photons of this many nodes share discs.
constexpr size_t kNodesTogether = 16;
// Smallest radius as a fraction of the largest.
constexpr float kSmallest = 0x1p-10f;
// A photon that is brighter than this multiple of the mean around it gets a wider disc.
constexpr float kBright = 2;

float brightness(const Rgb& flux) {
  return flux.x + flux.y + flux.z;
}

// Moments of photons in a disc, whose positions have the disc's radius as unit.
class Moments {
 public:
  void add(float x, float y) {
    const float xx = x * x, yy = y * y;
    ++n_;
    rim_ += double(xx + yy) - 0.5;
    x_ += double(x), y_ += double(y);
    along_ += double(xx - yy), across_ += double(2 * x * y);
  }
  // How far the photons are from lying evenly: a chi square of five degrees of freedom if they lie so. Of
  // even photons, x^2 + y^2 has the variance 1/12, x and y have 1/4, x^2 - y^2 and 2xy have 1/6. A disc over
  // an edge of light shows in x and y, one over a line in x^2 - y^2 and 2xy, one over a spot in x^2 + y^2.
  double unevenness() const {
    if (n_ == 0) return 0;
    return (12 * rim_ * rim_ + 4 * (x_ * x_ + y_ * y_) + 6 * (along_ * along_ + across_ * across_)) /
           double(n_);
  }
  uint64_t size() const { return n_; }

 private:
  uint64_t n_ = 0;
  double rim_ = 0, x_ = 0, y_ = 0, along_ = 0, across_ = 0;
};

// A photon, the radius of its disc in metres, and the mean brightness of the photons in it.
struct Disc {
  Photon photon;
  float radius = 0, brightness = 0;

  bool shares(const Photon& other) const {
    const float reach = kShared * radius;
    return other.surface_group == photon.surface_group && glm::dot(other.n, photon.n) > kNormalCosine &&
           length_squared(other.p - photon.p) <= reach * reach;
  }
};

class DiscSearch {
 public:
  DiscSearch(const PhotonMap& map, const DiscRule& rule) : map_(map), rule_(rule) {}

  // Writes the stretches of the photons from `first` to `last`, which share discs with each other.
  void find_stretches(uint64_t first, uint64_t last, float* stretch) const {
    std::array<Disc, kLatest> latest{};
    size_t found = 0;
    const auto disc_near = [&](const Photon& photon) -> const Disc& {
      for (size_t back = 1; back <= std::min(found, kLatest); ++back)
        if (const Disc& disc = latest[(found - back) % kLatest]; disc.shares(photon)) return disc;
      return latest[found++ % kLatest] = disc_of(photon);
    };
    for (uint64_t i = first; i < last; ++i) {
      const Photon photon = map_.photon(i);
      *stretch++ = stretch_of(photon, disc_near(photon));
    }
  }

 private:
  static constexpr size_t kLatest = 32;  // number of latest discs that are compared

  float stretch_of(const Photon& photon, const Disc& disc) const {
    const float share = rule_.largest / disc.radius;
    const float most = kBright * disc.brightness, flux = brightness(photon.flux);
    return std::max(1.0f, most > 0 && flux > most ? share * share * (most / flux) : share * share);
  }

  Disc disc_of(const Photon& photon) const {
    const float radius = grown(photon, radius_of_fewest(photon));
    GatherCounters counters;
    const Rgb density = gather_flux(map_, query(photon, radius), {}, counters);
    const float area = kPi * radius * radius, n = float(std::max<uint64_t>(counters.accepted, 1));
    return {photon, radius, brightness(density) * area / n};
  }

  GatherQuery query(const Photon& photon, float radius) const {
    return {photon.p, photon.n, photon.surface_group, radius, kAllPhotons};
  }

  // The photon itself is the nearest of all. Photons may lie on each other.
  float radius_of_fewest(const Photon& photon) const {
    GatherCounters ignored;
    return std::max(kSmallest * rule_.largest,
                    nearest_radius(map_, query(photon, rule_.largest), rule_.fewest + 1, ignored));
  }

  float grown(const Photon& photon, float radius) const {
    while (radius < rule_.largest) {
      const float next = std::min(rule_.largest, kGrowth * radius);
      const Moments moments = moments_within(photon, next);
      if (moments.unevenness() > kUneven) break;
      radius = next;
      if (double(moments.size()) * double(kGrowth * kGrowth) > rule_.most) break;
    }
    return radius;
  }

  Moments moments_within(const Photon& photon, float radius) const {
    Moments moments;
    const Frame frame = Frame::from_z(photon.n);
    const PhotonPositions positions = map_.positions();
    const float unit = 1 / radius;
    GatherCounters ignored;
    for_each_index(
        map_, query(photon, radius),
        [&](uint32_t i, float) {
          const Vector3 d = (positions[i] - photon.p) * unit;
          moments.add(glm::dot(d, frame.x), glm::dot(d, frame.y));
        },
        ignored);
    return moments;
  }

  const PhotonMap& map_;
  const DiscRule& rule_;
};

void find_least(const float* values, float* least) {
  constexpr uint32_t kBlock = BoxTree::kBlockPhotons;
  for (uint32_t b = 0; b < BoxNode::kBoxes; ++b)
    least[b] = *std::min_element(values + b * kBlock, values + (b + 1) * kBlock);
}

// Finds the least stretches of the nodes of a level from those of the level below.
void find_least_above(const BoxTree& tree, int level, PhotonDiscs::Least* least) {
  constexpr size_t kBoxes = BoxNode::kBoxes;
  const auto at = [&](int l) { return least + (tree.level(l).data() - tree.nodes().data()); };
  const PhotonDiscs::Least* const below = at(level - 1);
  const size_t size = tree.level(level - 1).size();
  for (size_t i = 0; i < tree.level(level).size(); ++i)
    for (size_t b = 0; b < kBoxes; ++b) {
      const size_t child = i * kBoxes + b;
      at(level)[i].of_box[b] =
          child < size ? *std::min_element(below[child].of_box, below[child].of_box + kBoxes) : kNone;
    }
}

}  // namespace

PhotonDiscs::PhotonDiscs(const PhotonMap& map, const DiscRule& rule) : largest_(rule.largest) {
  const BoxTree& tree = map.boxes();
  if (tree.levels() == 0) return;
  const size_t nodes = tree.level(0).size(), padded = nodes * BoxTree::kNodePhotons;
  UninitialisedArray<float> stretch(padded + kColumnPadding);
  UninitialisedArray<Least> least(tree.nodes().size());
  const DiscSearch search(map, rule);
  parallel::for_index(size_t{0}, (nodes + kNodesTogether - 1) / kNodesTogether, [&](size_t i) {
    const size_t end = std::min(nodes, (i + 1) * kNodesTogether);
    const uint64_t first = i * kNodesTogether * BoxTree::kNodePhotons;
    const uint64_t last = std::min<uint64_t>(map.size(), end * BoxTree::kNodePhotons);
    search.find_stretches(first, last, stretch.data() + first);
    std::fill(stretch.data() + last, stretch.data() + end * BoxTree::kNodePhotons, kNone);
    for (size_t node = i * kNodesTogether; node < end; ++node)
      find_least(stretch.data() + node * BoxTree::kNodePhotons, least[node].of_box);
  });
  std::fill_n(stretch.data() + padded, kColumnPadding, kNone);
  for (int level = 1; level < tree.levels(); ++level) find_least_above(tree, level, least.data());
  stretch_ = SharedArray(std::move(stretch));
  least_ = SharedArray(std::move(least));
}

}  // namespace kaustik::photon
