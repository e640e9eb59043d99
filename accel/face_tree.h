#pragma once
// A tree of boxes over triangles that finds what may stand on a triangle.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/math/bounds.h"

namespace kaustik::accel {

// Cosines of the angles up to which two triangles count as one bent surface: of different surface groups, as
// where surfaces count as bent, and of the same one, whose photons beyond a smaller bend count
// (photon::kNormalCosine).
inline constexpr float kBendOfOthers = 0.9f, kBendOfOwn = 0.5f;

struct Face {
  std::array<Point3, 3> P;
  Normal3 n;  // unit
  uint32_t group = 0;
};

// A face with the box that stands for it. The face must outlive the tree.
struct BoxedFace {
  Bounds3 box;
  const Face* face = nullptr;
};

inline bool overlap(const Bounds3& a, const Bounds3& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y &&
         a.min.z <= b.max.z && b.min.z <= a.max.z;
}

// Immutable after construction; const members may be called from any thread.
class FaceTree {
 public:
  explicit FaceTree(std::vector<BoxedFace> faces);

  // Calls visit(const Face&) for the faces other than `of` whose boxes meet its own and whose normals bend
  // away by more than kBendOfOthers or, in its group, kBendOfOwn. Returns how many boxes of faces were
  // compared.
  template <class Visit>
  uint64_t for_each_bent(const BoxedFace& of, const Visit& visit) const {
    if (faces_.empty()) return 0;
    uint64_t compared = 0;
    std::array<uint32_t, kDeepest> waiting;
    waiting[0] = 0;
    for (size_t count = 1; count > 0;) {
      const uint32_t at = waiting[--count];
      const Node& node = nodes_[at];
      if (!overlap(node.box, of.box) || node.bends_too_little(*of.face)) continue;
      if (node.begin == node.end) {
        waiting[count++] = 2 * at + 2;
        waiting[count++] = 2 * at + 1;
        continue;
      }
      compared += node.end - node.begin;
      for (uint32_t i = node.begin; i < node.end; ++i)
        if (const BoxedFace& other = faces_[i]; other.face != of.face && overlap(other.box, of.box))
          if (std::abs(glm::dot(other.face->n, of.face->n)) <= limit_of(other.face->group == of.face->group))
            visit(*other.face);
    }
    return compared;
  }

 private:
  static constexpr uint32_t kFacesOfLeaf = 4;
  static constexpr size_t kDeepest = 64;

  static float limit_of(bool same_group) { return same_group ? kBendOfOwn : kBendOfOthers; }

  // Nodes lie as in a binary heap: the children of i are 2 i + 1 and 2 i + 2.
  struct Node {
    Bounds3 box;
    uint32_t begin = 0, end = 0;  // faces of a leaf; the same for others
    // All normals, up to their signs, lie within this angle of the axis.
    Normal3 axis{0, 0, 1};
    float cos_angle = 1, sin_angle = 0;
    uint32_t group = 0;
    bool one_group = true;

    // Whether no face here bends away from this one by enough: dense smooth meshes are mostly patches of
    // which that holds.
    bool bends_too_little(const Face& face) const {
      const float c = std::abs(glm::dot(face.n, axis));
      const float sum = c * cos_angle - std::sqrt(std::max(1 - c * c, 0.0f)) * sin_angle;
      constexpr float kRounding = 1e-5f;
      return sum > limit_of(one_group && face.group == group) + kRounding;
    }
  };

  void build(size_t at, uint32_t begin, uint32_t end);
  Node node_of(uint32_t begin, uint32_t end) const;

  std::vector<BoxedFace> faces_;  // in the order of the leaves
  std::vector<Node> nodes_;
};

}  // namespace kaustik::accel
