// Tests --look-at, --fov, --sky and --floor, and what a model gets that comes alone.

#include "apps/import/view/view.h"

#include <cmath>
#include <fstream>

#include "apps/import/view/studio.h"
#include "tests/apps/import/gltf/gltf_support.h"

namespace kaustik::pbrt {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr std::string_view kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
constexpr std::string_view kPbrt =
    "Camera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\nShape \"sphere\"\n";

class SceneView : public ImportTest {
 protected:
  SceneDescription read(const std::string& name, std::string_view text, const ViewOptions& view = {}) {
    diagnostics_ = {};
    auto scene = import_scene(write(name, std::string(text)), diagnostics_, ImportOptions{.view = view});
    return scene ? std::move(*scene) : SceneDescription{};
  }
  SceneDescription obj(const ViewOptions& view = {}) { return read("a.obj", kObj, view); }
  std::string error(const std::string& name, std::string_view text, const ViewOptions& view) {
    read(name, text, view);
    EXPECT_EQ(diagnostics_.error_count(), 1u);
    return diagnostics_.format_all();
  }
};

std::vector<double> sky_colour(const SceneDescription& scene) {
  for (const LightDescription& light : scene.lights) {
    if (light.type == "infinite" && light.find("L")) return light.find("L")->numbers;
  }
  return {};
}

bool has_disk(const SceneDescription& scene) {
  return std::any_of(scene.shapes.begin(), scene.shapes.end(),
                     [](const auto& s) { return s.type == "disk"; });
}

TEST_F(SceneView, AModelAloneStandsInAStudio) {
  const SceneDescription scene = obj();
  EXPECT_TRUE(scene.camera);
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_TRUE(scene.lights[0].find("filename"));
  ASSERT_TRUE(has_disk(scene));
  // The floor lies below the lowest point, but not so far that the model would seem to float.
  const double y = scene.shapes.back().object_to_world[3].y;
  EXPECT_LT(y, 0);
  EXPECT_GT(y, -0.01);
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("no camera"));
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("studio"));
  Diagnostics again;
  EXPECT_TRUE(load_scene(write("a.obj", std::string(kObj)), again)) << again.format_all();
}

// The whole model is within the picture, and touches 80 % of its width or height, whatever its aspect ratio.
TEST_F(SceneView, TheModelFillsThePicture) {
  for (const double aspect : {0.5, 1.0, 2.0}) {
    ViewOptions view;
    view.aspect = aspect;
    const SceneDescription scene = obj(view);
    const glm::dmat4 to_camera = glm::inverse(scene.camera->camera_to_world);
    const double t = std::tan(glm::radians(kStudioFov / 2));
    double x = 0, y = 0;
    for (const glm::dvec3& p : {glm::dvec3(0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)}) {
      const glm::dvec3 c(to_camera * glm::dvec4(p, 1));
      ASSERT_GT(c.z, 0);
      x = std::max(x, std::abs(c.x) / (c.z * t * std::max(1.0, aspect)));
      y = std::max(y, std::abs(c.y) / (c.z * t * std::max(1.0, 1 / aspect)));
    }
    EXPECT_NEAR(std::max(x, y), 0.8, 1e-9) << aspect;
  }
}

// An open floor is as bright as the background: the irradiance is integrated here over directions of equal
// weight.
TEST_F(SceneView, NoEdgeOfTheStudioFloorShows) {
  const SceneDescription scene = obj();
  const double reflectance = scene.materials.back().find("reflectance")->numbers[0];
  double sum = 0;
  constexpr int kSide = 700;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {  // uniform over the hemisphere: y and azimuth
      const double up = (i + 0.5) / kSide, r = std::sqrt(1 - up * up), a = 2 * M_PI * (j + 0.5) / kSide;
      sum += studio_radiance({r * std::sin(a), up, r * std::cos(a)}) * up;
    }
  }
  const double irradiance = sum * 2 * M_PI / (kSide * kSide);
  // Both sums resolve the light, of 12 degrees, by more than thirty points across: 1 %.
  EXPECT_NEAR(reflectance * irradiance / M_PI, kStudioBackground, 0.01 * kStudioBackground);
  EXPECT_EQ(studio_radiance({0, 0, -1}), kStudioBackground);
}

TEST_F(SceneView, FloorAndSkyFollowTheOptions) {
  EXPECT_FALSE(has_disk(obj({.floor = Floor::kOff})));
  EXPECT_THAT(sky_colour(obj({.sky = "0.25,0.5,1"})), ElementsAre(0.25, 0.5, 1));
  EXPECT_THAT(sky_colour(obj({.sky = "#ffffff"})), ElementsAre(1, 1, 1));
  const SceneDescription dark = obj({.sky = "off"});
  EXPECT_THAT(dark.lights, IsEmpty());
  EXPECT_FALSE(has_disk(dark));
  EXPECT_TRUE(has_disk(obj({.sky = "off", .floor = Floor::kOn})));
  EXPECT_THAT(error("a.obj", kObj, {.sky = "nowhere.exr"}), HasSubstr("there is no file \"nowhere.exr\""));
}

TEST_F(SceneView, TheSkyOfAPbrtFileIsReplaced) {
  EXPECT_THAT(sky_colour(read("a.pbrt", kPbrt, {.sky = "2"})), ElementsAre(2, 2, 2));
  EXPECT_THAT(read("a.pbrt", kPbrt, {.sky = "off"}).lights, IsEmpty());
  EXPECT_THAT(error("a.pbrt", kPbrt, {.floor = Floor::kOn}), HasSubstr("--floor"));
}

// Seen from +z with +y up, +x points right in an OBJ's right-handed world and left in pbrt's.
TEST_F(SceneView, LookAtKeepsTheHandednessOfTheFormat) {
  const ViewOptions from_z{.look_at = {{0, 0, 9, 0, 0, 0, 0, 1, 0}}};
  const auto right_of = [](const SceneDescription& s) { return glm::dvec3(s.camera->camera_to_world[0]); };
  EXPECT_NEAR(right_of(obj(from_z)).x, 1, 1e-12);
  EXPECT_NEAR(right_of(read("a.pbrt", kPbrt, from_z)).x, -1, 1e-12);
  EXPECT_NEAR(right_of(read("b.pbrt", "Scale -1 1 1\n" + std::string(kPbrt), from_z)).x, 1, 1e-12);
  EXPECT_THAT(diagnostics_.format_all(), Not(HasSubstr("no camera")));
  EXPECT_THAT(error("a.obj", kObj, {.look_at = {{0, 0, 9, 0, 0, 0, 0, 0, 1}}}), HasSubstr("--look-at"));
}

class CameraOfGltf : public ImportGltf {
 protected:
  // Two cameras: the first has a name of its own, the node of the second has one.
  std::filesystem::path two_cameras() {
    return gltf(std::string(kTriangleParts) + R"("materials": [ {} ],
        "cameras": [ { "name": "front", "type": "perspective", "perspective": { "yfov": 0.5, "znear": 1 } },
                     { "type": "perspective", "perspective": { "yfov": 1, "znear": 1 } } ],
        "nodes": [ { "mesh": 0 }, { "camera": 0 }, { "name": "top", "camera": 1 } ])");
  }
  double fov(const std::string& camera) {
    diagnostics_ = {};
    const auto scene = import_scene(two_cameras(), diagnostics_, ImportOptions{.view = {.camera = camera}});
    return scene ? scene->camera->find("fov")->numbers[0] : 0;
  }
};

TEST_F(CameraOfGltf, IsChosenByNameOrNumber) {
  const double first = glm::degrees(0.5), second = glm::degrees(1.0);
  EXPECT_NEAR(fov(""), first, 1e-9);
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("2 cameras: the first is used"));
  EXPECT_NEAR(fov("top"), second, 1e-9);
  EXPECT_NEAR(fov("2"), second, 1e-9);
  EXPECT_NEAR(fov("front"), first, 1e-9);
  EXPECT_EQ(fov("frnt"), 0);
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("did you mean `front`"));
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("1 `front`, 2 `top`"));
  EXPECT_EQ(fov("3"), 0);
}

TEST_F(SceneView, FilesOfOtherFormatsHaveOneCamera) {
  EXPECT_TRUE(read("a.pbrt", kPbrt, {.camera = "1"}).camera);
  EXPECT_THAT(error("a.pbrt", kPbrt, {.camera = "2"}), HasSubstr("--camera 2"));
}

// A file that has a camera is a scene, whose surroundings are its own.
TEST_F(CameraOfGltf, KeepsTheStudioAway) {
  diagnostics_ = {};
  const auto scene = import_scene(two_cameras(), diagnostics_);
  ASSERT_TRUE(scene) << diagnostics_.format_all();
  EXPECT_THAT(sky_colour(*scene), ElementsAre(1, 1, 1));
  EXPECT_FALSE(has_disk(*scene));
}

TEST_F(SceneView, FovChangesPerspectiveCamerasOnly) {
  const SceneDescription scene = read("a.pbrt", kPbrt, {.fov = 25});
  EXPECT_THAT(scene.camera->find("fov")->numbers, ElementsAre(25));
  EXPECT_THAT(error("b.pbrt", "Camera \"orthographic\"\nWorldBegin\n", {.fov = 25}), HasSubstr("--fov"));
}

}  // namespace
}  // namespace kaustik::pbrt
