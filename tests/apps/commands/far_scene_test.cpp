// Tests commands on a scene far from the world's origin.

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using test::Outcome;
using test::run_kaustik;
using ::testing::HasSubstr;
using ::testing::Not;

class FarScene : public test::ProgramTest {};

// Far from the world's origin the picture is made around a local origin; all output is in the world's
// coordinates.
TEST_F(FarScene, IsReportedInTheWorldsCoordinates) {
  const std::string scene = write("far.pbrt",
                                  "WorldBegin\nLightSource \"point\" \"point3 from\" [1000000 2000004 0]\n"
                                  "Translate 1000000 2000000 0\nRotate -90 1 0 0\nShape \"disk\"\n");
  const Outcome info = run_kaustik({"info", scene, "--json"});
  ASSERT_EQ(info.code, kDone) << info.err;
  const auto json = nlohmann::json::parse(info.out);
  // The scene is a disk of radius 1, where the rounding of floats and the margin of the bounds are below 1e-5
  // m.
  EXPECT_NEAR(json["bounds"]["min"][0].get<double>(), 999'999, 1e-5);
  EXPECT_NEAR(json["bounds"]["max"][0].get<double>(), 1'000'001, 1e-5);
  EXPECT_NEAR(json["bounds"]["min"][1].get<double>(), 2'000'000, 1e-5);
  EXPECT_EQ(json["origin"], nlohmann::json({1e6, 2e6, 0}));
  EXPECT_THAT(run_kaustik({"info", scene}).out, HasSubstr("origin     (1000000, 2000000, 0) m"));

  ASSERT_EQ(run_kaustik({"photons", scene, "-o", path("far.ply"), "--photons", "1000"}).code, kDone);
  const std::string cloud = read("far.ply"), end = "end_header\n";
  const size_t body = cloud.find(end) + end.size();
  ASSERT_GT(cloud.size(), body + 40);
  for (size_t at = body; at < cloud.size(); at += 40) {
    double p[3];
    std::memcpy(p, cloud.data() + at, sizeof(p));
    EXPECT_LE(std::hypot(p[0] - 1e6, p[2]), 1 + 1e-5);
    EXPECT_NEAR(p[1], 2e6, 1e-5);
  }
}

TEST_F(FarScene, NearScenesKeepTheWorldsOrigin) {
  const Outcome info = run_kaustik({"info", small_scene(), "--json"});
  EXPECT_EQ(nlohmann::json::parse(info.out)["origin"], nlohmann::json({0, 0, 0}));
  EXPECT_THAT(run_kaustik({"info", small_scene()}).out, Not(HasSubstr("\norigin")));
}

}  // namespace
}  // namespace kaustik::app
