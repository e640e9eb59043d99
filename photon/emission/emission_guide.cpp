// Grows the density tree of guided emission from hits, and warps random numbers through it.

#include "photon/emission/emission_guide.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace kaustik::photon {

namespace {

constexpr size_t kBins = 16;      // a box can be split between any two
constexpr double kLeastHits = 4;  // a box with fewer is not split
// Least significance of a split: about chi-square, for the best of 60 to 75 candidates.
constexpr double kLeastScore = 16;
// Each box is credited with this many evenly spread hits beside its own, since a part without hits need not
// be empty.
constexpr double kPriorHits = 2;
constexpr int kMostDepth = 48;

struct Split {
  size_t bin = 0;  // the first bin of the upper part; 0: no split
  uint32_t dimension = 0;
  double below = 0, score = 0;  // below: share of the hits in the lower part
};

// Statistics of the hits in a box.
struct Counts {
  double total = 0, squares = 0;
  std::array<std::array<double, kBins>, kEmissionNumbers> bins{};

  // Number of hits of equal weight that would carry as much information (Kish 1965, "Survey Sampling").
  double effective() const { return squares > 0 ? total * total / squares : 0; }
};

// Freeman and Tukey's statistic 8 n (1 - BC), where BC is the Bhattacharyya coefficient between the hits and
// a uniform distribution over the two parts of a split; `share` and `volume` are those of the lower part. BC
// is also the factor by which the split reduces the standard deviation.
double score_of(double hits, double share, double volume) {
  const double above = std::max(0.0, 1 - share);
  return 8 * hits * (1 - std::sqrt(share * volume) - std::sqrt(above * (1 - volume)));
}

Split best_split(const Counts& counts, uint32_t dimensions) {
  Split best;
  const double hits = counts.effective();
  if (hits < kLeastHits) return best;
  for (uint32_t d = 0; d < dimensions; ++d) {
    double below = 0;
    for (size_t bin = 1; bin < kBins; ++bin) {
      below += counts.bins[d][bin - 1];
      const double share = below / counts.total;
      const double score = score_of(hits, share, double(bin) / double(kBins));
      if (score > best.score) best = {bin, d, share, score};
    }
  }
  return best.score >= kLeastScore ? best : Split{};
}

}  // namespace

// Grows an EmissionGuide's tree from the root.
class GuideBuilder {
 public:
  GuideBuilder(EmissionGuide* guide, uint32_t dimensions) : guide_(*guide), dimensions_(dimensions) {}

  void build(std::span<GuideHit> hits) {
    guide_.nodes_.emplace_back();
    Part whole;
    whole.box.extent.fill(1);
    grow(whole, hits, 0);
    double sum = 0;
    for (const Part& leaf : leaves_) sum += leaf.root();
    probabilities_.resize(guide_.nodes_.size());
    add_up(0, sum);
    weigh(0, 1);
    summarise();
  }

 private:
  using Node = EmissionGuide::Node;
  using Box = EmissionGuide::Box;

  struct Part {
    size_t node = 0;
    Box box;
    double volume = 1, mass = 1;  // share of the weight of all hits
    // Unnormalised probability. The best density is proportional to the root of the mean weight mass /
    // volume; times volume this is sqrt(volume * mass).
    double root() const { return std::sqrt(volume * mass); }
  };

  Counts count(const Box& box, std::span<const GuideHit> hits) const {
    Counts counts;
    for (const GuideHit& hit : hits) {
      counts.total += hit.weight;
      counts.squares += hit.weight * hit.weight;
      for (size_t d = 0; d < dimensions_; ++d) {
        const float at = (hit.u[d] - box.low[d]) / box.extent[d] * float(kBins);
        counts.bins[d][std::min(size_t(std::max(at, 0.0f)), kBins - 1)] += hit.weight;
      }
    }
    return counts;
  }

  void grow(const Part& part, std::span<GuideHit> hits, int depth) {
    const Counts counts = count(part.box, hits);
    const Split split = depth < kMostDepth ? best_split(counts, dimensions_) : Split{};
    if (split.bin == 0) return add_leaf(part);
    const uint32_t d = split.dimension, child = static_cast<uint32_t>(guide_.nodes_.size());
    const double volume = double(split.bin) / double(kBins), n = counts.effective();
    const double mass = (n * split.below + kPriorHits * volume) / (n + kPriorHits);
    Part below = part, above = part;
    below.node = child, above.node = child + 1;
    below.volume *= volume, above.volume *= 1 - volume;
    below.mass *= mass, above.mass *= 1 - mass;
    below.box.extent[d] *= float(volume);
    above.box.extent[d] *= float(1 - volume);
    const float at = above.box.low[d] += below.box.extent[d];
    Node& node = guide_.nodes_[part.node];
    node.at = at, node.dimension = d, node.child = child;
    guide_.nodes_.resize(child + 2);
    const auto middle =
        std::stable_partition(hits.begin(), hits.end(), [&](const GuideHit& hit) { return hit.u[d] < at; });
    const auto first = static_cast<size_t>(middle - hits.begin());
    grow(below, hits.first(first), depth + 1);
    grow(above, hits.subspan(first), depth + 1);
  }

  void add_leaf(const Part& part) {
    guide_.nodes_[part.node].child = static_cast<uint32_t>(guide_.boxes_.size());
    guide_.boxes_.push_back(part.box);
    leaves_.push_back(part);
  }

  // Computes the probability of a node and those below it; `sum` is that of root() over all leaves.
  double add_up(size_t index, double sum) {
    constexpr double kUniform = EmissionGuide::kUniformShare;
    const Node& node = guide_.nodes_[index];
    double p = 0;
    if (node.dimension == EmissionGuide::kLeaf) {
      const Part& leaf = leaves_[node.child];
      p = (1 - kUniform) * leaf.root() / sum + kUniform * leaf.volume;
    } else {
      p = add_up(node.child, sum) + add_up(node.child + 1, sum);
    }
    return probabilities_[index] = p;
  }

  // Sets the nodes' branch probabilities and the boxes' weights. `reached` is the product of the rounded
  // probabilities by which warp() reaches the node.
  void weigh(size_t index, double reached) {
    Node& node = guide_.nodes_[index];
    if (node.dimension == EmissionGuide::kLeaf) {
      guide_.boxes_[node.child].weight = static_cast<float>(leaves_[node.child].volume / reached);
      return;
    }
    node.left = static_cast<float>(probabilities_[node.child] / probabilities_[index]);
    node.to_left = 1 / node.left, node.to_right = 1 / (1 - node.left);
    weigh(node.child, reached * double(node.left));
    weigh(node.child + 1, reached * (1 - double(node.left)));
  }

  void summarise() {
    guide_.variance_ = 0;
    int least = 0, most = 0;
    for (size_t i = 0; i < leaves_.size(); ++i) {
      const float weight = guide_.boxes_[i].weight;
      guide_.variance_ += leaves_[i].mass * double(weight);
      least = std::min(least, std::ilogb(weight));
      most = std::max(most, std::ilogb(weight));
    }
    guide_.middle_exponent_ = (least + most) / 2;
  }

  EmissionGuide& guide_;
  uint32_t dimensions_;
  std::vector<Part> leaves_;           // in the order of boxes_
  std::vector<double> probabilities_;  // of each node
};

EmissionGuide::EmissionGuide(std::vector<GuideHit> hits, uint32_t dimensions) {
  if (!hits.empty()) GuideBuilder(this, dimensions).build(hits);
}

float EmissionGuide::warp(EmissionPoint& u) const {
  const Node* node = nodes_.data();
  while (node->dimension != kLeaf) {
    float& x = u[node->dimension];
    const bool above = x >= node->left;
    x = std::min(above ? (x - node->left) * node->to_right : x * node->to_left, kOneMinusEpsilon);
    node = &nodes_[node->child + above];
  }
  const Box& box = boxes_[node->child];
  for (size_t d = 0; d < u.size(); ++d) u[d] = std::min(box.low[d] + box.extent[d] * u[d], kOneMinusEpsilon);
  return box.weight;
}

void EmissionGuide::warp(EmissionLanes& starts, size_t count, LaneColumn& weights) const {
  auto& numbers = starts.position_direction.u;
  for (size_t k = 0; k < count; ++k) {
    EmissionPoint u{numbers[0][k], numbers[1][k], numbers[2][k], numbers[3][k], starts.u_light[k]};
    weights[k] = warp(u);
    for (size_t d = 0; d < 4; ++d) numbers[d][k] = u[d];
    starts.u_light[k] = u[4];
  }
}

float EmissionGuide::density(const EmissionPoint& u) const {
  const Node* node = nodes_.data();
  while (node->dimension != kLeaf) node = &nodes_[node->child + (u[node->dimension] >= node->at)];
  return 1 / boxes_[node->child].weight;
}

GuidedStart start_of(const Scene& scene, Sampler sampler, const EmissionGuide* guide) {
  GuidedStart start{point_of(emission_numbers(scene, sampler))};
  if (guide) start.weight = guide->warp(start.u);
  return start;
}

}  // namespace kaustik::photon
