// Pairs of triangles found by the tree of boxes, against a comparison of each with each.

#include "accel/face_tree.h"

#include <gtest/gtest.h>

#include <set>

#include "core/geometry/triangle_bounds.h"
#include "core/sampling/sampler.h"

namespace kaustik::accel {
namespace {

// Triangles in random places of a cube, with random normals near those of a few groups, so that neither boxes
// nor normals alone decide.
std::vector<Face> random_faces(int count) {
  Sampler sampler(7, 0);
  const auto random = [&] { return Vector3(sampler.next_1d(), sampler.next_1d(), sampler.next_1d()); };
  std::vector<Face> faces;
  for (int i = 0; i < count; ++i) {
    Face face;
    const Point3 p = random();
    const float size = i % 50 == 0 ? 1 : 0.1f;
    face.group = uint32_t(p.x * 4);
    const float flat = face.group % 2 == 0 ? 0.2f : 1;
    for (Point3& corner : face.P) corner = p + size * (random() - 0.5f) * Vector3(1, 1, flat);
    face.n = triangle_normal(face.P[1] - face.P[0], face.P[2] - face.P[0]);
    if (face.n != Normal3(0)) faces.push_back(face);
  }
  return faces;
}

BoxedFace boxed(const Face& face, float margin) {
  BoxedFace boxed{{}, margin, &face};
  for (const Point3& p : face.P) boxed.box.add(p);
  return boxed;
}

bool is_bent(const BoxedFace& a, const BoxedFace& b) {
  const bool own = a.face->group == b.face->group;
  const float gap = own ? 0 : a.margin + b.margin;
  for (int k = 0; k < 3; ++k)
    if (a.box.min[k] - b.box.max[k] > gap || b.box.min[k] - a.box.max[k] > gap) return false;
  return std::abs(glm::dot(a.face->n, b.face->n)) <= (own ? kBendOfOwn : kBendOfOthers);
}

TEST(FaceTree, FindsThePairsThatEachWithEachFinds) {
  for (const int count : {0, 1, 4, 5, 999}) {
    const std::vector<Face> faces = random_faces(count);
    std::vector<BoxedFace> all;
    for (const Face& face : faces) all.push_back(boxed(face, all.size() % 3 == 0 ? 0.05f : 0));
    const FaceTree tree(all);
    uint64_t compared = 0, pairs = 0;
    for (const BoxedFace& a : all) {
      std::multiset<const Face*> expected, found;
      for (const BoxedFace& b : all)
        if (a.face != b.face && is_bent(a, b)) expected.insert(b.face);
      compared += tree.for_each_bent(a, [&](const Face& face) { found.insert(&face); });
      EXPECT_EQ(found, expected);
      pairs += expected.size();
    }
    EXPECT_GE(compared, pairs);
    if (count == 999) {
      EXPECT_GT(pairs, 1000u);
      EXPECT_LT(compared, faces.size() * faces.size() / 2);
    }
  }
}

}  // namespace
}  // namespace kaustik::accel
