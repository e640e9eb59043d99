// Tests camera paths and the names of frames.

#include "apps/sequence/camera_path.h"

#include <gmock/gmock.h>

#include <sstream>

#include "apps/console/exit_error.h"
#include "apps/sequence/frame_names.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CameraPaths : public test::ProgramTest {
 protected:
  CameraPath path_of(const std::string& json) const {
    std::ostringstream err;
    return CameraPath::read(write("path.json", json), err);
  }
  // What the user is told about a file that is refused.
  std::string complaint(const std::string& json) const {
    std::ostringstream err;
    try {
      CameraPath::read(write("path.json", json), err);
    } catch (const ExitError& error) {
      EXPECT_EQ(error.code(), kBadCommandLine);
      return err.str() + error.what();
    }
    return {};
  }
  static std::string keys(const std::string& more = "") {
    return R"({"keys": [{"frame": 0, "eye": [0, 0, 5], "target": [0, 0, 0], "fov": 30},
      {"frame": 4, "eye": [4, 0, 5], "target": [0, 2, 0], "fov": 50},
      {"frame": 10, "eye": [4, 6, 5], "target": [0, 2, 0], "fov": 50}])" +
           more + "}";
  }
};

TEST_F(CameraPaths, PassThroughTheirKeys) {
  for (const std::string more : {"", R"(, "interpolation": "linear")"}) {
    const CameraPath path = path_of(keys(more));
    EXPECT_EQ(path.frames(), 11u);
    EXPECT_THAT(path.at(0, {}).look_at, ElementsAre(0, 0, 5, 0, 0, 0, 0, 1, 0));
    EXPECT_THAT(path.at(4, {}).look_at, ElementsAre(4, 0, 5, 0, 2, 0, 0, 1, 0));
    EXPECT_THAT(path.at(10, {}).look_at, ElementsAre(4, 6, 5, 0, 2, 0, 0, 1, 0));
    EXPECT_EQ(path.at(4, {}).fov, 50);
  }
}

// Half-way, a cubic Hermite curve is at (p + q) / 2 + (m - n) / 8, with tangents m and n over the whole span.
// Between the first two keys of eye.x: m is the chord's, 4, n = 4 (4 - 0) / 10.
TEST_F(CameraPaths, RunSmoothlyOrStraightBetweenKeys) {
  EXPECT_NEAR(path_of(keys()).at(2, {}).look_at[0], 2 + (4 - 1.6) / 8, 1e-6);
  EXPECT_EQ(path_of(keys(R"(, "interpolation": "linear")")).at(2, {}).look_at[0], 2);
  EXPECT_EQ(path_of(keys(R"(, "interpolation": "linear")")).at(2, {}).fov, 40);
}

TEST_F(CameraPaths, OfOneKeyStandStill) {
  const CameraPath path = path_of(R"({"keys": [{"frame": 3, "eye": [1, 2, 3], "target": [0, 0, 0]}]})");
  EXPECT_EQ(path.frames(), 4u);
  EXPECT_EQ(path.at(0, {}).look_at[2], 3);
  EXPECT_FALSE(path.at(3, {}).fov);
}

// From 5 m in front of the centre, a quarter of the way round the axis leads to 5 m beside it, on +x for a
// right-handed turn about +y.
TEST_F(CameraPaths, TurntablesTurnTheScenesCamera) {
  CameraDescription camera;
  camera.camera_to_world = glm::dmat4(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(0, 0, -1, 0),
                                      glm::dvec4(1, 2, 5, 1));
  const CameraPath path = path_of(R"({"turntable": {"frames": 8, "center": [1, 2, 0]}})");
  EXPECT_EQ(path.frames(), 8u);
  const std::array<double, 9> beside = {6, 2, 0, 1, 2, 0, 0, 1, 0};
  for (size_t k = 0; k < beside.size(); ++k) EXPECT_NEAR(path.at(2, camera).look_at[k], beside[k], 1e-6) << k;
  EXPECT_THAT(path.at(0, camera).look_at, ElementsAre(1, 2, 5, 1, 2, 0, 0, 1, 0));
}

TEST_F(CameraPaths, ThatCannotBeReadAreRefused) {
  EXPECT_THAT(complaint("{\n  \"keys\": [\n  }"), HasSubstr("path.json:3:3: error: this is not JSON"));
  EXPECT_THAT(complaint("[]"), HasSubstr("expected an object with `keys` or `turntable`"));
  EXPECT_THAT(complaint("{}"), HasSubstr("expected either `keys` or `turntable`"));
  EXPECT_THAT(complaint(R"({"keys": []})"), HasSubstr("`keys` must have at least one key"));
  EXPECT_THAT(complaint(R"({"keyz": []})"), HasSubstr("unknown member `keyz`; did you mean"));
  EXPECT_THAT(complaint(R"({"keys": [{"frame": 0, "eye": [0, 1], "target": [0, 0, 0]}]})"),
              HasSubstr("`keys[0].eye`"));
  EXPECT_THAT(complaint(R"({"keys": [{"frame": 0, "eye": [0, 1, 2]}]})"),
              HasSubstr("`keys[0]` must have `target`, three numbers"));
  EXPECT_THAT(complaint(R"({"keys": [{"frame": -1, "eye": [0, 1, 2], "target": [0, 0, 0]}]})"),
              HasSubstr("`keys[0].frame`"));
  EXPECT_THAT(complaint(R"({"keys": [{"frame": 1, "eye": [0, 1, 2], "target": [0, 0, 0]},
                                     {"frame": 1, "eye": [0, 1, 2], "target": [0, 0, 0]}]})"),
              HasSubstr("`keys[1].frame` must be greater"));
  EXPECT_THAT(complaint(R"({"keys": [{"frame": 1, "eye": [0, 1, 2], "target": [0, 0, 0], "fov": 181}]})"),
              HasSubstr("`keys[0].fov` must be between"));
  EXPECT_THAT(complaint(R"({"turntable": {"frames": 0}})"), HasSubstr("`turntable.frames` must be 1"));
  EXPECT_THAT(complaint(R"({"turntable": {"frames": 3, "axis": [0, 0, 0]}})"), HasSubstr("must not be zero"));
  EXPECT_THAT(complaint(R"({"turntable": {"frames": 1e400}})"), HasSubstr("beyond the range of doubles"));
}

TEST(FrameNames, HaveTheNumberInPlaceOfThePattern) {
  EXPECT_EQ(frame_name("out/f.%04d.exr", 7), "out/f.0007.exr");
  EXPECT_EQ(frame_name("%dx", 12345), "12345x");
  EXPECT_EQ(frame_name("%03d", 12345), "12345");
  for (const char* bad : {"f.exr", "f.%s.exr", "%d.%d", "f.%4d.exr", "f.%00d.exr"})
    EXPECT_THROW(frame_name(bad, 0), std::invalid_argument) << bad;
}

}  // namespace
}  // namespace kaustik::app
