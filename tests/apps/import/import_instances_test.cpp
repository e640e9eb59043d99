// Tests object instances and partial quadrics in scene files.
#include "tests/apps/import/import_support.h"

namespace kaustik::pbrt {
namespace {

class ImportInstances : public ImportTest {};

const std::string kOctahedron =
    "\"point3 P\" [1 0 0 -1 0 0 0 1 0 0 -1 0 0 0 1 0 0 -1] "
    "\"integer indices\" [0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5]";

TEST_F(ImportInstances, LargeMeshesAreSharedAndGroupsAreNot) {
  const Scene s = world("ObjectBegin \"a\" Shape \"loopsubdiv\" \"integer levels\" 6 " + kOctahedron +
                        " \"string surfacegroup\" \"ball\" Shape \"sphere\" \"string surfacegroup\" \"ball\" "
                        "ObjectEnd Scale -1 1 1 ObjectInstance \"a\" Translate 0 0 4 ObjectInstance \"a\" "
                        "Translate 0 0 4 ObjectInstance \"a\"");
  ASSERT_EQ(s.shapes.size(), 6u);
  const auto& first = std::get<InstancedMesh>(s.shapes[0].geometry);
  EXPECT_EQ(first.mesh->indices.size(), 8u << 12);
  for (size_t i = 0; i < 6; i += 2) {
    const auto& instance = std::get<InstancedMesh>(s.shapes[i].geometry);
    EXPECT_EQ(instance.mesh, first.mesh);
    EXPECT_EQ(instance.to_world.translation, Vector3(0, 0, 2 * float(i)));
    // A group's name joins the shapes of one instance, but not those of different instances.
    EXPECT_EQ(s.shapes[i].surface_group, i / 2);
    EXPECT_EQ(s.shapes[i + 1].surface_group, i / 2);
    EXPECT_FALSE(s.shapes[i].flip_normal);
  }
  EXPECT_TRUE(std::holds_alternative<Sphere>(s.shapes[1].geometry));
}

TEST_F(ImportInstances, SmallMeshesAreCopied) {
  const Scene s = world("ObjectBegin \"a\" Shape \"loopsubdiv\" \"integer levels\" 0 " + kOctahedron +
                        " ObjectEnd ObjectInstance \"a\" ObjectInstance \"a\"");
  ASSERT_EQ(s.shapes.size(), 2u);
  for (const Shape& shape : s.shapes) EXPECT_TRUE(std::holds_alternative<TriangleMesh>(shape.geometry));
}

TEST_F(ImportInstances, PartialShapesBecomeQuadrics) {
  const Scene s = world(
      "Shape \"sphere\" \"float radius\" 2 \"float zmin\" -1 \"float phimax\" 180 "
      "Shape \"cylinder\" \"float radius\" 0.5 \"float zmin\" 0 \"float zmax\" 3 "
      "Shape \"disk\" \"float radius\" 2 \"float innerradius\" 1 \"float phimax\" 90 "
      "Shape \"sphere\" \"float zmin\" -7 \"float zmax\" 7");
  ASSERT_EQ(s.shapes.size(), 4u);
  const auto& sphere = std::get<Quadric>(s.shapes[0].geometry);
  EXPECT_EQ(sphere.kind, QuadricKind::kSphere);
  EXPECT_EQ(sphere.z_min, -0.5f);
  EXPECT_EQ(sphere.z_max, 1);
  EXPECT_FLOAT_EQ(sphere.phi_max, kPi);
  EXPECT_NEAR(surface_area(s.shapes[0]), std::numbers::pi * 2 * 3, 1e-4);  // phi r (zmax - zmin)
  const auto& cylinder = std::get<Quadric>(s.shapes[1].geometry);
  EXPECT_EQ(cylinder.kind, QuadricKind::kCylinder);
  EXPECT_NEAR(surface_area(s.shapes[1]), 2 * std::numbers::pi * 0.5 * 3, 1e-4);
  EXPECT_NEAR(surface_area(s.shapes[2]), 0.25 * std::numbers::pi * (4 - 1), 1e-4);
  EXPECT_TRUE(std::holds_alternative<Sphere>(s.shapes[3].geometry));
}

TEST_F(ImportInstances, EitherEndOfQuadricsMayComeFirst) {
  const Scene s = world(R"(Shape "cylinder" "float zmin" 2 "float zmax" 1
    Shape "sphere" "float zmin" 0.5 "float zmax" -0.25)");
  const auto &cylinder = std::get<Quadric>(s.shapes[0].geometry),
             &sphere = std::get<Quadric>(s.shapes[1].geometry);
  EXPECT_EQ(cylinder.z_min, 1);
  EXPECT_EQ(cylinder.z_max, 2);
  EXPECT_EQ(sphere.z_min, -0.25f);
  EXPECT_EQ(sphere.z_max, 0.5f);
}

TEST_F(ImportInstances, EmptyPartsOfShapesAreErrors) {
  EXPECT_EQ(first_lines("Shape \"cylinder\" \"float zmin\" 2 \"float zmax\" 2"),
            "2:31: error: no part of the cylinder lies between `zmin` = 2 and `zmax` = 2\n");
  EXPECT_EQ(first_lines("Shape \"sphere\" \"float phimax\" 0"),
            "2:31: error: `phimax` of shape \"sphere\" must be > 0 and <= 360, not 0\n");
  EXPECT_EQ(first_lines("AreaLightSource \"diffuse\" Scale 1 2 1 Shape \"cylinder\"")
                    .find("a sphere or cylinder") != std::string::npos,
            true);
}

TEST_F(ImportInstances, CamerasAndFiltersAreRead) {
  const auto camera = [&](const std::string& text) { return load(text + " WorldBegin").scene.camera; };
  const Camera lens = camera("Camera \"perspective\" \"float lensradius\" 0.1 \"float focaldistance\" 3");
  EXPECT_EQ(lens.lens_radius(), 0.1f);
  EXPECT_EQ(std::get<PerspectiveProjection>(lens.projection).lens.focal_distance, 3);
  EXPECT_TRUE(lens.filter.is_pixel_box());
  EXPECT_TRUE(std::holds_alternative<OrthographicProjection>(camera("Camera \"orthographic\"").projection));
  const Camera sphere = camera("Camera \"spherical\" \"string mapping\" \"equirectangular\"");
  EXPECT_EQ(std::get<SphericalProjection>(sphere.projection).mapping, SphericalMapping::kEquirectangular);
  for (const std::string name : {"gaussian", "triangle", "mitchell", "sinc"})
    EXPECT_FALSE(camera("PixelFilter \"" + name + "\"").filter.is_pixel_box()) << name;
  EXPECT_TRUE(camera("PixelFilter \"box\"").filter.is_pixel_box());
  messages("Camera \"spherical\" \"string mapping\" \"equalaera\" WorldBegin");
  EXPECT_EQ(diagnostics_.entries().at(0).message,
            "unknown mapping \"equalaera\"; did you mean `equalarea`? known: equalarea, equirectangular");
  messages("PixelFilter \"gaussian\" \"float sigma\" 1e30 WorldBegin");
  EXPECT_EQ(diagnostics_.entries().at(0).message, "the integral of this pixel filter is not positive");
}

}  // namespace
}  // namespace kaustik::pbrt
