// Tests the scenes of the two source documents: the lecture's program (hybrid) and the report's (photon)
// agree with the reference (mc) class by class. Tests light under waves too, where radiance and flux scale
// differently and normals are interpolated.

#include <gtest/gtest.h>

#include "tests/render/support/class_agreement.h"
#include "tests/render/support/scene_files.h"
#include "tests/render/support/wave_scene.h"

namespace kaustik::test {
namespace {

Scene document_scene(const std::string& file) {
  Scene scene = scene_from(file);
  scene.camera.width = scene.camera.height = kSize;
  scene.camera.set_default_screen_window();
  return scene;
}

// spp: samples of the paths, enough to keep their noise small against the light.
void expect_programs_agree_with_paths(const Scene& scene, int spp, float radius, const std::string& name) {
  const auto by_paths = films(scene, settings_of(Method::kMc, spp, radius, 100));
  for (const Method method : {Method::kHybrid, Method::kPhoton}) {
    const Comparison c(scene, by_paths, method, radius);
    for (const Layer layer : kClasses) c.expect_agreement_everywhere(layer);
    c.write_pictures(name + "_" + std::to_string(int(method)));
  }
}

TEST(DocumentScenes, LectureRoomAgreesWithPaths) {
  expect_programs_agree_with_paths(document_scene("tncg15-room/tncg15-room.pbrt"), 512, 0.3f, "lecture");
}

TEST(DocumentScenes, ReportSquareLightAgreesWithPaths) {
  expect_programs_agree_with_paths(document_scene("cornell-spheres/square-lamp-2.pbrt"), 256, 0.06f,
                                   "report");
}

// Paths cannot meet a point light through glass. So the direct class is compared with shadow rays, and the
// other classes of the two photon programs with each other: paths that query the caustic map against indirect
// photons.
TEST(DocumentScenes, ReportPointLightsAgree) {
  for (const char* name : {"point-lamp", "square-lamp-1"}) {
    const Scene scene = document_scene("cornell-spheres/" + std::string(name) + ".pbrt");
    const auto by_paths = films(scene, settings_of(Method::kHybrid, 256, 0.03f, 100));
    const Comparison c(scene, by_paths, Method::kPhoton, 0.06f);
    c.expect_agreement_everywhere(Layer::kIndirect);
    const auto by_rays = films(scene, settings_of(Method::kRaytrace, 64, 0.06f, 100));
    const Comparison direct(scene, by_rays, Method::kPhoton, 0.06f);
    direct.expect_agreement_everywhere(Layer::kDirect);
    c.write_pictures(name);
  }
}

// With eta 1.8 and a wide light radiance scales by eta^2 below the water, flux does not, and photons need
// Veach's correction for interpolated normals.
TEST(DocumentScenes, LightUnderWavesByPhotonsAgreesWithPaths) {
  const Scene scene = wave_scene(kSize);
  const auto by_paths = films(scene, settings_of(Method::kMc, 256, 0.06f, 100));
  const Comparison c(scene, by_paths, Method::kPhoton, 0.06f);
  for (const Layer layer : {Layer::kCaustic, Layer::kIndirect}) c.expect_agreement_everywhere(layer);
  c.write_pictures("waves");
}

}  // namespace
}  // namespace kaustik::test
