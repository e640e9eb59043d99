// Tests the choice of one of a file's cameras by name or number.

#include "apps/import/view/camera_choice.h"

#include <gtest/gtest.h>

namespace kaustik {
namespace {

TEST(CameraChoice, FindsNamesBeforeNumbers) {
  std::string error;
  const std::vector<std::string> names = {"front", "", "1"};
  EXPECT_EQ(find_camera(names, "front", error), 0u);
  EXPECT_EQ(find_camera(names, "2", error), 1u);
  EXPECT_EQ(find_camera(names, "1", error), 2u);
  EXPECT_EQ(error, "");
}

TEST(CameraChoice, SaysWhichCamerasThereAre) {
  const auto complaint = [](const std::vector<std::string>& names, const std::string& asked) {
    std::string error;
    EXPECT_FALSE(find_camera(names, asked, error));
    return error;
  };
  EXPECT_EQ(
      complaint({"front", "", "side"}, "fornt"),
      "--camera fornt: there is no such camera; did you mean `front`?; the file has the cameras 1 `front`, "
      "2, 3 `side`");
  EXPECT_EQ(complaint({""}, "0"), "--camera 0: there is no such camera; the file has camera 1");
  EXPECT_EQ(complaint({}, "1"), "--camera 1: there is no such camera; the file has no camera");
}

}  // namespace
}  // namespace kaustik
