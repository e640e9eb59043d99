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
  float margin = 0;  // by which the box grows where it is compared with faces of other groups
  const Face* face = nullptr;
};

// Whether the boxes come within `gap` of each other along every axis.
inline bool meet(const Bounds3& a, const Bounds3& b, float gap) {
  return a.min.x - b.max.x <= gap && b.min.x - a.max.x <= gap && a.min.y - b.max.y <= gap &&
         b.min.y - a.max.y <= gap && a.min.z - b.max.z <= gap && b.min.z - a.max.z <= gap;
}

// Immutable after construction; const members may be called from any thread.
class FaceTree {
 public:
  explicit FaceTree(std::vector<BoxedFace> faces);

  // Calls visit(const Face&) for the faces other than `of` whose boxes meet its own, grown by both margins in
  // another group, and whose normals bend away by more than kBendOfOthers or, in its group, kBendOfOwn.
  // Returns how many boxes of faces were compared.
  template <class Visit>
  uint64_t for_each_bent(const BoxedFace& of, const Visit& visit) const {
    if (faces_.empty()) return 0;
    uint64_t compared = 0;
    std::array<uint32_t, kDeepest> waiting;
    waiting[0] = 0;
    for (size_t count = 1; count > 0;) {
      const uint32_t at = waiting[--count];
      const Node& node = nodes_[at];
      const bool own = node.one_group && node.group == of.face->group;
      if (!meet(node.box, of.box, own ? 0 : node.margin + of.margin)) continue;
      if (node.bends_too_little(*of.face, own)) continue;
      if (node.begin == node.end) {
        waiting[count++] = 2 * at + 2;
        waiting[count++] = 2 * at + 1;
        continue;
      }
      compared += node.end - node.begin;
      for (uint32_t i = node.begin; i < node.end; ++i)
        if (faces_[i].face != of.face && is_bent(faces_[i], of)) visit(*faces_[i].face);
    }
    return compared;
  }

 private:
  static constexpr uint32_t kFacesOfLeaf = 4;
  static constexpr size_t kDeepest = 64;

  static float limit_of(bool same_group) { return same_group ? kBendOfOwn : kBendOfOthers; }
  static bool is_bent(const BoxedFace& a, const BoxedFace& b) {
    const bool own = a.face->group == b.face->group;
    return meet(a.box, b.box, own ? 0 : a.margin + b.margin) &&
           std::abs(glm::dot(a.face->n, b.face->n)) <= limit_of(own);
  }

  // Nodes lie as in a binary heap: the children of i are 2 i + 1 and 2 i + 2.
  struct Node {
    Bounds3 box;
    float margin = 0;             // the largest of its faces
    uint32_t begin = 0, end = 0;  // faces of a leaf; the same for others
    // All normals, up to their signs, lie within this angle of the axis.
    Normal3 axis{0, 0, 1};
    float cos_angle = 1, sin_angle = 0;
    uint32_t group = 0;
    bool one_group = true;

    // Whether no face here bends away from this one by enough: dense smooth meshes are mostly patches of
    // which that holds. own: all faces here are of its group.
    bool bends_too_little(const Face& face, bool own) const {
      const float c = std::abs(glm::dot(face.n, axis));
      const float sum = c * cos_angle - std::sqrt(std::max(1 - c * c, 0.0f)) * sin_angle;
      constexpr float kRounding = 1e-5f;
      return sum > limit_of(own) + kRounding;
    }
  };

  void build(size_t at, uint32_t begin, uint32_t end);
  Node node_of(uint32_t begin, uint32_t end) const;

  std::vector<BoxedFace> faces_;  // in the order of the leaves
  std::vector<Node> nodes_;
};

}  // namespace kaustik::accel
