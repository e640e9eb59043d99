// Tests renders that stop when they are good enough: --target-error, --time, and the layers with the error.

#include <gmock/gmock.h>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/command_line/values.h"
#include "apps/settings/table/settings.h"
#include "render/passes/partial_result.h"
#include "tests/apps/support/program.h"
#include "tests/support/sanitized.h"

namespace kaustik::app {
namespace {

using test::Outcome;
using test::run_kaustik;
using ::testing::HasSubstr;
using ::testing::Not;

using Arguments = std::vector<std::string>;

class StopRules : public test::ProgramTest {
 protected:
  Arguments render(const Arguments& more) const {
    Arguments all = {"render", scene_, "--photons", "16k", "--spp", "8"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Outcome expect_done(const Arguments& arguments) const {
    const Outcome outcome = run_kaustik(arguments);
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return outcome;
  }
  void expect_refused(const Arguments& arguments, const std::string& part) const {
    const Outcome outcome = run_kaustik(arguments);
    EXPECT_EQ(outcome.code, kBadCommandLine) << part;
    EXPECT_THAT(outcome.err, HasSubstr(part));
  }
  nlohmann::json stats(const std::string& name) const { return nlohmann::json::parse(read(name)); }

  std::string scene_ = small_scene(film(24, 16));
};

TEST_F(StopRules, TargetErrorIsReachedAndReported) {
  const Outcome outcome = expect_done(render({"--target-error", "12%", "-o", path("a.exr"), "--stats",
                                              path("a.json"), "--checkpoint", path("a.kpart")}));
  EXPECT_THAT(outcome.err, HasSubstr("stopped by --target-error 0.12"));
  const nlohmann::json json = stats("a.json");
  EXPECT_LE(json["error"]["relative"], 0.12);
  EXPECT_TRUE(json["error"]["holds_bias"]);
  EXPECT_EQ(json["passes_of_settings"], 8);
  EXPECT_NEAR(json["settings"]["alpha"], 2.0 / 3, 1e-6);
  const auto file = OIIO::ImageInput::open(path("a.exr"));
  ASSERT_TRUE(file);
  EXPECT_EQ(file->spec().get_string_attribute("kaustik:stopped_by"), "target-error 0.12");
  EXPECT_LE(std::stod(file->spec().get_string_attribute("kaustik:error").c_str()), 0.12);
}

// One pass fewer would not have been enough.
TEST_F(StopRules, TargetErrorStopsAtTheFirstPassThatIsEnough) {
  expect_done(render({"--target-error", "12%", "-o", path("a.exr"), "--stats", path("a.json")}));
  const uint64_t passes = stats("a.json")["photons"]["passes"];
  ASSERT_GT(passes, 2u);
  expect_done(
      render({"--passes", "8", "--pass-range", "0:" + std::to_string(passes - 1), "--alpha", "0.666666687",
              "--estimate-bias", "on", "-o", path("b.exr"), "--stats", path("b.json")}));
  EXPECT_GT(stats("b.json")["error"]["relative"], 0.12);
}

TEST_F(StopRules, LowerTargetContinuesWhereAHigherStopped) {
  expect_done(render(
      {"--target-error", "8%", "-o", path("whole.kpart"), "-o", path("whole.exr"), "--aov", "error,bias"}));
  expect_done(render({"--target-error", "14%", "-o", path("a.kpart"), "--aov", "error,bias"}));
  expect_done({"resume", path("a.kpart"), "--target-error", "8%", "-o", path("a.exr")});
  EXPECT_EQ(read("a.exr"), read("whole.exr"));
  EXPECT_GT(render::read_partial(path("whole.kpart")).sums.passes.count(), 2u);
}

TEST_F(StopRules, RuleThatIsMetRendersNothingMore) {
  const Arguments rule = {"--target-error", "14%", "-o", path("a.kpart"), "-o", path("a.exr")};
  expect_done(render(rule));
  const render::PassSet passes = render::read_partial(path("a.kpart")).sums.passes;
  EXPECT_THAT(expect_done({"resume", path("a.kpart"), "-o", path("b.exr")}).err,
              HasSubstr("target-error 0.14"));
  EXPECT_EQ(render::read_partial(path("a.kpart")).sums.passes, passes);
  EXPECT_EQ(read("a.exr"), read("b.exr"));
  expect_done({"merge", path("a.kpart"), "-o", path("c.exr")});
  EXPECT_EQ(read("a.exr"), read("c.exr"));
}

TEST_F(StopRules, PassesAndNoneOverrideARule) {
  expect_done(render({"--target-error", "14%", "-o", path("a.kpart")}));
  const uint64_t passes = render::read_partial(path("a.kpart")).sums.passes.end();
  const std::string more = std::to_string(passes + 2);
  expect_done({"resume", path("a.kpart"), "--target-error", "0.001%", "--passes", more, "-o", path("b.exr")});
  EXPECT_EQ(render::read_partial(path("a.kpart")).sums.passes.end(), passes + 2);
  expect_done({"resume", path("a.kpart"), "--target-error", "none", "-o", path("b.exr")});
  EXPECT_EQ(render::read_partial(path("a.kpart")).sums.passes.end(), passes + 2);
}

TEST_F(StopRules, UnmeasuredBiasIsLeftOutAndReported) {
  expect_done(render({"--passes", "4", "-o", path("a.kpart")}));
  const Outcome layers = expect_done({"resume", path("a.kpart"), "--aov", "error,bias", "-o", path("a.exr")});
  EXPECT_THAT(layers.err, HasSubstr("the layer bias is left out"));
  const auto file = OIIO::ImageInput::open(path("a.exr"));
  ASSERT_TRUE(file);
  EXPECT_THAT(file->spec().channelnames, ::testing::Contains("error.R"));
  EXPECT_THAT(file->spec().channelnames, Not(::testing::Contains("bias.R")));
  const Outcome target =
      expect_done({"resume", path("a.kpart"), "--target-error", "60%", "-o", path("a.exr")});
  EXPECT_THAT(target.err, HasSubstr("noise alone"));
}

TEST_F(StopRules, PartOfASplitRenderTakesNoRule) {
  expect_done(render({"--passes", "8", "--pass-range", "4:8", "-o", path("p.kpart")}));
  expect_refused({"resume", path("p.kpart"), "--time", "5s", "-o", path("a.exr")}, "--time cannot be used");
  expect_refused({"resume", path("p.kpart"), "--target-quantile", "50%", "-o", path("a.exr")},
                 "--target-quantile needs --target-error");
}

TEST_F(StopRules, QuantileNeedsMorePasses) {
  expect_done(render({"--target-error", "15%", "-o", path("a.exr"), "--stats", path("mean.json")}));
  expect_done(render({"--target-error", "15%", "--target-quantile", "95%", "-o", path("a.exr"), "--stats",
                      path("most.json")}));
  EXPECT_GT(stats("most.json")["photons"]["passes"], stats("mean.json")["photons"]["passes"]);
}

TEST_F(StopRules, ExpiredTimeStillRendersOnePass) {
  const Outcome outcome = expect_done(
      render({"--time", "1ms", "--denoise", "off", "-o", path("a.exr"), "--stats", path("a.json")}));
  EXPECT_THAT(outcome.err, HasSubstr("stopped by --time 0.001s after 1 pass"));
  EXPECT_EQ(stats("a.json")["photons"]["passes"], 1);
  EXPECT_TRUE(stats("a.json")["error"].is_null());
}

TEST_F(StopRules, ExpiredTimeStillRendersWhatTheDenoiserNeeds) {
  const Outcome outcome = expect_done(render({"--time", "1ms", "--denoise", "on", "-o", path("a.exr")}));
  EXPECT_THAT(outcome.err, HasSubstr("stopped by --time 0.001s after 5 passes"));  // four are one half
  EXPECT_THAT(outcome.err, Not(HasSubstr("not denoised")));
}

// The scene sets photons and samples; then --time decides how many are used.
class FilledTime : public test::ProgramTest {
 protected:
  std::vector<float> pixels(const std::string& name) const {
    const auto file = OIIO::ImageInput::open(path(name));
    std::vector<float> out(24 * 16 * 3);
    EXPECT_TRUE(file && file->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, out.data())) << name;
    return out;
  }
  // Renders for this time; the statistics are written to NAME.json.
  Outcome render(const std::string& time, const std::string& name, const Arguments& more = {}) const {
    Arguments all = {
        "render", scene_, "--time", time, "-o", path(name + ".exr"), "--stats", path(name + ".json")};
    all.insert(all.end(), more.begin(), more.end());
    const Outcome outcome = run_kaustik(all);
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return outcome;
  }
  nlohmann::json stats(const std::string& name) const { return nlohmann::json::parse(read(name + ".json")); }

  std::string scene_ = small_scene(film(24, 16));
};

TEST_F(FilledTime, IsOnePassThatOptionsReproduce) {
  if (test::kSanitized) GTEST_SKIP() << "with a sanitizer the time is too short for photon maps";
  const std::string log = render("1500ms", "a").err;  // where 300 ms are enough, on a busy machine too
  EXPECT_THAT(log, HasSubstr("--time 1.5s is rendered with --spp "));
  EXPECT_THAT(log, HasSubstr("--time 1.5s gave --spp "));
  const bool denoised = log.find(" --denoise on\n") != std::string::npos;  // if the machine has time for it
  const nlohmann::json json = stats("a"), settings = json["settings"];
  EXPECT_EQ(json["photons"]["passes"], 1);
  EXPECT_GE(settings["adaptive"], 0.01);
  EXPECT_EQ(
      run_kaustik({"render", scene_, "--spp", settings["spp"].dump(), "--photons", settings["photons"].dump(),
                   "--adaptive", fmt::format("{}", settings["adaptive"].get<float>()), "--denoise",
                   denoised ? "on" : "off", "-o", path("b.exr")})
          .code,
      kDone);
  EXPECT_EQ(pixels("a.exr"), pixels("b.exr"));
}

TEST_F(FilledTime, UsesManyPassesForLongTimes) {
  EXPECT_THAT(render("4.5s", "a").err,
              HasSubstr(" --passes 8 --alpha 0.6666667, and more passes until the time is up"));
  const nlohmann::json json = stats("a");
  EXPECT_EQ(json["passes_of_settings"], 8);
  EXPECT_NEAR(json["settings"]["alpha"], 2.0 / 3, 1e-6);
}

TEST_F(FilledTime, AllLayersOfSeveralPassesIncludeTheBias) {
  render("4.5s", "a", {"--aov", "all"});
  const nlohmann::json error = stats("a")["error"];
  if (!error.is_null()) {  // only for two passes or more: the machine may be too slow
    EXPECT_TRUE(error["holds_bias"]);
  }
}

TEST_F(FilledTime, InvalidTimesAreRefused) {
  const Outcome outcome =
      run_kaustik({"render", scene_, "--time", "1s", "--target-quantile", "95%", "-o", path("a.exr")});
  EXPECT_EQ(outcome.code, kBadCommandLine);
  EXPECT_THAT(outcome.err, HasSubstr("--target-quantile needs --target-error"));
}

TEST_F(FilledTime, KeepsExplicitSettings) {
  const int spp = Settings{}.render.spp;
  render("1ms", "spp", {"--spp", "8"});
  EXPECT_EQ(stats("spp")["passes_of_settings"], 8);
  EXPECT_EQ(stats("spp")["settings"]["spp"], 8);
  render("1ms", "photons", {"--photons", "16k"});
  EXPECT_EQ(stats("photons")["settings"]["photons"], 16000);
  render("1ms", "error", {"--aov", "error"});
  EXPECT_EQ(stats("error")["settings"]["spp"], spp);
  render("1ms", "bias", {"--estimate-bias", "on"});
  EXPECT_EQ(stats("bias")["settings"]["spp"], spp);
  render("1ms", "part", {"-o", path("part.kpart")});
  EXPECT_EQ(stats("part")["passes_of_settings"], 8);
  render("1ms", "mc", {"--method", "mc"});
  EXPECT_EQ(stats("mc")["settings"]["spp"], spp);
  EXPECT_EQ(stats("mc")["passes_of_settings"], spp);                     // no photons: passes of one sample
  render("1ms", "off", {"--adaptive", "off", "--indirect", "photons"});  // or else paths would be taken
  EXPECT_EQ(stats("off")["settings"]["adaptive"], 0);
  EXPECT_EQ(stats("off")["passes_of_settings"], 1);
}

// Loading alone takes a millisecond.
TEST_F(FilledTime, TakesPathsAtOnceWhereThereIsNoTimeForMaps) {
  const std::string log = render("1ms", "a", {"--denoise", "off"}).err;
  EXPECT_THAT(log, HasSubstr("there is no time to make photon maps"));
  EXPECT_THAT(log, HasSubstr("after 1 pass"));
  EXPECT_EQ(stats("a")["settings"]["indirect"], "paths");
}

// One sample of each pixel could not be denoised.
TEST_F(FilledTime, TakesSamplesForTheDenoiserWhereThereIsNoTimeForOne) {
  const std::string paths = render("1ms", "a", {"--denoise", "on"}).err;
  EXPECT_THAT(paths, HasSubstr("after 5 passes"));
  EXPECT_THAT(paths, Not(HasSubstr("not denoised")));
  const std::string photons = render("1ms", "b", {"--denoise", "on", "--indirect", "photons"}).err;
  EXPECT_THAT(photons, Not(HasSubstr("not denoised")));
  EXPECT_GE(stats("b")["settings"]["spp"], 2);
}

TEST_F(FilledTime, KeepsAnEstimatorThatIsNamed) {
  EXPECT_THAT(render("1ms", "a", {"--indirect", "photons"}).err,
              Not(HasSubstr("there is no time to make photon maps")));
  EXPECT_EQ(stats("a")["settings"]["indirect"], "photons");
}

TEST_F(StopRules, LayersContainTheError) {
  expect_done(render({"--aov", "error,bias", "-o", path("a.exr"), "--stats", path("a.json")}));
  EXPECT_EQ(stats("a.json")["photons"]["passes"], 8);
  const auto file = OIIO::ImageInput::open(path("a.exr"));
  ASSERT_TRUE(file);
  EXPECT_THAT(file->spec().channelnames, ::testing::ElementsAre("R", "G", "B", "bias.R", "bias.G", "bias.B",
                                                                "error.R", "error.G", "error.B"));
  std::vector<float> pixels(24 * 16 * 9);
  ASSERT_TRUE(file->read_image(0, 0, 0, 9, OIIO::TypeDesc::FLOAT, pixels.data()));
  size_t lit = 0, biased = 0;
  for (size_t i = 0; i < 24 * 16; ++i) {
    for (size_t c = 3; c < 9; ++c) EXPECT_TRUE(std::isfinite(pixels[9 * i + c]));
    lit += pixels[9 * i + 6] > 0;
    biased += pixels[9 * i + 3] != 0;
  }
  EXPECT_GT(lit, 100u);
  EXPECT_GT(biased, 10u);
}

TEST_F(StopRules, AllLayersOfOnePassExcludeTheError) {
  expect_done(render({"--aov", "all", "-o", path("a.exr"), "--passes", "1"}));
  const auto file = OIIO::ImageInput::open(path("a.exr"));
  ASSERT_TRUE(file);
  EXPECT_THAT(file->spec().channelnames, Not(::testing::Contains("error.R")));
  EXPECT_THAT(file->spec().channelnames, ::testing::Contains("photons.Y"));
}

TEST_F(StopRules, InvalidRulesAreRefused) {
  const std::string out = path("a.exr");
  expect_refused(render({"--target-error", "0", "-o", out}),
                 "`0`: expected a share above 0, like 1% or 0.01");
  expect_refused(render({"--target-error", "nan", "-o", out}), "expected a share");
  expect_refused(render({"--target-quantile", "120%", "--target-error", "1%", "-o", out}), "at most 1");
  expect_refused(render({"--target-quantile", "50%", "-o", out}), "--target-quantile needs --target-error");
  expect_refused(render({"--time", "60", "-o", out}), "with its unit");
  expect_refused(render({"--time", "5s", "--passes", "4", "--pass-range", "0:2", "-o", out}), "--pass-range");
  expect_refused(render({"--aov", "error", "--passes", "1", "-o", out}), "--passes 2 or more");
  expect_refused(render({"--photons", "3", "--passes", "4", "-o", out}),
                 "3 photons cannot be divided among so many passes");
  EXPECT_FALSE(exists("a.exr"));
}

TEST(Shares, ArePercentagesOrFractions) {
  EXPECT_EQ(parse_share("1%"), 0.01);
  EXPECT_EQ(parse_share("0.25"), 0.25);
  EXPECT_EQ(parse_share("1e-3"), 1e-3);
  for (const char* bad : {"", "%", "1 %", "1%%", "x", "inf", "nan", "1e999"})
    EXPECT_FALSE(parse_share(bad)) << bad;
}

}  // namespace
}  // namespace kaustik::app
