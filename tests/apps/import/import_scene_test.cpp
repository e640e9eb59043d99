// Tests the meaning of scenes: transforms, state, materials, lights, objects, files.
#include <numbers>

#include "apps/import/pbrt/transforms.h"
#include "tests/apps/import/import_support.h"

namespace kaustik::pbrt {
namespace {

class ImportScene : public ImportTest {
 protected:
  // The current transform after these directives.
  Transform ctm(const std::string& directives) {
    const Scene scene = world(directives + " Shape \"sphere\"");
    return std::get<Sphere>(scene.shapes.at(0).geometry).to_world;
  }
};

// Each coordinate went through one product and sum in double and one rounding to float.
void expect_near(const Vector3& a, const Vector3& b) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 4e-7f * std::max(1.0f, max_component(glm::abs(b))));
}

TEST_F(ImportScene, TransformsApplyLastFirst) {
  expect_near(ctm("Translate 1 2 3 Scale 2 2 2").point({1, 1, 1}), {3, 4, 5});
  expect_near(ctm("Scale 2 2 2 Translate 1 2 3").point({1, 1, 1}), {4, 6, 8});
  expect_near(ctm("Rotate 90 0 0 1").point({1, 0, 0}), {0, 1, 0});
  expect_near(ctm("Rotate 120 1 1 1").point({1, 2, 3}), {3, 1, 2});
  // The matrix is given column by column for column vectors: the last four numbers translate.
  expect_near(ctm("Transform [1 0 0 0  0 0 1 0  0 -1 0 0  5 6 7 1]").point({1, 2, 3}), {6, 3, 9});
  expect_near(ctm("Translate 9 9 9 Identity").point({1, 2, 3}), {1, 2, 3});
  expect_near(ctm("Translate 1 0 0 ConcatTransform [0 1 0 0  -1 0 0 0  0 0 1 0  0 0 0 1]").point({1, 0, 0}),
              {1, 1, 0});
  expect_near(
      ctm("Translate 1 0 0 CoordinateSystem \"a\" Translate 5 5 5 CoordSysTransform \"a\"").point({0, 0, 0}),
      {1, 0, 0});
  expect_near(ctm("Translate 1 0 0 CoordSysTransform \"world\"").point({0, 0, 0}), {0, 0, 0});
  expect_near(ctm("AttributeBegin Translate 1 0 0 AttributeEnd TransformBegin Scale 3 3 3 TransformEnd")
                  .point({1, 0, 0}),
              {1, 0, 0});
}

TEST_F(ImportScene, QuarterTurnsAreExact) {
  const Transform t = ctm("Rotate -90 0 1 0 Rotate 180 1 0 0 Rotate 450 0 0 1");
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) EXPECT_TRUE(t.linear[c][r] == 0 || std::abs(t.linear[c][r]) == 1);
  }
}

TEST_F(ImportScene, CameraLooksAlongPositiveZInALeftHandedSpace) {
  const auto camera = [&](const std::string& directives) {
    return load(directives +
                " Camera \"perspective\" \"float fov\" 90 Film \"rgb\" \"integer xresolution\" 200 "
                "\"integer yresolution\" 100 WorldBegin")
        .scene.camera;
  };
  // From (0, 0, -5) along +z, right is +x and up is +y.
  const Camera c = camera("LookAt 0 0 -5  0 0 0  0 1 0");
  EXPECT_EQ(c.width, 200);
  EXPECT_EQ(std::get<PerspectiveProjection>(c.projection).fov_degrees, 90);
  expect_near(c.to_world.translation, {0, 0, -5});
  expect_near(c.generate_ray({100, 50}).d, {0, 0, 1});
  // The shorter side has half the angle 45 degrees, so the right edge is at tan = 2.
  expect_near(c.generate_ray({200, 50}).d, glm::normalize(Vector3(2, 0, 1)));
  expect_near(c.generate_ray({100, 0}).d, glm::normalize(Vector3(0, 1, 1)));
  // When the camera looks along -z, right is -x.
  expect_near(camera("LookAt 0 0 5  0 0 0  0 1 0").generate_ray({200, 50}).d,
              glm::normalize(Vector3(-2, 0, -1)));
  // A flip before LookAt mirrors the picture, and so does one after it.
  expect_near(camera("Scale -1 1 1 LookAt 0 0 5  0 0 0  0 1 0").generate_ray({200, 50}).d,
              glm::normalize(Vector3(2, 0, -1)));
  expect_near(camera("LookAt 0 0 5  0 0 0  0 1 0 Scale -1 1 1").generate_ray({200, 50}).d,
              glm::normalize(Vector3(2, 0, -1)));
  // The matrix takes the world to the camera: z is turned, and the camera is at z = 6.8, y = 1.
  const Camera m = camera("Transform [1 0 0 0  0 1 0 0  0 0 -1 0  0 -1 6.8 1]");
  expect_near(m.to_world.translation, {0, 1, 6.8f});
  expect_near(m.generate_ray({100, 50}).d, {0, 0, -1});
}

TEST_F(ImportScene, CameraSpaceIsKept) {
  const Scene scene =
      load(
          "LookAt 1 2 3  1 2 9  0 1 0\nCamera \"perspective\"\nWorldBegin\nCoordSysTransform \"camera\"\n"
          "Shape \"sphere\"")
          .scene;
  expect_near(std::get<Sphere>(scene.shapes.at(0).geometry).to_world.point({0, 0, 2}), {1, 2, 5});
}

TEST_F(ImportScene, ScreenWindowAndFrameAreRead) {
  const Scene frame = load("Camera \"perspective\" \"float frameaspectratio\" 2 WorldBegin").scene;
  EXPECT_EQ(frame.camera.screen_window, glm::vec4(-2, 2, -1, 1));
  const Scene window = load("Camera \"perspective\" \"float screenwindow\" [-1 2 -3 4] WorldBegin").scene;
  EXPECT_EQ(window.camera.screen_window, glm::vec4(-1, 2, -3, 4));
}

TEST_F(ImportScene, SettingsAreKeptWithTheirLocations) {
  const SceneDescription d =
      load(
          "Integrator \"anything\" \"integer photons\" [ 1000000 ]\nSampler \"halton\" \"integer "
          "pixelsamples\" 3\nOption \"integer seed\" 3 Option \"disablepixeljitter\" false\n"
          "ColorSpace \"srgb\" PixelFilter \"box\" Accelerator \"bvh\" WorldBegin")
          .description;
  ASSERT_TRUE(d.integrator && d.sampler);
  const Parameter* p = d.integrator->find("photons");
  ASSERT_TRUE(p);
  EXPECT_EQ(p->numbers, std::vector<double>{1000000});
  EXPECT_EQ(p->value_location(0).line, 1u);
  EXPECT_EQ(p->value_location(0).column, 43u);
  EXPECT_EQ(d.sampler->find("pixelsamples")->numbers[0], 3);
}

TEST_F(ImportScene, MaterialsAreBuilt) {
  const Scene s = world(R"(
    Shape "sphere"
    Material "diffuse" "rgb reflectance" [.1 .2 .3] Shape "sphere"
    Material "orennayar" "rgb reflectance" [.1 .2 .3] "float sigma" 20 Shape "sphere"
    Material "dielectric" "float eta" 1.25 "float roughness" 0 Shape "sphere"
    Material "conductor" "rgb eta" [1 2 3] "float k" 4 Shape "sphere"
    Material "mirror" "rgb reflectance" [.9 .8 .7] Shape "sphere"
    Material "conductor" "rgb reflectance" [.5 0 1] Shape "sphere"
    NamedMaterial "later" Shape "sphere"
    MakeNamedMaterial "later" "string type" "mirror"
    Material "interface" Shape "sphere")");
  ASSERT_EQ(s.shapes.size(), 8u);
  const auto bsdf = [&](size_t i) { return s.materials[s.shapes[i].material].typical(); };
  EXPECT_EQ(std::get<Lambertian>(bsdf(0)).reflectance, Rgb(.5f));
  EXPECT_EQ(std::get<Lambertian>(bsdf(1)).reflectance, Rgb(.1f, .2f, .3f));
  EXPECT_EQ(std::get<OrenNayar>(bsdf(2)).A, OrenNayar::from_sigma_degrees(Rgb(0), 20).A);
  EXPECT_EQ(std::get<Dielectric>(bsdf(3)).eta, 1.25f);
  EXPECT_EQ(std::get<Conductor>(bsdf(4)).eta, Rgb(1, 2, 3));
  EXPECT_EQ(std::get<Conductor>(bsdf(4)).k, Rgb(4));
  EXPECT_EQ(std::get<Mirror>(bsdf(5)).reflectance, Rgb(.9f, .8f, .7f));
  EXPECT_EQ(s.material_names[s.shapes[7].material], "later");
  // At normal incidence ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2) gives the reflectance back; 1 is clamped to
  // 0.9999.
  const Conductor metal = std::get<Conductor>(bsdf(6));
  EXPECT_EQ(metal.eta, Rgb(1));
  const Rgb k2 = metal.k * metal.k;
  expect_near(k2 / (Rgb(4) + k2), {.5f, 0, .9999f});
}

TEST_F(ImportScene, GraphicsStateEndsWithItsBlock) {
  const Scene s = world(R"(
    AttributeBegin
      AreaLightSource "diffuse" Material "mirror" ReverseOrientation Attribute "shape" "float radius" 3
      Shape "sphere"
      Shape "sphere" "float radius" 5
    AttributeEnd
    Shape "sphere")");
  const auto radius = [&](size_t i) { return std::get<Sphere>(s.shapes[i].geometry).to_world.linear[0][0]; };
  EXPECT_EQ(radius(0), 3);
  EXPECT_EQ(radius(1), 5);
  EXPECT_EQ(radius(2), 1);
  EXPECT_TRUE(s.shapes[0].flip_normal);
  EXPECT_FALSE(s.shapes[2].flip_normal);
  EXPECT_NE(s.shapes[0].light, kNoIndex);
  EXPECT_EQ(s.shapes[2].light, kNoIndex);
  EXPECT_TRUE(is_specular(s.materials[s.shapes[0].material].typical()));
  EXPECT_FALSE(is_specular(s.materials[s.shapes[2].material].typical()));
}

TEST_F(ImportScene, LightsAreBuilt) {
  const Scene s = world(R"(
    Translate 1 0 0
    LightSource "point" "rgb I" [1 2 3] "float scale" 2 "point3 from" [0 5 0]
    LightSource "spot" "point3 from" [0 0 1] "point3 to" [0 -3 1] "float coneangle" 60 "float conedeltaangle" 15
    LightSource "distant" "point3 from" [0 2 0] "rgb L" [1 1 1]
    LightSource "infinite" "rgb L" [.1 .2 .3])");
  ASSERT_EQ(s.lights.size(), 4u);
  const auto& point = std::get<PointLight>(s.lights[0]);
  EXPECT_EQ(point.position, Point3(1, 5, 0));
  EXPECT_EQ(point.I, Rgb(2, 4, 6));
  const auto& spot = std::get<SpotLight>(s.lights[1]);
  EXPECT_EQ(spot.position, Point3(1, 0, 1));
  EXPECT_EQ(spot.frame.z, Vector3(0, -1, 0));
  EXPECT_NEAR(spot.cos_total_width, 0.5f, 1e-7f);
  EXPECT_NEAR(spot.cos_falloff_start, std::numbers::sqrt2_v<float> / 2, 1e-7f);
  expect_near(std::get<DistantLight>(s.lights[2]).to_light, glm::normalize(Vector3(0, 2, -1)));
  EXPECT_EQ(s.infinite_lights, std::vector<uint32_t>{3});
}

// `power` is that of a white light; colours multiply it, as in pbrt-v4.
TEST_F(ImportScene, PowerIsTheLuminanceOfTheWhiteLightsFlux) {
  const Scene s = world(R"(
    LightSource "point" "rgb I" [1 2 3] "float power" 7
    LightSource "spot" "rgb I" [3 2 1] "float power" 7 "float scale" 2
    LightSource "distant" "rgb L" [3 2 1] "float illuminance" 7
    LightSource "infinite" "rgb L" [3 2 1] "float illuminance" 7
    AreaLightSource "diffuse" "rgb L" [5 4 3] "float power" 7 "bool twosided" true
    Scale 2 2 2
    Shape "disk" Shape "sphere"
    Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0 1 1 0] "integer indices" [0 1 2 1 3 2])");
  const auto emitted = [&](size_t i) { return luminance(power(s.lights[i])); };
  // Each value is rounded fewer than 32 times by 2^-24.
  constexpr float kRelative = 32 * 0x1p-24f;
  const float up = 7 * luminance({1, 2, 3}), down = 7 * luminance({3, 2, 1}),
              light = 7 * luminance({5, 4, 3});
  EXPECT_NEAR(emitted(0), up, up * kRelative);
  EXPECT_NEAR(emitted(1), 2 * down, 2 * down * kRelative);
  EXPECT_NEAR(luminance(std::get<DistantLight>(s.lights[2]).L), down, down * kRelative);
  EXPECT_NEAR(kPi * luminance(std::get<InfiniteLight>(s.lights[3]).L), down, down * kRelative);
  for (size_t i = 4; i < 7; ++i) EXPECT_NEAR(emitted(i), light, light * kRelative) << i;
  EXPECT_TRUE(std::get<DiffuseAreaLight>(s.lights[4]).twosided);
}

TEST_F(ImportScene, InstancesArePlacedByTheirTransforms) {
  const Scene s = world(R"(
    ObjectBegin "pair"
      Translate 1 0 0
      AreaLightSource "diffuse"
      Shape "sphere"
      Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0]
    ObjectEnd
    Scale 2 2 2
    ObjectInstance "pair"
    Scale -1 1 1
    ObjectInstance "pair")");
  ASSERT_EQ(s.shapes.size(), 4u);
  EXPECT_TRUE(s.lights.empty());  // there is a warning, as in pbrt
  EXPECT_EQ(diagnostics_.warning_count(), 2u);
  EXPECT_EQ(std::get<Sphere>(s.shapes[0].geometry).to_world.translation, Vector3(2, 0, 0));
  EXPECT_EQ(std::get<Sphere>(s.shapes[2].geometry).to_world.translation, Vector3(-2, 0, 0));
  const auto& mesh = std::get<TriangleMesh>(s.shapes[3].geometry);
  EXPECT_EQ(mesh.P, (std::vector<Point3>{{-2, 0, 0}, {-4, 0, 0}, {-2, 2, 0}}));
  EXPECT_FALSE(s.shapes[1].flip_normal);
  EXPECT_TRUE(s.shapes[3].flip_normal);  // the mirrored transform turns the cross product over
}

TEST_F(ImportScene, IncludeAndImportReadFiles) {
  write("sub/a.pbrt", "Translate 1 0 0 Material \"mirror\" Include \"b.pbrt\" Include \"root.pbrt\"");
  write("sub/b.pbrt", "Shape \"sphere\"");
  write("root.pbrt", "Shape \"disk\"");
  const Scene s = world("Include \"sub/a.pbrt\" Shape \"sphere\" Import \"sub/a.pbrt\" Shape \"sphere\"");
  ASSERT_EQ(s.shapes.size(), 6u);
  const auto x = [&](size_t i) {
    const auto* sphere = std::get_if<Sphere>(&s.shapes[i].geometry);
    return (sphere ? sphere->to_world : std::get<Disk>(s.shapes[i].geometry).to_world).translation.x;
  };
  EXPECT_EQ((std::vector<float>{x(0), x(1), x(2), x(3), x(4), x(5)}), (std::vector<float>{1, 1, 1, 2, 2, 1}));
  EXPECT_TRUE(is_specular(s.materials[s.shapes[2].material].typical()));  // Include keeps the graphics state
}

TEST_F(ImportScene, MirroredQuadricsKeepTheirOutside) {
  const Scene s = world(R"(
    Shape "disk" "float radius" 4 "float innerradius" 1 "float height" 3
    Scale -1 1 1
    Shape "sphere" "float radius" 2 "float zmin" -2 "float zmax" 3 "float phimax" 360
    ReverseOrientation
    Shape "sphere")");
  const auto& disk = std::get<Disk>(s.shapes[0].geometry);
  EXPECT_EQ(disk.inner, 0.25f);
  EXPECT_EQ(disk.to_world.point({1, 0, 0}), Point3(4, 0, 3));
  EXPECT_FALSE(s.shapes[1].flip_normal);  // a mirrored sphere keeps its outside
  EXPECT_TRUE(s.shapes[2].flip_normal);
}

TEST_F(ImportScene, NormalsFollowTheTransform) {
  const Scene s = world(R"(
    Scale 1 2 1 ReverseOrientation
    Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0] "normal N" [1 1 0  0 0 3  0 0 0] "point2 uv" [0 0 1 0 0 1])");
  const auto& mesh = std::get<TriangleMesh>(s.shapes[0].geometry);
  expect_near(mesh.N[0], -glm::normalize(Vector3(1, 0.5f, 0)));
  EXPECT_EQ(mesh.N[1], Normal3(0, 0, -1));
  EXPECT_EQ(mesh.N[2], Normal3(0));
  EXPECT_EQ(mesh.uv[1], Point2(1, 0));
}

TEST_F(ImportScene, SurfaceGroupsHaveNames) {
  const Scene s = world(
      "Shape \"sphere\" \"string surfacegroup\" \"a\"\nShape \"disk\" \"string surfacegroup\" \"a\"\n"
      "Shape \"disk\"\n");
  ASSERT_EQ(s.surface_group_names.size(), 2u);
  EXPECT_EQ(s.surface_group_names[0], "a");
  EXPECT_EQ(s.surface_group_names[1], "disk at " + (folder_ / "scene.pbrt").string() + ":4");
}

TEST_F(ImportScene, CarriageReturnsCommentsAndByteOrderMarkAreSkipped) {
  const Scene s = load(
                      "\xef\xbb\xbf# Shape\r\nWorldBegin # Shape "
                      "\"sphere\"\r\nShape\r\n\"sphere\"#x\r\n\"float radius\"[2]\r\n")
                      .scene;
  EXPECT_EQ(s.shapes.size(), 1u);
}

// Rounding must not make a camera look projective: projective matrices are refused.
TEST(Transforms, InversesOfAffineMapsAreAffine) {
  for (int i = 1; i <= 1000; ++i) {
    const double t = 0.37 * i;
    const auto view =
        look_at({std::sin(t), std::cos(3 * t), std::sin(5 * t), 3, 2 + std::sin(t), 4, 0, 1, 0});
    const glm::dmat4 m = inverse_transform(scale({-7, 7, 7}) * *view);
    for (int c = 0; c < 4; ++c) EXPECT_EQ(m[c][3], c == 3 ? 1 : 0) << i;
  }
}

}  // namespace
}  // namespace kaustik::pbrt
