#include "apps/sweep/sweep_grid.h"

#include <gmock/gmock.h>

#include "apps/console/exit_error.h"
#include "apps/sweep/sweep_result.h"

namespace kaustik::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::string refusal(const GridTexts& texts) {
  try {
    parse_grid(texts);
  } catch (const ExitError& error) {
    EXPECT_EQ(error.code(), kBadCommandLine);
    return error.what();
  }
  return "accepted";
}

TEST(SweepGrid, ReadsEveryForm) {
  const SweepGrid grid = parse_grid({.photons = {"100k", "1M"},
                                     .radii = {"auto", "0.5x", "0.011"},
                                     .methods = {"photon", "mc"},
                                     .spp = {"4", "16"},
                                     .seeds = "3"});
  EXPECT_THAT(grid.photons, ElementsAre(100'000u, 1'000'000u));
  EXPECT_THAT(grid.radii,
              ElementsAre(RadiusChoice{}, RadiusChoice{std::nullopt, 0.5f}, RadiusChoice{0.011f, 1}));
  EXPECT_THAT(grid.methods, ElementsAre(render::Method::kPhoton, render::Method::kMc));
  EXPECT_THAT(grid.spp, ElementsAre(4, 16));
  EXPECT_EQ(grid.seeds, 3u);
}

TEST(SweepGrid, ShownRadiiParseToTheSameRadii) {
  for (const char* text : {"auto", "0.5x", "2x", "0.011", "1e-07"}) {
    const RadiusChoice radius = parse_radius(text).value();
    EXPECT_EQ(radius.text(), text);
    Settings settings;
    radius.apply(settings);
    EXPECT_EQ(RadiusChoice::of(settings), radius);
  }
}

TEST(SweepGrid, RefusesInvalidGrids) {
  EXPECT_THAT(refusal({.photons = {}}), HasSubstr("--photons: expected at least one"));
  EXPECT_THAT(refusal({.photons = {""}}), HasSubstr("--photons: ``"));
  EXPECT_THAT(refusal({.photons = {"0"}}), HasSubstr("--photons: `0`: expected a whole number, 1 to"));
  EXPECT_THAT(refusal({.photons = {"-5"}}), HasSubstr("--photons: `-5`"));
  EXPECT_THAT(refusal({.photons = {"1M", "1000k"}}), HasSubstr("`1000k` is given twice"));
  EXPECT_THAT(refusal({.radii = {}}), HasSubstr("--radius: expected at least one"));
  EXPECT_THAT(refusal({.radii = {"auto", "1x"}}), HasSubstr("`1x` is given twice"));
  for (const char* text : {"0", "-1", "x", "0x", "nan", "infx", "autox", ""})
    EXPECT_THAT(refusal({.radii = {text}}), HasSubstr("expected auto, a multiple of it")) << text;
  EXPECT_THAT(refusal({.methods = {"photons"}}),
              HasSubstr("unknown method `photons`; did you mean `photon`?"));
  EXPECT_THAT(refusal({.methods = {"mc", "mc"}}), HasSubstr("given twice"));
  EXPECT_THAT(refusal({.spp = {"0"}}), HasSubstr("--spp: `0`"));
  EXPECT_THAT(refusal({.seeds = "0"}), HasSubstr("--seeds: `0`"));
}

SceneNeeds glass() {
  SceneNeeds needs;
  needs.specular = needs.diffuse = needs.any_light = true;
  return needs;
}

// A method without photons has one point for each sample count, whatever photons and radii there are.
TEST(SweepGrid, MethodsWithoutPhotonsIgnorePhotonsAndRadii) {
  const SweepGrid grid = parse_grid({.photons = {"1k", "2k"},
                                     .radii = {"auto", "2x"},
                                     .methods = {"mc", "photon"},
                                     .spp = {"1", "4"},
                                     .seeds = "1"});
  const auto points = points_of(grid, {}, {}, glass());
  ASSERT_THAT(points, SizeIs(2 + 2 * 4));
  EXPECT_EQ(flags_of(points[0], grid, {}), "--method mc --spp 1");
  EXPECT_EQ(flags_of(points[1], grid, {}), "--method mc --spp 4");
  EXPECT_EQ(flags_of(points[2], grid, {}), "--method photon --photons 1k --radius auto --spp 1");
  EXPECT_EQ(flags_of(points[9], grid, {}), "--method photon --photons 2k --radius 2x --spp 4");
}

TEST(SweepGrid, WithoutMethodsTheScenesEstimatorsApply) {
  Settings base;
  base.render.method = render::Method::kMc;
  base.render.indirect = render::IndirectEstimator::kPhotons;
  base.render.spp = 7;
  const SweepGrid grid = parse_grid({.photons = {"1k"}, .radii = {"auto"}});
  const auto points = points_of(grid, base, {}, glass());
  ASSERT_THAT(points, SizeIs(1));
  EXPECT_EQ(flags_of(points[0], grid, {}), "--photons 1k --radius auto");
  const Settings at = settings_at(points[0], grid, base, {});
  EXPECT_EQ(at.render.indirect, render::IndirectEstimator::kPhotons);
  EXPECT_EQ(at.render.spp, 7);
  EXPECT_EQ(at.render.photons, 1000u);
  const SweepGrid named = parse_grid({.methods = {"mc"}});
  EXPECT_EQ(settings_at(points_of(named, base, {}, glass())[0], named, base, {}).render.indirect,
            std::nullopt);
}

// The flags of a single point include those given for all points.
TEST(SweepGrid, FlagsIncludeTheGivenSettings) {
  SettingOverrides overrides;
  overrides.add(*find_setting("width"), {"64"});
  overrides.add(*find_setting("direct"), {"signed"});
  overrides.add(*find_setting("crop"), {"0", "8", "2", "6"});
  Settings base;
  base.render.nearest = 5;  // set by the scene
  overrides.apply(base);
  const SweepGrid grid = parse_grid({.photons = {"1k"}, .radii = {"auto"}});
  const auto points = points_of(grid, base, overrides, glass());
  ASSERT_THAT(points, SizeIs(1));
  EXPECT_EQ(flags_of(points[0], grid, overrides),
            "--photons 1k --radius auto --direct signed --width 64 --crop 0 8 2 6");
}

TEST(SweepGrid, RefusesFewerPhotonsThanPasses) {
  Settings base;
  base.render.passes = 1000;
  const SweepGrid grid = parse_grid({.photons = {"1k", "100"}, .methods = {"mc", "photon"}});
  try {
    points_of(grid, base, {}, glass());
    FAIL();
  } catch (const ExitError& error) {
    EXPECT_EQ(error.code(), kBadCommandLine);
    EXPECT_THAT(error.what(), HasSubstr("100 photons cannot be divided among 1k passes"));
  }
  // Method mc needs no photons.
  EXPECT_THAT(points_of(parse_grid({.photons = {"100"}, .methods = {"mc"}}), base, {}, glass()), SizeIs(1));
}

SweepCell cell(double time, double relative_error, std::string flags) {
  SweepCell c;
  c.seconds[static_cast<size_t>(Phase::kTotal)] = {time, time, time};
  c.error.relmse = relative_error * relative_error;
  c.flags = std::move(flags);
  return c;
}

TEST(SweepResult, FrontContainsTheUnbeatenPoints) {
  const std::vector<SweepCell> cells = {cell(4, 0.01, "d"),         cell(1, 0.15, "a"),
                                        cell(2, 0.3, "worse"),      cell(2, 0.04, "b"),
                                        cell(2, 0.05, "slow twin"), cell(8, 0.01, "later")};
  EXPECT_THAT(pareto_front(cells), ElementsAre(1, 3, 0));
  EXPECT_THAT(pareto_front({}), IsEmpty());
}

TEST(SweepResult, AdviceNamesTheCheapestPointOfTheFront) {
  const std::vector<Advice> advice = advice_of(
      {cell(3.14, 0.02, "--photons 4M"), cell(0.5, 0.15, "--photons 1k"), cell(60, 0.019, "--photons 1G")});
  ASSERT_THAT(advice, SizeIs(3));
  EXPECT_EQ(advice[0].text, "For 20 % on this scene: --photons 1k, 0.5 s.");
  // The point reaches 10, 5 and 2 %.
  EXPECT_EQ(advice[1].text, "For 2 % on this scene: --photons 4M, 3.1 s.");
  EXPECT_EQ(advice[2].text, "No point of this grid reaches 1 %. The best is 1.9 % with --photons 1G, 60 s.");
  EXPECT_EQ(advice[2].cell, std::nullopt);
}

}  // namespace
}  // namespace kaustik::app
