// Tests output files that cannot be written, and outputs that would replace each other or an input.

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "tests/apps/support/child_process.h"
#include "tests/apps/support/program.h"
#include "tests/support/file_size_limit.h"

namespace kaustik::app {
namespace {

using test::FileSizeLimit;
using test::Outcome;
using test::run_kaustik;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Arguments = std::vector<std::string>;

class OutputFiles : public test::ProgramTest {
 protected:
  Arguments render(const Arguments& more) const {
    Arguments all = {"render", scene_, "--photons", "1k", "--spp", "1", "-q"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  void expect_refused(const Arguments& arguments, const std::vector<std::string>& parts) const {
    const std::vector<std::string> before = files();
    const Outcome outcome = run_kaustik(arguments);
    EXPECT_EQ(outcome.code, kBadCommandLine) << outcome.err;
    for (const std::string& part : parts) EXPECT_THAT(outcome.err, HasSubstr(part));
    EXPECT_EQ(files(), before);
  }

  static constexpr rlim_t kLimit = 8'000;  // bytes
  std::string scene_ = small_scene(film(24, 16));
};

// The layers take more than the limit in an EXR file; the other files are smaller.
TEST_F(OutputFiles, OneThatCannotBeWrittenDoesNotCostTheOthers) {
  write("a.exr", "old");
  const Arguments arguments =
      render({"--width", "48", "-o", path("b.png"), "-o", path("a.exr"), "-o", path("c.jpg"), "--aov", "all",
              "--stats", path("d.json"), "--checkpoint", path("none.kpart")});
  Outcome outcome;
  {
    const FileSizeLimit limit(kLimit);
    outcome = run_kaustik(arguments);
  }
  EXPECT_EQ(outcome.code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr(path("a.exr") + ": "));
  EXPECT_THAT(outcome.err, HasSubstr("File too large"));
  EXPECT_THAT(outcome.err, HasSubstr("none.kpart"));
  EXPECT_THAT(files(), ElementsAre("a.exr", "b.png", "c.jpg", "d.json", "small.pbrt"));
  EXPECT_EQ(read("a.exr"), "old");
}

// The system would end the process by a signal at the limit of `ulimit -f`.
TEST_F(OutputFiles, TheProgramSurvivesTheLimitOfFileSizes) {
  const FileSizeLimit limit(kLimit);
  test::ChildProcess program(render({"--width", "48", "-o", path("a.exr"), "--aov", "all"}));
  EXPECT_EQ(program.wait(), kFailed);
  EXPECT_THAT(files(), ElementsAre("small.pbrt"));
}

TEST_F(OutputFiles, HeatmapThatCannotBeWrittenExitsWithOne) {
  ASSERT_EQ(run_kaustik(render({"-o", path("a.exr")})).code, kDone);
  const FileSizeLimit limit(100);
  const Outcome outcome = run_kaustik({"compare", path("a.exr"), path("a.exr"), "--heatmap", path("b.png")});
  EXPECT_EQ(outcome.code, kFailed);
  EXPECT_THAT(outcome.out, HasSubstr("RMSE"));
  EXPECT_THAT(outcome.err, HasSubstr("b.png"));
}

TEST_F(OutputFiles, EqualNamesAreRefused) {
  expect_refused(render({"-o", path("a.exr"), "--stats", path("a.exr")}), {"-o", "--stats", "a.exr"});
  expect_refused(render({"-o", path("a.exr"), "-o", path("./a.exr")}), {"-o", "a.exr"});
  expect_refused(render({"-o", path("a.kpart"), "--checkpoint", path("a.kpart")}), {"-o", "--checkpoint"});
  expect_refused(render({"-o", path("a.exr"), "--stats", scene_}), {"--stats", "the scene"});
  std::filesystem::create_hard_link(scene_, path("link.json"));
  expect_refused(render({"-o", path("a.exr"), "--stats", path("link.json")}), {"--stats", "the scene"});
  expect_refused({"photons", scene_, "--image", path("a.png"), "-o", path("a.ply/../a.png")}, {".ply"});
  expect_refused({"compare", path("link.json"), path("a.exr"), "--heatmap", path("a.exr")},
                 {"--heatmap", "a.exr"});
  expect_refused({"bench", scene_, "--json", scene_}, {"--json", "the scene"});
  expect_refused({"bench", scene_, "--json", path("scaling.html"), "--plot", path(".")},
                 {"--json", "--plot", "scaling.html"});
}

// A scene's Film names the output, and its other files are inputs.
TEST_F(OutputFiles, FilesOfTheSceneAreNotReplaced) {
  write("part.pbrt", "LightSource \"point\"\n");
  const std::string scene =
      write("whole.pbrt", film(8, 8) + " \"string filename\" \"" + path("a.exr") +
                              "\"\nWorldBegin\nInclude \"part.pbrt\"\nShape \"sphere\"\n");
  expect_refused({"render", scene, "-o", path("b.exr"), "--stats", path("part.pbrt")},
                 {"--stats", "part.pbrt"});
  expect_refused({"render", scene, "--stats", path("a.exr")}, {"the output", "--stats", "a.exr"});
  expect_refused({"convert", scene, path("part.pbrt")}, {"part.pbrt"});
}

// A finished file replaces the old one, so /dev/null would be gone.
TEST_F(OutputFiles, DevicesAndPipesAreNotReplaced) {
  ASSERT_EQ(mkfifo(path("pipe.json").c_str(), 0600), 0);
  expect_refused(render({"-o", path("a.exr"), "--stats", path("pipe.json")}), {"not a regular file"});
  expect_refused(render({"-o", path("a.exr"), "--stats", "/dev/null"}), {"cannot write /dev/null"});
}

TEST_F(OutputFiles, FullStandardOutputExitsWithOne) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  ASSERT_EQ(run_kaustik(render({"-o", path("a.exr")})).code, kDone);
  for (const Arguments& arguments :
       {Arguments{"info", scene_}, Arguments{"compare", path("a.exr"), path("a.exr"), "--json"},
        Arguments{"render", "--help"}, Arguments{"--version"}}) {
    std::vector<const char*> argv = {"kaustik"};
    for (const std::string& argument : arguments) argv.push_back(argument.c_str());
    std::ofstream full("/dev/full");
    std::ostringstream err;
    EXPECT_EQ(app::run(static_cast<int>(argv.size()), argv.data(), full, err), kFailed) << arguments[0];
    EXPECT_THAT(err.str(), HasSubstr("cannot write to the standard output: ")) << arguments[0];
  }
}

}  // namespace
}  // namespace kaustik::app
