#include "accel/face_tree.h"

#include <algorithm>
#include <cmath>

#include "core/parallel/parallel.h"

namespace kaustik::accel {

namespace {

constexpr uint32_t kWorthThreads = 4096;  // faces

Point3 twice_center(const BoxedFace& face) {
  return face.box.min + face.box.max;
}

// The axis in which the centers are spread farthest.
int widest_axis(const BoxedFace* begin, const BoxedFace* end) {
  Bounds3 centers;
  for (const BoxedFace* face = begin; face != end; ++face) centers.add(twice_center(*face));
  return largest_axis(centers.max - centers.min);
}

}  // namespace

FaceTree::FaceTree(std::vector<BoxedFace> faces) : faces_(std::move(faces)) {
  if (faces_.empty()) return;
  // Every range of a level has the same number of faces or one more.
  size_t levels = 1;
  for (size_t most = faces_.size(); most > kFacesOfLeaf; most = (most + 1) / 2) ++levels;
  nodes_.resize((size_t{1} << levels) - 1);
  build(0, 0, uint32_t(faces_.size()));
}

FaceTree::Node FaceTree::node_of(uint32_t begin, uint32_t end) const {
  Node node;
  node.axis = faces_[begin].face->n, node.group = faces_[begin].face->group;
  for (uint32_t i = begin; i < end; ++i) {
    node.box.add(faces_[i].box);
    node.margin = std::max(node.margin, faces_[i].margin);
    node.one_group = node.one_group && faces_[i].face->group == node.group;
    node.cos_angle = std::min(node.cos_angle, std::abs(glm::dot(faces_[i].face->n, node.axis)));
  }
  node.sin_angle = std::sqrt(std::max(1 - node.cos_angle * node.cos_angle, 0.0f));
  return node;
}

// Splits at the median.
void FaceTree::build(size_t at, uint32_t begin, uint32_t end) {
  nodes_[at] = node_of(begin, end);
  if (end - begin <= kFacesOfLeaf) {
    nodes_[at].begin = begin, nodes_[at].end = end;
    return;
  }
  const uint32_t middle = begin + (end - begin) / 2;
  const int axis = widest_axis(faces_.data() + begin, faces_.data() + end);
  std::nth_element(faces_.begin() + begin, faces_.begin() + middle, faces_.begin() + end,
                   [axis](const BoxedFace& a, const BoxedFace& b) {
                     return twice_center(a)[axis] < twice_center(b)[axis];
                   });
  const auto low = [&] { build(2 * at + 1, begin, middle); };
  const auto high = [&] { build(2 * at + 2, middle, end); };
  if (end - begin > kWorthThreads) {
    parallel::invoke(low, high);
  } else {
    low();
    high();
  }
}

}  // namespace kaustik::accel
