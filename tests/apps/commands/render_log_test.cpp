// Tests what kaustik render says about a render.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using test::Outcome;
using test::run_kaustik;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class RenderLog : public test::ProgramTest {
 protected:
  std::string log_of(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {
        "render", small_scene(film(16, 16)), "-o", path("a.exr"), "--photons", "5k", "--spp", "1"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run_kaustik(words);
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return outcome.err;
  }
};

TEST_F(RenderLog, NamesTheRadiusOfEachMap) {
  const std::string log = log_of({"--method", "photon", "--stats", path("a.json")});
  const nlohmann::json radii = nlohmann::json::parse(read("a.json"))["radii"];
  for (const char* map : {"direct", "caustic", "indirect"}) {
    std::smatch found;
    ASSERT_TRUE(
        std::regex_search(log, found, std::regex(std::string("gather radius:.* ") + map + " ([0-9.]+) m")))
        << log;
    EXPECT_NEAR(std::stod(found[1]), radii[map].get<double>(),
                5e-4 * radii[map].get<double>());  // four digits
  }
  EXPECT_THAT(log_of({"--method", "hybrid", "--direct", "shadow-rays"}),
              Not(ContainsRegex("gather radius[^\n]*indirect")));
  EXPECT_THAT(log_of({"--method", "raytrace"}), Not(HasSubstr("gather radius")));
}

// In fog without glass or mirrors paths bring all light: 16 times the samples of the preset, but the exact
// number where somebody gave one. A resumed render goes on with the same.
TEST_F(RenderLog, TellsHowManySamplesPathsTake) {
  const auto samples = [&](const std::string& lines, const std::vector<std::string>& more) {
    const std::string scene =
        write("fog.pbrt",
              "LookAt 0 2 6  0 0.5 0  0 1 0\nCamera \"perspective\"\n" + film(8, 8) + "\n" + lines +
                  "\nMakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [0.1 0.1 0.1]\n"
                  "MediumInterface \"\" \"fog\"\nWorldBegin\nLightSource \"point\" \"rgb I\" [9 9 9]\n"
                  "Material \"diffuse\"\nTranslate 0 -1 0\nRotate -90 1 0 0\n"
                  "Shape \"disk\" \"float radius\" 3\n");
    std::vector<std::string> words = {"render", scene, "--stats", path("fog.json"), "-o", path("fog.exr")};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run_kaustik(words);
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    const int spp = nlohmann::json::parse(read("fog.json"))["settings"]["spp"];
    const std::string told = "with more noise: rendered with --spp " + std::to_string(spp);
    EXPECT_EQ(outcome.err.find(told) != outcome.err.npos, spp == 128) << outcome.err;
    return spp;
  };
  EXPECT_EQ(samples("", {}), 128);
  EXPECT_EQ(samples("", {"--spp", "8"}), 8);
  EXPECT_EQ(samples("", {"--balance-samples", "off"}), 8);
  EXPECT_EQ(samples("Sampler \"sobol\" \"integer pixelsamples\" 10", {}), 10);
  EXPECT_EQ(samples("", {"--checkpoint", path("fog.kpart"), "--passes", "2"}), 128);
  const Outcome more = run_kaustik(
      {"resume", path("fog.kpart"), "--passes", "3", "--stats", path("more.json"), "-o", path("more.exr")});
  EXPECT_EQ(more.code, kDone) << more.err;
  EXPECT_EQ(nlohmann::json::parse(read("more.json"))["settings"]["spp"], 128);
}

TEST_F(RenderLog, SecondsOfPhasesAddUpToTheTotal) {
  const std::string log = log_of({});
  const size_t line = log.find("seconds: ");
  ASSERT_NE(line, log.npos);
  double sum = 0, total = 0;
  int phases = 0;
  const std::regex phase("([a-z ]+) ([0-9.]+)(,|\n)");
  for (auto at = std::sregex_iterator(log.begin() + std::ptrdiff_t(line) + 9,
                                      log.begin() + std::ptrdiff_t(log.find('\n', line)) + 1, phase);
       at != std::sregex_iterator(); ++at, ++phases)
    ((*at)[1] == " total" ? total : sum) += std::stod((*at)[2]);
  EXPECT_EQ(phases, 10);
  EXPECT_NEAR(sum, total, 10 * 0.005 + 1e-9);  // each is rounded to hundredths
}

TEST_F(RenderLog, SaysThatTheNoiseOfRouletteIsNoLoss) {
  EXPECT_THAT(log_of({"--method", "photon"}), HasSubstr("noise of Russian roulette, zero on average: "));
}

// The scene's diagonal is that of a box of 6 x 3 x 6 m, 9 m.
TEST_F(RenderLog, WarnsOfRadiiThatAreALargeShareOfTheScene) {
  EXPECT_THAT(log_of({"--radius", "3"}),
              HasSubstr("warning: the gather radius of 3 m is 33 % of the scene's diagonal, 9 m"));
  EXPECT_THAT(log_of({"--radius", "3"}), HasSubstr("here 0.09 m to 0.27 m"));
  EXPECT_THAT(log_of({"--radius", "2"}), Not(HasSubstr("the gather radius of")));
  EXPECT_THAT(log_of({"--radius", "3", "--method", "raytrace"}), Not(HasSubstr("the gather radius of")));
}

// A cube of 1 m on land of 400 m under an open sky: hardly a photon of the sky meets both.
constexpr const char* kCubeOnLand = R"(Film "rgb" "integer xresolution" 16 "integer yresolution" 16
LookAt 3 3 2  0 0 0.5  0 0 1
Camera "perspective"
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
  "point3 P" [-200 -200 0 200 -200 0 200 200 0 -200 200 0]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3  4 5 6 4 6 7]
  "point3 P" [0 -.5 0 0 .5 0 0 .5 1 0 -.5 1  -.5 0 0 .5 0 0 .5 0 1 -.5 0 1]
)";

TEST_F(RenderLog, WarnsOfMapsThatNearlyAllPhotonsMiss) {
  const std::string warning = "photons bring indirect light to surfaces";
  const auto log = [&](const std::string& scene, const std::string& indirect) {
    const Outcome outcome = run_kaustik({"render", scene, "-o", path("a.exr"), "--photons", "50k", "--spp",
                                         "1", "--guide", "off", "--indirect", indirect});
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return outcome.err;
  };
  const std::string cube = write("cube.pbrt", kCubeOnLand), room = small_scene(film(16, 16));
  EXPECT_THAT(log(cube, "photons"), HasSubstr(warning));
  EXPECT_THAT(log(cube, "paths"), Not(HasSubstr(warning)));
  EXPECT_THAT(log(room, "photons"), Not(HasSubstr(warning)));
}

}  // namespace
}  // namespace kaustik::app
