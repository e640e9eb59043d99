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
