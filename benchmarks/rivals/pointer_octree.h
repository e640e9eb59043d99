#pragma once
// The lecture's octree: nodes with pointers to eight children, built by inserting the photons one after the
// other; a leaf splits when it holds more than N0 photons. Serial.

#include <array>
#include <memory>

#include "benchmarks/photon_index.h"
#include "benchmarks/rivals/plain_photon.h"

namespace kaustik::benchmarks {

class PointerOctree {
 public:
  static constexpr std::string_view kName = "pointer octree";

  static PointerOctree build(photon::PhotonBuffer&& buffer, float /*radius*/) {
    PointerOctree tree;
    const Bounds3 bounds = bounds_of(buffer);
    if (bounds.empty()) return tree;
    tree.root_ = std::make_unique<Node>();
    tree.root_->centre = bounds.center();
    tree.root_->half = 0.5f * max_component(bounds.diagonal());
    for (const photon::PhotonRecord& r : buffer.records) {
      tree.root_->insert(plain_photon(r, buffer.flux_unit), 0);
    }
    return tree;
  }

  Rgb flux_density(const photon::GatherQuery& query, photon::GatherCounters& counters) const {
    return summed_flux_density(*this, query, counters);
  }

  template <class Fn>
  void for_each(const photon::GatherQuery& query, photon::GatherCounters& counters, Fn&& fn) const {
    ++counters.queries;
    if (!root_) return;
    const Vector3 reach(box_reach(query.radius));
    root_->for_each(query.p - reach, query.p + reach, Acceptance(query), counters, fn);
  }

  uint64_t memory_bytes() const { return root_ ? root_->memory_bytes() : 0; }

 private:
  static constexpr size_t kNodePhotons = 32;  // N0: the fastest of 8, 16, 32, 64 for 50 and 500 in reach
  static constexpr int kMaxDepth = 21;        // limits the depth for photons in one point

  struct Node {
    Point3 centre;
    float half;  // half of the side
    bool leaf = true;
    std::array<std::unique_ptr<Node>, 8> children;
    std::vector<PlainPhoton> photons;  // only in leaves

    void insert(const PlainPhoton& photon, int depth) {
      if (!leaf) return child_at(photon.p).insert(photon, depth + 1);
      photons.push_back(photon);
      if (photons.size() <= kNodePhotons || depth == kMaxDepth) return;
      leaf = false;
      const std::vector<PlainPhoton> held = std::exchange(photons, {});
      for (const PlainPhoton& p : held) child_at(p.p).insert(p, depth + 1);
    }

    // The child on p's side of the centre; created when missing.
    Node& child_at(const Point3& p) {
      const glm::bvec3 high = glm::greaterThanEqual(p, centre);
      std::unique_ptr<Node>& child = children[(high.x ? 1 : 0) | (high.y ? 2 : 0) | (high.z ? 4 : 0)];
      if (!child) {
        child = std::make_unique<Node>();
        child->half = 0.5f * half;
        child->centre = centre + child->half * (2.0f * Vector3(high) - 1.0f);
      }
      return *child;
    }

    // Compares boxes in the way insert() compares points, so rounding loses no photon.
    template <class Fn>
    void for_each(const Point3& low, const Point3& high, const Acceptance& counts,
                  photon::GatherCounters& counters, Fn& fn) const {
      counters.candidates += photons.size();
      for (const PlainPhoton& photon : photons) {
        if (!counts(photon)) continue;
        ++counters.accepted;
        fn(photon.flux);
      }
      if (leaf) return;
      for (int i = 0; i < 8; ++i) {
        if (!children[size_t(i)]) continue;
        bool meets = true;
        for (int axis = 0; axis < 3; ++axis) {
          meets &= i >> axis & 1 ? high[axis] >= centre[axis] : low[axis] < centre[axis];
        }
        if (meets) children[size_t(i)]->for_each(low, high, counts, counters, fn);
      }
    }

    uint64_t memory_bytes() const {
      uint64_t bytes = sizeof(Node) + photons.capacity() * sizeof(PlainPhoton);
      for (const auto& child : children) bytes += child ? child->memory_bytes() : 0;
      return bytes;
    }
  };

  std::unique_ptr<Node> root_;
};
static_assert(PhotonIndex<PointerOctree>);

}  // namespace kaustik::benchmarks
