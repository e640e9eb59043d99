// Tests instances that share a mesh against copies of the mesh.

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "core/geometry/boundary_edges.h"
#include "core/scene/shapes/shape_source.h"
#include "photon/shoot/shoot.h"
#include "tests/accel/support/random_scenes.h"
#include "tests/render/support/test_scenes.h"

namespace kaustik::test {
namespace {

enum class Placing { kShared, kCopied };

// A box under a light with bumpy balls in it, as instances or as copies of one mesh; one is mirrored, one
// scaled unevenly.
Scene balls(Placing placing, double scale = 1) {
  Scene scene = cornell(32, float(scale));
  TriangleMesh mesh = test::icosphere(3);
  for (const Point3& p : mesh.P) mesh.N.push_back(p);
  const uint32_t glass = add_material(scene, Dielectric{1.5f});
  const glm::dvec3 places[] = {{-0.5, 0.3, 0.4}, {0.1, 0.9, -0.3}, {0.5, 1.2, -0.4}};
  const glm::dvec3 sizes[] = {{0.25, 0.25, 0.25}, {-0.2, 0.2, 0.2}, {0.15, 0.25, 0.2}};
  const SharedMesh shared = share_mesh({mesh, glm::dmat4(1)}, false);
  for (int i = 0; i < 3; ++i) {
    const glm::dmat4 m = glm::scale(glm::dmat4(1), glm::dvec3(scale)) *
                         glm::scale(glm::translate(glm::dmat4(1), places[i]), sizes[i]);
    PlacedShape placed = placing == Placing::kShared ? place_instance(shared, m, false)
                                                     : place_shape({mesh, glm::dmat4(1)}, m, false);
    EXPECT_TRUE(placed.finite);
    placed.shape.material = i == 1 ? glass : 0;
    add_shape(scene, std::move(placed.shape));
  }
  finalize_scene(scene);
  return scene;
}

// Rays meet the same points up to rounding, which sends only a few of them elsewhere: at silhouettes, and
// where the choice between reflection and refraction is close. Errors of p_error, 1e-5 of the box, move a
// silhouette by 1e-4 of a pixel, whose size is 1/16 of the box.
TEST(Instances, RenderLikeCopies) {
  RenderSettings settings;
  settings.method = Method::kMc;
  settings.spp = 4;
  const Film a = render_with_threads(balls(Placing::kShared), settings).film;
  const Film b = render_with_threads(balls(Placing::kCopied), settings).film;
  int same = 0, pixels = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x, ++pixels) {
      const Rgb difference = a.at(x, y).radiance() - b.at(x, y).radiance();
      same += glm::length(difference) <= 1e-3f * (1e-2f + glm::length(b.at(x, y).radiance()));
    }
  EXPECT_GT(same, pixels * 97 / 100);
}

TEST(Instances, StoreThePhotonsOfCopies) {
  std::vector<std::vector<uint64_t>> of_group;
  for (const Placing placing : {Placing::kShared, Placing::kCopied}) {
    const Scene scene = balls(placing);
    const accel::Bvh bvh(scene);
    photon::TraceSettings settings;
    settings.photons = 200'000;
    settings.kinds = {true, false, true, true};
    const auto result = photon::shoot(scene, bvh, settings);
    std::vector<uint64_t> counts(scene.shapes.size(), 0);
    for (const photon::PhotonBuffer& buffer : result.buffers)
      for (const auto& record : buffer.records) ++counts[photon::unpack(record, 1).surface_group];
    of_group.push_back(std::move(counts));
  }
  uint64_t total = 0, apart = 0;
  for (size_t g = 0; g < of_group[0].size(); ++g) {
    total += of_group[1][g];
    apart += uint64_t(std::abs(int64_t(of_group[0][g]) - int64_t(of_group[1][g])));
  }
  EXPECT_GT(of_group[0][of_group[0].size() - 3], 100u);
  EXPECT_LT(apart, total / 1000);  // photons at silhouettes
}

TEST(Instances, ScaleByPowersOfTwoExactly) {
  RenderSettings settings;
  settings.method = Method::kPhoton;
  settings.spp = 1;
  settings.photons = 20'000;
  const Film a = render_with_threads(balls(Placing::kShared), settings).film;
  const Film b = render_with_threads(balls(Placing::kShared, 0x1p-12), settings).film;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) ASSERT_EQ(a.at(x, y).radiance(), b.at(x, y).radiance());
}

// The boundary edges of an instance lie in the world.
TEST(Instances, HaveTheEdgesOfCopies) {
  TriangleMesh sheet;
  sheet.P = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.indices = {{0, 1, 2}, {0, 2, 3}};
  const SharedMesh shared = share_mesh({sheet, glm::dmat4(1)}, true);
  const glm::dmat4 m = glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(3, 4, 5)), glm::dvec3(-2, 1, 1));
  std::vector<Shape> instance{place_instance(shared, m, true).shape},
      copy{place_shape({sheet, glm::dmat4(1)}, m, true).shape};
  const auto ours = find_boundary_edges(instance), theirs = find_boundary_edges(copy);
  ASSERT_EQ(ours.size(), 4u);
  ASSERT_EQ(theirs.size(), 4u);
  for (const BoundaryEdge& e : ours) {
    EXPECT_EQ(e.n, Normal3(0, 0, -1));
    const bool found = std::any_of(theirs.begin(), theirs.end(), [&](const BoundaryEdge& o) {
      return glm::distance(o.outward, e.outward) < 1e-6f && glm::distance(o.a + o.b, e.a + e.b) < 1e-5f &&
             o.n == e.n && std::abs(o.height - e.height) < 1e-5f;
    });
    EXPECT_TRUE(found);
  }
}

}  // namespace
}  // namespace kaustik::test
