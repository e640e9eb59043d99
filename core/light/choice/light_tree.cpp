// Builds the light tree by a cost of bounds, and descends it at random.

#include "core/light/choice/light_tree.h"

#include <array>

namespace kaustik {
namespace {

constexpr int kBuckets = 12;
// Below this depth sets are halved, so that no path from the root is longer than 64: 32 further levels
// suffice for any number of lights.
constexpr uint32_t kDeepestChosenSplit = 32;

// Integral of the cosine over the directions into which a cone of normals emits (Conty Estevez and Kulla
// 2018, equation 1).
double orientation_measure(const LightBounds& b) {
  const double o = std::acos(double(std::clamp(b.cos_o, -1.0f, 1.0f)));
  const double e = std::acos(double(std::clamp(b.cos_e, -1.0f, 1.0f)));
  const double w = std::min(o + e, std::numbers::pi);
  return 2 * std::numbers::pi * (1 - std::cos(o)) +
         std::numbers::pi / 2 *
             (2 * w * std::sin(o) - std::cos(o - 2 * w) - 2 * o * std::sin(o) + std::cos(o));
}

// Uses the squared diagonal instead of the surface area of the box, because lights on a line have a box
// without area.
double cost(const LightBounds& b) {
  const glm::dvec3 d(b.box.diagonal());
  return double(b.phi) * orientation_measure(b) * glm::dot(d, d);
}

struct Split {
  double cost = std::numeric_limits<double>::infinity();
  int axis = -1;
  size_t bucket = 0;  // the last one on the left
};

using Buckets = std::array<std::optional<LightBounds>, kBuckets>;

void add(std::optional<LightBounds>& to, const LightBounds& b) {
  to = to ? united(*to, b) : b;
}

// Replaces `best` by the best split between two buckets along this axis, if that is better. The factor
// `elongation`, the largest extent of the set over its extent along this axis, makes splits that yield thin
// boxes more expensive.
void improve(Split& best, const Buckets& buckets, int axis, double elongation) {
  Buckets suffix = buckets;
  for (size_t k = kBuckets - 1; k-- > 0;)
    if (suffix[k + 1]) add(suffix[k], *suffix[k + 1]);
  std::optional<LightBounds> prefix;
  for (size_t k = 0; k + 1 < kBuckets; ++k) {
    if (buckets[k]) add(prefix, *buckets[k]);
    if (!prefix || !suffix[k + 1]) continue;
    const double c = elongation * (cost(*prefix) + cost(*suffix[k + 1]));
    if (c < best.cost) best = {c, axis, k};
  }
}

// Whether p is nearer to the box than half the box's diagonal.
bool is_near(const Bounds3& box, const Point3& p) {
  const Vector3 to_box = p - glm::clamp(p, box.min, box.max);
  return 4 * length_squared(to_box) < length_squared(box.diagonal());
}

}  // namespace

LightTree::LightTree(const std::vector<Light>& lights) : trails_(lights.size()) {
  std::vector<Item> items;
  for (uint32_t i = 0; i < lights.size(); ++i)
    if (const auto b = bounds_of(lights[i]); b && b->phi > 0) items.push_back({*b, i});
  if (items.empty()) return;
  nodes_.reserve(2 * items.size());
  nodes_.emplace_back();
  build(0, items.data(), items.data() + items.size(), {0, 0});
}

// The recursion is as deep as the tree, at most 64.
void LightTree::build(uint32_t node, Item* begin, Item* end, Trail trail) {
  if (end - begin == 1) {
    nodes_[node] = {begin->bounds, begin->light, true};
    trails_[begin->light] = trail;
    return;
  }
  Item* const middle = split(begin, end, trail.depth);
  const auto first = static_cast<uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  const uint64_t right = trail.turns | uint64_t{1} << trail.depth;
  build(first, begin, middle, {trail.turns, trail.depth + 1});
  build(first + 1, middle, end, {right, trail.depth + 1});
  nodes_[node] = {united(nodes_[first].bounds, nodes_[first + 1].bounds), first, false};
}

// Splits the set into halves at the median along its longest axis; lights at the same position are ordered by
// index.
LightTree::Item* LightTree::halve(Item* begin, Item* end, const Vector3& extent) {
  const int axis = extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);
  Item* const middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end, [&](const Item& a, const Item& b) {
    const float x = a.bounds.box.center()[axis], y = b.bounds.box.center()[axis];
    return x != y ? x < y : a.light < b.light;
  });
  return middle;
}

// Splits the set where the sum of both costs is smallest, by buckets along each axis.
LightTree::Item* LightTree::split(Item* begin, Item* end, uint32_t depth) {
  Bounds3 centers;
  for (const Item* i = begin; i < end; ++i) centers.add(i->bounds.box.center());
  const Vector3 extent = centers.diagonal();
  const auto bucket_of = [&](const Item& i, int axis) {
    const float at = (i.bounds.box.center()[axis] - centers.min[axis]) / extent[axis];
    // Not a number where the extent is beyond the range of floats.
    return at > 0 ? std::min<size_t>(kBuckets - 1, static_cast<size_t>(std::min(at, 1.0f) * kBuckets)) : 0;
  };
  Split best;
  for (int axis = 0; axis < 3 && depth < kDeepestChosenSplit; ++axis) {
    if (!(extent[axis] > 0)) continue;
    Buckets buckets;
    for (const Item* i = begin; i < end; ++i) add(buckets[bucket_of(*i, axis)], i->bounds);
    improve(best, buckets, axis, double(max_component(extent) / extent[axis]));
  }
  if (best.axis < 0) return halve(begin, end, extent);
  return std::partition(begin, end, [&](const Item& i) { return bucket_of(i, best.axis) <= best.bucket; });
}

std::optional<float> LightTree::left_share(const Node& node, const LightReceiver& x) const {
  const float left = nodes_[node.first_child].bounds.importance(x);
  const float right = nodes_[node.first_child + 1].bounds.importance(x);
  if (!(left + right > 0)) return std::nullopt;
  return left / (left + right);
}

std::optional<LightTree::Choice> LightTree::choose(const LightReceiver& x, float u) const {
  if (nodes_.empty() || !(nodes_[0].bounds.importance(x) > 0)) return std::nullopt;
  const Node* node = &nodes_[0];
  float probability = 1;
  while (!node->leaf) {
    const auto left = left_share(*node, x);
    if (!left) return std::nullopt;
    const bool goes_left = u < *left;
    u = goes_left ? u / *left : (u - *left) / (1 - *left);
    u = std::min(u, kOneMinusEpsilon);
    probability *= goes_left ? *left : 1 - *left;
    node = &nodes_[node->first_child + (goes_left ? 0 : 1)];
  }
  return Choice{node->first_child, probability, u};
}

float LightTree::probability(const LightReceiver& x, uint32_t light) const {
  const Trail& trail = trails_[light];
  if (trail.depth == kNotThere || !(nodes_[0].bounds.importance(x) > 0)) return 0;
  const Node* node = &nodes_[0];
  float probability = 1;
  for (uint32_t d = 0; d < trail.depth; ++d) {
    const auto left = left_share(*node, x);
    if (!left) return 0;
    const bool goes_right = trail.turns >> d & 1;
    probability *= goes_right ? 1 - *left : *left;
    node = &nodes_[node->first_child + (goes_right ? 1 : 0)];
  }
  return probability;
}

bool LightTree::any_near(const LightReceiver& x) const {
  if (nodes_.empty()) return false;
  // One entry a level waits, and the tree has at most 64 levels below its root.
  std::array<uint32_t, 65> waiting;
  size_t count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const Node& node = nodes_[waiting[--count]];
    // The box of a node holds those of its lights, so a light is only near where its nodes are.
    if (!is_near(node.bounds.box, x.p)) continue;
    if (!node.leaf) {
      waiting[count++] = node.first_child;
      waiting[count++] = node.first_child + 1;
    } else if (node.bounds.importance(x) > 0) {
      return true;
    }
  }
  return false;
}

}  // namespace kaustik
