// Tests what fills a time that is too short for trials, from the outside.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using test::Outcome;
using test::run_kaustik;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kNoTime = "there is no time to make photon maps";

class TimePlan : public test::ProgramTest {
 protected:
  // A floor under a small lamp, in a millisecond, which loading alone takes. Returns the log.
  std::string render_at_once(const std::vector<std::string>& more) const {
    const std::string scene =
        write("floor.pbrt",
              "LookAt 0 2 3  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 40\n" + film(16, 16) +
                  "\nWorldBegin\n"
                  "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [50 50 50]\nTranslate 0 2 0\n"
                  "Shape \"sphere\" \"float radius\" 0.1\nAttributeEnd\n"
                  "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" "
                  "[-1 0 1  1 0 1  1 0 -1  -1 0 -1]\n");
    std::vector<std::string> arguments{"render",           scene,    "-o", path("floor.exr"), "--stats",
                                       path("floor.json"), "--time", "1ms"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run_kaustik(arguments);
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return outcome.err;
  }
  nlohmann::json stats() const { return nlohmann::json::parse(read("floor.json")); }
};

TEST_F(TimePlan, TakesPathsAtOnceWhereThereIsNoTimeForMaps) {
  const std::string log = render_at_once({});
  EXPECT_THAT(log, HasSubstr(kNoTime));
  EXPECT_THAT(log, HasSubstr("after 1 pass"));
  EXPECT_EQ(stats()["settings"]["indirect"], "paths");
}

TEST_F(TimePlan, KeepsAnEstimatorThatIsNamed) {
  EXPECT_THAT(render_at_once({"--indirect", "final-gather"}), Not(HasSubstr(kNoTime)));
  EXPECT_EQ(stats()["settings"]["indirect"], "final-gather");
}

}  // namespace
}  // namespace kaustik::app
