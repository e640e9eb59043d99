// Tests the choice between photon maps and paths for fixed numbers of photons and samples, from the outside.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using test::Outcome;
using test::run_kaustik;
using ::testing::HasSubstr;
using ::testing::Not;

using Arguments = std::vector<std::string>;

// The box's sides, bottom and top.
constexpr const char* kBox =
    "Shape \"trianglemesh\" \"point3 P\" [-1 0 -1  1 0 -1  1 0 1  -1 0 1  -1 2 -1  1 2 -1  1 2 1  -1 2 1] "
    "\"integer indices\" [0 1 2 0 2 3  4 6 5 4 7 6  0 5 1 0 4 5  1 6 2 1 5 6  2 7 3 2 6 7  3 4 0 3 7 4]\n";

// The default million photons make these small pictures worth a trial.
class FixedPlan : public test::ProgramTest {
 protected:
  // A box on wide ground under an even sky.
  std::string open_sky() const {
    return scene("sky", "4 3 6  0 0.8 0", 40,
                 "LightSource \"infinite\" \"rgb L\" [1 1 1]\n"
                 "Material \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5]\n"
                 "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" "
                 "[-100 0 100  100 0 100  100 0 -100  -100 0 -100]\n");
  }
  // A closed room with a small light, lit mostly by its walls.
  std::string room() const {
    return scene("room", "0 1 0.9  0 0.9 0", 70,
                 "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [50 50 50]\n"
                 "Translate 0 1.9 0\nShape \"sphere\" \"float radius\" 0.05\nAttributeEnd\n"
                 "Material \"diffuse\" \"rgb reflectance\" [0.8 0.8 0.8]\n");
  }
  // Renders NAME.exr and returns the log.
  std::string render(const std::string& scene, const std::string& name, const Arguments& more) const {
    Arguments arguments{"render", scene, "-o", path(name + ".exr"), "--stats", path(name + ".json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run_kaustik(arguments);
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return outcome.err;
  }
  std::string indirect(const std::string& name) const {
    return nlohmann::json::parse(read(name + ".json"))["settings"]["indirect"];
  }

 private:
  // Writes NAME.pbrt with this world and the box.
  std::string scene(const std::string& name, const std::string& look, int fov,
                    const std::string& world) const {
    return write(name + ".pbrt", "LookAt " + look + "  0 1 0\nCamera \"perspective\" \"float fov\" " +
                                     std::to_string(fov) +
                                     "\nSampler \"halton\" \"integer pixelsamples\" 16\n" + film(64, 64) +
                                     "\nWorldBegin\n" + world + kBox);
  }
};

TEST_F(FixedPlan, OpenSkyTakesPathsOnAnyNumberOfThreads) {
  const std::string log = render(open_sky(), "one", {"--threads", "1"});
  EXPECT_THAT(log, HasSubstr("rendered with --indirect paths"));
  render(open_sky(), "three", {"--threads", "3"});
  render(open_sky(), "named", {"--indirect", "paths"});
  EXPECT_EQ(read("one.exr"), read("three.exr"));
  EXPECT_EQ(read("one.exr"), read("named.exr"));
  EXPECT_EQ(indirect("one"), "paths");
}

TEST_F(FixedPlan, PartsChooseAlike) {
  const auto part = [&](const std::string& name, const std::string& passes) {
    const Outcome outcome = run_kaustik(
        {"render", open_sky(), "-o", path(name), "--passes", "4", "--pass-range", passes, "--quiet"});
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
  };
  part("a.kpart", "0:1");
  part("b.kpart", "1:4");
  ASSERT_EQ(run_kaustik({"merge", path("a.kpart"), path("b.kpart"), "-o", path("merged.exr"), "-q"}).code,
            kDone);
  EXPECT_THAT(render(open_sky(), "whole", {"--passes", "4"}), HasSubstr("rendered with --indirect paths"));
  EXPECT_EQ(read("merged.exr"), read("whole.exr"));
}

// The trial leaves no trace in the picture: it has the bits of a render that is told to keep its maps.
TEST_F(FixedPlan, RoomKeepsItsMaps) {
  EXPECT_THAT(render(room(), "tried", {}), Not(HasSubstr("rendered with")));
  render(room(), "named", {"--indirect", "final-gather"});
  EXPECT_EQ(indirect("tried"), "final-gather");
  EXPECT_EQ(read("tried.exr"), read("named.exr"));
}

TEST_F(FixedPlan, PhotonsOfTheCommandLineStay) {
  EXPECT_THAT(render(open_sky(), "photons", {"--photons", "1M"}), Not(HasSubstr("rendered with")));
  EXPECT_EQ(indirect("photons"), "final-gather");
  EXPECT_THAT(render(open_sky(), "radius", {"--radius", "0.5"}), Not(HasSubstr("rendered with")));
}

// The error of a render includes the bias of its maps, which paths with kernels at their ends do not state.
TEST_F(FixedPlan, StatedErrorsKeepTheMaps) {
  EXPECT_THAT(render(open_sky(), "target", {"--target-error", "50%"}), Not(HasSubstr("rendered with")));
  EXPECT_EQ(indirect("target"), "final-gather");
}

}  // namespace
}  // namespace kaustik::app
