// Tests PLY and STL files that are a scene by themselves.

#include <cstring>

#include "tests/apps/import/obj/obj_support.h"

namespace kaustik::pbrt {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

class ImportLoneMesh : public ObjTest {
 protected:
  SceneDescription mesh(const std::string& name, const std::string& bytes) {
    diagnostics_ = Diagnostics();
    auto scene = import_scene(write(name, bytes), diagnostics_, kWithoutFloor);
    EXPECT_TRUE(scene) << said();
    return scene ? std::move(*scene) : SceneDescription{};
  }
  std::string error_of(const std::string& name, const std::string& bytes) {
    diagnostics_ = Diagnostics();
    EXPECT_FALSE(import_scene(write(name, bytes), diagnostics_, kWithoutFloor));
    EXPECT_EQ(diagnostics_.error_count(), 1u);
    return said();
  }
  // A binary STL file of two triangles of the unit square.
  static std::string square(uint32_t promised = 2) {
    std::string bytes = "solid, though binary";
    bytes.resize(80);
    const auto append = [&](const auto& value) {
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    append(promised);
    const float corners[2][9] = {{0, 0, 0, 1, 0, 0, 1, 1, 0}, {0, 0, 0, 1, 1, 0, -0.0f, 1, 0}};
    for (const auto& triangle : corners) {
      for (const float n : {0.0f, 0.0f, 1.0f}) append(n);
      append(triangle);
      append(uint16_t{0});
    }
    return bytes;
  }
};

TEST_F(ImportLoneMesh, PlyIsAScene) {
  const auto s =
      mesh("a.PLY",
           "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
           "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
  ASSERT_THAT(s.shapes, SizeIs(1));
  EXPECT_THAT(numbers(s.shapes[0], "indices"), ElementsAre(0, 1, 2, 0, 2, 3));
  EXPECT_TRUE(s.camera);
  EXPECT_FALSE(s.lights.empty());
  EXPECT_TRUE(load_scene(folder_ / "a.PLY", diagnostics_)) << said();
}

TEST_F(ImportLoneMesh, PlyShowsTheColoursOfItsVertices) {
  const auto s = mesh("a.ply",
                      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                      "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                      "0 0 0 255 0 0\n1 0 0 255 0 0\n1 1 0 255 0 0\n3 0 1 2\n");
  EXPECT_THAT(numbers(s.shapes.at(0), "Cd"), ElementsAre(1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1));
  EXPECT_THAT(s.materials, SizeIs(1));
  EXPECT_TRUE(load_scene(folder_ / "a.ply", diagnostics_)) << said();
}

TEST_F(ImportLoneMesh, BinaryStlIsAScene) {
  const auto s = mesh("a.stl", square());
  ASSERT_THAT(s.shapes, SizeIs(1));
  EXPECT_THAT(numbers(s.shapes[0], "P"), SizeIs(12)) << "equal corners are one vertex";
  EXPECT_THAT(numbers(s.shapes[0], "indices"), ElementsAre(0, 1, 2, 0, 2, 3));
  EXPECT_TRUE(load_scene(folder_ / "a.stl", diagnostics_)) << said();
}

TEST_F(ImportLoneMesh, AsciiStlIsAScene) {
  const auto s =
      mesh("a.stl",
           "solid a\nfacet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1e0 .0 0\n  vertex 0 1 0\n"
           " endloop\nendfacet\nendsolid a\n");
  EXPECT_THAT(corners(s.shapes.at(0)), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
}

TEST_F(ImportLoneMesh, DamagedMeshesAreRefused) {
  EXPECT_THAT(error_of("a.stl", square(1000)), HasSubstr("the file promises 1000 facets, but has 2"));
  EXPECT_THAT(error_of("a.stl", "short"), HasSubstr("ends within its header"));
  EXPECT_THAT(error_of("a.stl", "solid a\nfacet\nvertex 0 none 0\n"),
              HasSubstr("line 3: `none` is not a number"));
  EXPECT_THAT(error_of("a.stl", "solid a\nendsolid\n"), HasSubstr("there are no triangles"));
  EXPECT_THAT(error_of("a.ply", "ply\n"), HasSubstr("a.ply"));
}

}  // namespace
}  // namespace kaustik::pbrt
