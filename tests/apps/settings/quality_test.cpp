// Tests --quality: the values of each preset, and what overrides it.

#include "apps/settings/table/quality.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using test::run_kaustik;
using ::testing::HasSubstr;

class Quality : public test::ProgramTest {
 protected:
  // The photons and samples of a render of a scene with these lines.
  std::pair<uint64_t, int> rendered(const std::string& lines, std::vector<std::string> options) const {
    const std::string scene = small_scene(film(4, 3) + "\n" + lines);
    std::vector<std::string> arguments = {"render",  scene,          "-o", path("a.exr"),
                                          "--stats", path("s.json"), "-q"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const test::Outcome outcome = run_kaustik(arguments);
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    const auto settings = nlohmann::json::parse(read("s.json"))["settings"];
    return {settings["photons"], settings["spp"]};
  }
  using Numbers = std::pair<uint64_t, int>;
  const QualityPreset& draft_ = kQualityPresets[0];
};

TEST_F(Quality, SetsItsDocumentedValues) {
  for (const QualityPreset& preset : kQualityPresets) {
    Settings settings;
    const std::string name(preset.name);
    ASSERT_EQ(find_setting("quality")->assign(settings, {&name, 1}), std::nullopt);
    EXPECT_EQ(settings.render.photons, preset.photons);
    EXPECT_EQ(settings.render.spp, preset.spp);
    EXPECT_EQ(settings.render.passes, preset.passes);
  }
}

// Every number rises from the cheapest preset to the most expensive.
TEST_F(Quality, PresetsRise) {
  for (size_t i = 1; i < kQualityPresets.size(); ++i) {
    EXPECT_GT(kQualityPresets[i].photons, kQualityPresets[i - 1].photons);
    EXPECT_GT(kQualityPresets[i].spp, kQualityPresets[i - 1].spp);
    EXPECT_GE(kQualityPresets[i].passes, kQualityPresets[i - 1].passes);
  }
}

TEST_F(Quality, NumbersOnTheCommandLineOverrideIt) {
  EXPECT_EQ(rendered("", {"--quality", "draft"}), Numbers(draft_.photons, draft_.spp));
  EXPECT_EQ(rendered("", {"--quality", "draft", "--spp", "3"}), Numbers(draft_.photons, 3));
  EXPECT_EQ(rendered("", {"--spp", "3", "--photons", "5k", "--quality", "draft"}), Numbers(5000, 3));
}

TEST_F(Quality, OnTheCommandLineOverridesTheFile) {
  const std::string file =
      "Sampler \"independent\" \"integer pixelsamples\" 2\n"
      "Integrator \"photonmap\" \"integer photons\" 7000";
  EXPECT_EQ(rendered(file, {}), Numbers(7000, 2));
  EXPECT_EQ(rendered(file, {"--quality", "draft"}), Numbers(draft_.photons, draft_.spp));
}

// The order of the settings in the file does not matter.
TEST_F(Quality, InTheFileIsOverriddenByTheFilesNumbers) {
  EXPECT_EQ(rendered("Integrator \"photonmap\" \"string quality\" \"draft\"", {}),
            Numbers(draft_.photons, draft_.spp));
  EXPECT_EQ(rendered("Integrator \"photonmap\" \"integer photons\" 7000 \"string quality\" \"draft\"\n"
                     "Sampler \"independent\" \"integer pixelsamples\" 2",
                     {}),
            Numbers(7000, 2));
}

TEST_F(Quality, UnknownNamesAreRefusedWithTheNearest) {
  const test::Outcome outcome = run_kaustik({"render", small_scene(), "--quality", "hihg"});
  EXPECT_EQ(outcome.code, kBadCommandLine);
  EXPECT_THAT(outcome.err, HasSubstr("did you mean `high`?"));
}

}  // namespace
}  // namespace kaustik::app
