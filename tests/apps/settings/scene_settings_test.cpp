#include "apps/settings/scene_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kaustik::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

Parameter numbers(ParameterType type, std::string name, std::vector<double> values) {
  Parameter parameter;
  parameter.type = type;
  parameter.name = std::move(name);
  parameter.location = {0, 3, 12};
  parameter.numbers = std::move(values);
  parameter.value_places.assign(parameter.numbers.size(), {3, 30});
  return parameter;
}
Parameter integer(std::string name, double value) {
  return numbers(ParameterType::kInteger, std::move(name), {value});
}
Parameter real(std::string name, double value) {
  return numbers(ParameterType::kFloat, std::move(name), {value});
}
Parameter text(std::string name, std::vector<std::string> values) {
  Parameter parameter = numbers(ParameterType::kString, std::move(name), {});
  parameter.strings = std::move(values);
  parameter.value_places.assign(parameter.strings.size(), {3, 30});
  return parameter;
}
Directive directive(std::string type, std::vector<Parameter> parameters) {
  Directive d;
  d.type = std::move(type);
  d.location = {0, 3, 1};
  d.type_location = {0, 3, 12};
  d.parameters = std::move(parameters);
  return d;
}

struct Interpreted {
  SceneSettings scene;
  DiagnosticList diagnostics;
};
Interpreted interpret(const SceneDescription& description) {
  Interpreted result;
  result.scene = settings_from_scene(description, result.diagnostics);
  return result;
}
Interpreted with_integrator(std::string type, std::vector<Parameter> parameters) {
  SceneDescription description;
  description.integrator = directive(std::move(type), std::move(parameters));
  return interpret(description);
}

TEST(SceneSettings, EmptySceneHasTheDefaults) {
  const Interpreted result = interpret({});
  EXPECT_THAT(result.diagnostics.entries(), IsEmpty());
  EXPECT_EQ(result.scene.settings.render.method, render::Method::kAuto);
  EXPECT_EQ(result.scene.settings.render.spp, Settings{}.render.spp);
  EXPECT_EQ(result.scene.output, "");
}

TEST(SceneSettings, PhotonmapTakesEverySettingByItsName) {
  const Interpreted result =
      with_integrator("photonmap", {text("method", {"photon"}), integer("photons", 3e9), real("radius", 0.25),
                                    text("kernel", {"cone"}), real("conek", 1.5), integer("min-photons", 4),
                                    integer("maxbounces", 3), text("aov", {"direct", "depth"}),
                                    numbers(ParameterType::kInteger, "crop", {0, 4, 2, 8}),
                                    real("exposure", 1), text("seed", {"7"})});
  EXPECT_THAT(result.diagnostics.entries(), IsEmpty());
  const render::RenderSettings& s = result.scene.settings.render;
  EXPECT_EQ(s.method, render::Method::kPhoton);
  EXPECT_EQ(s.photons, 3'000'000'000u);
  EXPECT_EQ(s.radius, 0.25f);
  EXPECT_EQ(s.kernel, render::Kernel::kCone);
  EXPECT_EQ(s.cone_k, 1.5f);
  EXPECT_EQ(s.min_photons, 4u);
  EXPECT_EQ(s.max_bounces, 3);
  EXPECT_THAT(s.aov, ::testing::ElementsAre("direct", "depth"));
  EXPECT_EQ(s.crop.y1, 8);
  EXPECT_EQ(s.seed, 7u);
  EXPECT_EQ(result.scene.settings.tone.exposure, 1);
}

TEST(SceneSettings, PhotonmapErrorsHaveALocationAndSuggestTheNearestName) {
  const Interpreted result = with_integrator(
      "photonmap", {text("kernal", {"cone"}), text("kernel", {"cones"}), real("photons", 1000),
                    integer("spp", 0), numbers(ParameterType::kInteger, "crop", {0, 4})});
  const std::vector<Diagnostic>& found = result.diagnostics.entries();
  ASSERT_THAT(found, SizeIs(5));
  EXPECT_EQ(result.diagnostics.error_count(), 5u);
  EXPECT_THAT(found[0].message, HasSubstr("did you mean `kernel`"));
  EXPECT_EQ(found[0].location.column, 12u);
  EXPECT_THAT(found[1].message, HasSubstr("did you mean `cone`"));
  EXPECT_EQ(found[1].location.column, 30u);
  EXPECT_THAT(found[2].message, HasSubstr("is of type integer, not float"));
  EXPECT_THAT(found[3].message, HasSubstr("`0`"));
  EXPECT_THAT(found[4].message, HasSubstr("takes 4 values, not 2"));
}

TEST(SceneSettings, SppmGivesMethodPhotonWithItsDepthCountAndRadius) {
  const Interpreted result = with_integrator(
      "sppm", {integer("maxdepth", 9), integer("photonsperiteration", 5e6), real("radius", 0.05)});
  EXPECT_THAT(result.diagnostics.entries(), IsEmpty());
  const render::RenderSettings& s = result.scene.settings.render;
  EXPECT_EQ(s.direct, render::DirectEstimator::kShadowRays);
  EXPECT_EQ(s.caustics, render::CausticEstimator::kPhotons);
  EXPECT_EQ(s.indirect, render::IndirectEstimator::kPhotons);
  EXPECT_EQ(s.max_bounces, 9);
  EXPECT_EQ(s.photons, 5'000'000u);
  EXPECT_EQ(s.radius, 0.05f);
  EXPECT_THAT(result.scene.notes, SizeIs(1));
}

TEST(SceneSettings, SppmWithoutParametersUsesPbrtsDepthAndOurOtherDefaults) {
  const Interpreted result = with_integrator("sppm", {integer("photonsperiteration", -1)});
  EXPECT_THAT(result.diagnostics.entries(), IsEmpty());
  EXPECT_EQ(result.scene.settings.render.max_bounces, 5);
  EXPECT_EQ(result.scene.settings.render.photons, Settings{}.render.photons);
  EXPECT_EQ(result.scene.settings.render.radius, std::nullopt);
}

TEST(SceneSettings, OtherIntegratorsOfPbrtGiveAutoWithTheirDepth) {
  for (const char* name : {"path", "volpath", "bdpt", "mlt", "directlighting", "whitted"}) {
    const Interpreted result = with_integrator(name, {integer("maxdepth", 65)});
    EXPECT_THAT(result.diagnostics.entries(), IsEmpty()) << name;
    EXPECT_EQ(result.scene.settings.render.method, render::Method::kAuto) << name;
    EXPECT_EQ(result.scene.settings.render.max_bounces, 65) << name;
    ASSERT_THAT(result.scene.notes, SizeIs(1)) << name;
    EXPECT_THAT(result.scene.notes[0], AllOf(HasSubstr(name), HasSubstr("auto"), HasSubstr("65")));
  }
  EXPECT_EQ(with_integrator("path", {}).scene.settings.render.max_bounces, 5);
}

TEST(SceneSettings, AnUnknownIntegratorIsAWarningThatNamesTheNearest) {
  const Interpreted unknown = with_integrator("photonmp", {integer("maxdepth", 3)});
  EXPECT_EQ(unknown.diagnostics.error_count(), 0u);
  ASSERT_EQ(unknown.diagnostics.warning_count(), 1u);
  EXPECT_THAT(unknown.diagnostics.entries()[0].message, HasSubstr("did you mean `photonmap`"));
  EXPECT_EQ(unknown.scene.settings.render.method, render::Method::kAuto);
}

TEST(SceneSettings, ParametersOfPbrtThatAreNotReadGiveOneWarningEach) {
  const Interpreted result = with_integrator("path", {text("lightsampler", {"bvh"}), integer("maxdept", 5)});
  EXPECT_EQ(result.diagnostics.error_count(), 0u);
  ASSERT_EQ(result.diagnostics.warning_count(), 2u);
  EXPECT_THAT(result.diagnostics.entries()[1].message, HasSubstr("did you mean `maxdepth`"));
}

TEST(SceneSettings, FilmAndSamplerSetSizeCropOutputAndSamples) {
  SceneDescription description;
  description.film = directive("rgb", {integer("xresolution", 200), integer("yresolution", 100),
                                       numbers(ParameterType::kFloat, "cropwindow", {0.25, 0.5, 0, 0.105}),
                                       text("filename", {"picture.exr"})});
  description.sampler = directive("halton", {integer("pixelsamples", 64)});
  const Interpreted result = interpret(description);
  EXPECT_THAT(result.diagnostics.entries(), IsEmpty());
  EXPECT_EQ(result.scene.width, 200);
  EXPECT_EQ(result.scene.height, 100);
  EXPECT_EQ(result.scene.output, "picture.exr");
  EXPECT_EQ(result.scene.settings.render.spp, 64);
  const render::CropWindow& crop = result.scene.settings.render.crop;
  EXPECT_EQ(crop.x0, 50);
  EXPECT_EQ(crop.x1, 100);
  EXPECT_EQ(crop.y0, 0);
  EXPECT_EQ(crop.y1, 11);  // rounded up, as in pbrt
}

TEST(SceneSettings, InvalidFilmsAndSamplersAreErrors) {
  SceneDescription description;
  description.film = directive("rgb", {integer("xresolution", 0), integer("yresolution", 1e6),
                                       numbers(ParameterType::kInteger, "pixelbounds", {9, 9, 0, 5})});
  description.sampler = directive("independent", {integer("pixelsamples", 0)});
  EXPECT_EQ(interpret(description).diagnostics.error_count(), 4u);
}

}  // namespace
}  // namespace kaustik::app
