// Tests that photons and paths compute the same light, class by class, and that every path is counted once.

#include <gtest/gtest.h>

#include "tests/render/support/class_agreement.h"

namespace kaustik::render {
namespace {

using namespace test;

TEST(CornellAgreement, EachClassAgreesWithPaths) {
  const Scene scene = cornell(kSize);
  const auto by_paths = films(scene, settings_of(Method::kMc, 256, 0.1f, 100));
  for (const Method method : {Method::kPhoton, Method::kHybrid, Method::kAuto}) {
    const Comparison c(scene, by_paths, method, 0.1f);
    for (const Layer layer : {Layer::kDirect, Layer::kIndirect}) c.expect_agreement_everywhere(layer);
    // The noise of the paths is a sixth of the caustic light, so the tolerance may be larger.
    for (int block = -1; block < kSize / kBlock * (kSize / kBlock); ++block)
      c.expect_agreement(Layer::kCaustic, block, 1.0 / 3);
    c.write_pictures("cornell_" + std::to_string(int(method)));
  }
}

enum class Eye { kAbove, kBelow };

std::string_view name_of(Eye eye) {
  return eye == Eye::kAbove ? "above" : "below";
}

void PrintTo(Eye eye, std::ostream* out) {
  *out << name_of(eye);
}

// A wide pool: water of index 1.33 over a diffuse bottom, under a wide light. Radiance scales by eta^2 along
// camera paths, flux does not scale along photon paths: the classes agree only if both are right, for an eye
// above and one below the surface.
Scene pool(Eye looking_from) {
  Scene scene;
  const uint32_t white = add_material(scene, Lambertian{Rgb(0.6f)});
  const uint32_t black = add_material(scene, Lambertian{Rgb(0)});
  const uint32_t water = add_material(scene, Dielectric{1.33f});
  add_shape(scene, horizontal({0, 0, 0}, 2, 2, true, white));
  add_shape(scene, horizontal({0, 0.5f, 0}, 2, 2, true, water));
  make_light(scene, add_shape(scene, horizontal({0, 2, 0}, 1, 1, false, black)), Rgb(2));
  const Point3 eye = looking_from == Eye::kBelow ? Point3(0, 0.45f, 0.3f) : Point3(0.1f, 1.2f, 0.8f);
  look_at(scene, eye, {0, 0, 0}, {0, 1, 0}, 30, kSize, kSize);
  finalize_scene(scene);
  return scene;
}

class PoolAgreement : public ::testing::TestWithParam<Eye> {};

TEST_P(PoolAgreement, LightUnderWaterAgreesWithPaths) {
  const Scene scene = pool(GetParam());
  const auto by_paths = films(scene, settings_of(Method::kMc, 256, 0.1f, 100));
  const Comparison c(scene, by_paths, Method::kPhoton, 0.1f);
  c.expect_agreement_everywhere(Layer::kCaustic);
  c.expect_agreement(Layer::kIndirect, -1, 0.5);  // few of these photons reach the visible part
  c.write_pictures("pool_" + std::string(name_of(GetParam())));
}
INSTANTIATE_TEST_SUITE_P(Eyes, PoolAgreement, ::testing::Values(Eye::kAbove, Eye::kBelow));

// Every path is counted once, whichever estimators are chosen: the sum of the layers stays the same. The
// kernel's bias of each class is measured once, with all classes from photons.
TEST(OneOwner, SumDoesNotDependOnTheEstimators) {
  const Scene scene = cornell(kSize);
  const Estimate reference = total(films(scene, settings_of(Method::kMc, 256, 0.1f, 1)));
  const auto wide = films(scene, settings_of(Method::kPhoton, 16, 0.1f, 20));
  const auto narrow = films(scene, settings_of(Method::kPhoton, 16, 0.05f, 30));
  double bias = kPackedLight * reference.mean;
  for (const Layer layer : kClasses)
    bias += 2 * std::abs(block_estimate(wide, layer, -1).mean - block_estimate(narrow, layer, -1).mean);
  for (const RenderSettings& settings : with_all_estimators(settings_of(Method::kAuto, 32, 0.1f, 10))) {
    const Estimate found = total(films(scene, settings, 4));
    // With four and six seeds there are 8 degrees of freedom; 6 standard errors are exceeded once in 3000.
    const double noise = std::hypot(reference.standard_error, found.standard_error);
    EXPECT_NEAR(found.mean, reference.mean, 6 * noise + bias)
        << names_of_estimators(settings) << " noise " << noise << " bias " << bias;
    // The smallest class is a tenth of the sum, so counting it twice, or not at all, exceeds the tolerance.
    EXPECT_LT(6 * noise + bias, 0.1 * reference.mean);
  }
}

// Switching a class off removes exactly that class.
TEST(OneOwner, SwitchingAClassOffRemovesThatClassOnly) {
  const Scene scene = cornell(kSize);
  RenderSettings settings = settings_of(Method::kMc, 128, 0.1f, 1);
  const auto all = films(scene, settings);
  settings.caustics = CausticEstimator::kOff;
  settings.seed = 50;
  const auto without = films(scene, settings);
  EXPECT_EQ(block_estimate(without, Layer::kCaustic, -1).mean, 0);
  for (const Layer layer : {Layer::kDirect, Layer::kIndirect}) {
    const Estimate a = block_estimate(all, layer, -1), b = block_estimate(without, layer, -1);
    EXPECT_NEAR(a.mean, b.mean, kErrors * std::hypot(a.standard_error, b.standard_error));
  }
  settings.indirect = IndirectEstimator::kOff;
  EXPECT_EQ(block_estimate(films(scene, settings, 2), Layer::kIndirect, -1).mean, 0);
}

// The lecture's estimator answers each shading point once, by photons or by a fallback.
TEST(Lecture, CountsEveryShadingPointOnce) {
  const Scene scene = cornell_with_table(kSize);
  RenderSettings settings = settings_of(Method::kHybrid, 4, 0.05f, 1);
  settings.indirect = IndirectEstimator::kOff;
  const auto result = render_with_threads(scene, settings);
  const LectureCounters& l = result.statistics.lecture;
  const uint64_t answers = l.from_photons + l.fallback_few + l.fallback_shadow + l.fallback_face;
  // The box is closed, and only total internal reflection makes specular chains longer than the limit, so
  // nearly every camera ray ends at a diffuse point; at glass each ray continues as two.
  EXPECT_LE(answers, result.statistics.rays.camera + result.statistics.rays.specular / 2);
  EXPECT_GT(answers, result.statistics.rays.camera * 99 / 100);
  EXPECT_GT(l.from_photons, 0u);
  EXPECT_GT(l.fallback_shadow, 0u);
  // A fallback takes at most one shadow ray, and none where the light lies behind the surface.
  EXPECT_LE(result.statistics.rays.shadow, answers - l.from_photons);
  EXPECT_GT(result.statistics.rays.shadow, 0u);
}

}  // namespace
}  // namespace kaustik::render
