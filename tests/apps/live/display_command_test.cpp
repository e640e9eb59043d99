// kaustik render and resume with --display: the viewer sees what is written, and what is written does not
// depend on the viewer.

#include <gmock/gmock.h>

#include "render/picture/image_io.h"
#include "tests/apps/live/support/test_viewer.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using test::Outcome;
using test::run_kaustik;
using test::ShownPicture;
using test::TestViewer;
using test::wait_until;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Arguments = std::vector<std::string>;

class DisplayCommand : public test::ProgramTest {
 protected:
  Outcome render(const std::string& output, const Arguments& more) const {
    Arguments all = {"render", scene_, "--photons", "5k", "--spp", "4", "-q", "-o", path(output)};
    all.insert(all.end(), more.begin(), more.end());
    return run_kaustik(all);
  }
  // Whether the viewer shows the radiance of an EXR file, whose upper left corner is pixel (x0, y0), bit by
  // bit.
  void expect_shown(const ShownPicture& picture, const std::string& file, int x0 = 0, int y0 = 0) const {
    const render::Image image = render::read_image(path(file));
    ASSERT_LE(x0 + image.width, picture.width);
    ASSERT_LE(y0 + image.height, picture.height);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        ASSERT_EQ(std::memcmp(picture.at(x0 + x, y0 + y), &image.at(x, y), 3 * sizeof(float)), 0)
            << x << ' ' << y;
  }
  static void wait_for_end(const TestViewer& viewer, int connections = 1) {
    EXPECT_TRUE(wait_until([&] { return viewer.closed_by_others() == connections; }));
  }

  std::string scene_ = small_scene(film(96, 64));
};

TEST_F(DisplayCommand, FilesHaveTheSameBytesAndTheViewerShowsThem) {
  TestViewer viewer;
  viewer.open();
  const Outcome shown = render("shown.exr", {"--display", viewer.address(), "--aov", "photons"});
  EXPECT_EQ(shown.code, kDone);
  EXPECT_THAT(shown.err, IsEmpty());
  wait_for_end(viewer);
  const Outcome alone = render("alone.exr", {"--aov", "photons"});
  EXPECT_EQ(alone.code, kDone);
  EXPECT_EQ(read("shown.exr"), read("alone.exr"));
  const ShownPicture picture = viewer.picture();
  EXPECT_EQ(picture.name, "small.pbrt");
  EXPECT_EQ(picture.width, 96);
  EXPECT_EQ(picture.height, 64);
  EXPECT_THAT(picture.channels, Contains("photons.Y"));
  expect_shown(picture, "shown.exr");  // after denoising
}

TEST_F(DisplayCommand, ACropIsShownInTheFullPicture) {
  TestViewer viewer;
  viewer.open();
  EXPECT_EQ(render("a.exr", {"--display", viewer.address(), "--crop", "20", "90", "10", "50"}).code, kDone);
  wait_for_end(viewer);
  const ShownPicture picture = viewer.picture();
  EXPECT_EQ(picture.width, 96);
  EXPECT_EQ(picture.height, 64);
  expect_shown(picture, "a.exr", 20, 10);
}

TEST_F(DisplayCommand, AResumedRenderIsShown) {
  ASSERT_EQ(render("a.kpart", {"--passes", "2"}).code, kDone);
  TestViewer viewer;
  viewer.open();
  const Outcome outcome = run_kaustik(
      {"resume", path("a.kpart"), "--passes", "3", "--display", viewer.address(), "-q", "-o", path("a.exr")});
  EXPECT_EQ(outcome.code, kDone) << outcome.err;
  wait_for_end(viewer);
  expect_shown(viewer.picture(), "a.exr");
}

TEST_F(DisplayCommand, WithoutAViewerThereIsOneWarning) {
  const TestViewer nobody;
  const Outcome shown = render("shown.exr", {"--display", nobody.address()});
  EXPECT_EQ(shown.code, kDone);
  EXPECT_EQ(shown.err, "kaustik render: warning: no viewer at " + nobody.address() +
                           ": Connection refused; it gets the picture when it is there\n");
  EXPECT_EQ(render("alone.exr", {}).code, kDone);
  EXPECT_EQ(read("shown.exr"), read("alone.exr"));
}

TEST_F(DisplayCommand, BadAddressesAreRefusedBeforeTheSceneIsRead) {
  for (const char* address : {":x", "box:0", "box:65536", "[::1", ""}) {
    const Outcome outcome = run_kaustik({"render", path("none.pbrt"), "--display", address});
    EXPECT_EQ(outcome.code, kBadCommandLine);
    EXPECT_THAT(outcome.err, HasSubstr("--display: `" + std::string(address) + "`: "));
    EXPECT_THAT(outcome.err, HasSubstr("expected HOST or HOST:PORT"));
  }
  const Outcome outcome = run_kaustik({"resume", path("none.kpart"), "--display", "box:0"});
  EXPECT_EQ(outcome.code, kBadCommandLine);
  EXPECT_THAT(outcome.err, HasSubstr("`0` is not a port, a whole number from 1 to 65535"));
}

}  // namespace
}  // namespace kaustik::app
