// Tests --root on the command line: scenes, and partial results, of strangers read and write nothing outside
// a folder.

#include <gmock/gmock.h>

#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::run_kaustik;
using ::testing::HasSubstr;
using ::testing::Not;
using Arguments = std::vector<std::string>;

class RootOption : public test::ProgramTest {
 protected:
  void SetUp() override {
    fs::create_directories(path("root"));
    write("secret.txt", "root:$6$password\n");
  }
  std::string scene(const std::string& lines, const std::string& world = "LightSource \"point\"") const {
    return write("root/s.pbrt", film(8, 8) + lines + "\nWorldBegin\nShape \"sphere\"\n" + world + "\n");
  }
  std::string scene_that_names_output(const std::string& output) const {
    return scene(" \"string filename\" \"" + output + "\"");
  }
  static Outcome run(Arguments arguments, const Arguments& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_kaustik(arguments);
  }
  Outcome below_root(const Arguments& arguments) const { return run(arguments, {"--root", path("root")}); }

  const Arguments draft_ = {"--photons", "1k", "--spp", "1", "-q"};
};

TEST_F(RootOption, EveryCommandThatReadsScenesTakesIt) {
  const std::string s = scene("", "Include \"../secret.txt\"");
  const std::string error =
      s + ":4:9: error: cannot read \"" + path("root/../secret.txt") + "\": it lies outside --root ";
  for (const Arguments& command : {Arguments{"render", s, "-o", path("a.exr")},
                                   {"view", s},
                                   {"info", s},
                                   {"photons", s, "-o", path("a.ply")},
                                   {"bench", s},
                                   {"convert", s, path("b.pbrt")},
                                   {"sweep", s, "-o", path("sweep")},
                                   {"shoot", s, "-o", path("a.kmap")},
                                   {"split", s, "--tasks", "2", "-o", path("job")}}) {
    const Outcome outcome = below_root(command);
    EXPECT_EQ(outcome.code, kBadScene) << command[0] << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(error)) << command[0];
    EXPECT_THAT(outcome.err, HasSubstr("Include \"../secret.txt\"\n        ^")) << command[0];
  }
}

TEST_F(RootOption, TheSkyLiesInsideByAnyNameOfItsFolder) {
  const std::string s = scene("");
  fs::create_symlink(path("root"), path("way"));
  const std::string image = "PF\n1 1\n-1\n" + std::string(12, '\0');
  for (const char* sky : {"root/sky.pfm", "sky.pfm"}) write(sky, image);
  for (const char* sky : {"root/sky.pfm", "way/sky.pfm"})
    EXPECT_EQ(below_root({"info", s, "--sky", path(sky)}).code, kDone) << sky;
  const Outcome outcome = below_root({"info", s, "--sky", path("sky.pfm")});
  EXPECT_EQ(outcome.code, kBadScene);
  EXPECT_THAT(outcome.err, HasSubstr("it lies outside --root"));
}

TEST_F(RootOption, FilesOutsideAreNotQuotedWithoutIt) {
  const Outcome outcome = run_kaustik({"info", scene("", "Include \"../secret.txt\"")});
  EXPECT_EQ(outcome.code, kBadScene);
  EXPECT_THAT(outcome.err, HasSubstr("is not a pbrt scene"));
  EXPECT_THAT(outcome.err, Not(HasSubstr("password")));
}

TEST_F(RootOption, TheFolderMustExist) {
  for (const std::string& folder : {path("none"), path("secret.txt")}) {
    const Outcome outcome = run_kaustik({"info", scene(""), "--root", folder});
    EXPECT_EQ(outcome.code, kBadCommandLine);
    EXPECT_THAT(outcome.err, HasSubstr("--root: cannot read the folder \"" + folder + "\""));
  }
}

TEST_F(RootOption, ScenesNameOutputsInsideAlone) {
  EXPECT_EQ(run({"render", scene_that_names_output(path("root/a.exr")), "--root", path("root")}, draft_).code,
            kDone);
  EXPECT_TRUE(exists("root/a.exr"));
  fs::create_symlink(path(""), path("root/out"));
  for (const std::string& output : {path("b.exr"), path("root/../b.exr"), path("root/out/b.exr")}) {
    const std::string s = scene_that_names_output(output);
    const Outcome outcome = run({"render", s, "--root", path("root")}, draft_);
    EXPECT_EQ(outcome.code, kBadScene);
    EXPECT_THAT(outcome.err, HasSubstr("names the output \"" + output + "\": it lies outside --root"));
    EXPECT_FALSE(exists("b.exr"));
  }
  // By another name of the folder, too.
  fs::create_symlink(path("root"), path("way"));
  EXPECT_EQ(run({"render", scene_that_names_output(path("way/c.exr")), "--root", path("root")}, draft_).code,
            kDone);
  EXPECT_TRUE(exists("root/c.exr"));
  // What the command line names is its user's choice.
  EXPECT_EQ(run({"render", path("root/s.pbrt"), "-o", path("b.exr"), "--root", path("root")}, draft_).code,
            kDone);
  EXPECT_TRUE(exists("b.exr"));
}

TEST_F(RootOption, PartialResultsNameFilesInsideAlone) {
  const Arguments render = {"render", scene(""), "--passes", "2", "--pass-range", "0:1"};
  const auto make = [&](const std::string& output, Arguments more) {
    more.insert(more.end(), {"--checkpoint", path("a.kpart"), "-o", output});
    more.insert(more.end(), draft_.begin(), draft_.end());
    ASSERT_EQ(run(render, more).code, kDone);
  };
  const auto resume = [&](const Arguments& more = {}) {
    return run({"resume", path("a.kpart"), "-q", "--root", path("root")}, more);
  };
  make(path("b.exr"), {});
  fs::remove(path("b.exr"));
  EXPECT_THAT(resume().err, HasSubstr("a.kpart names the output \"" + path("b.exr") + "\": it lies outside"));
  EXPECT_FALSE(exists("b.exr"));
  EXPECT_EQ(resume({"-o", path("c.exr"), "--passes", "2"}).code, kDone);
  make(path("root/b.exr"), {});
  EXPECT_EQ(resume({"--passes", "2"}).code, kDone);
  write("sky.ppm", "P6\n4 4\n255\n" + std::string(48, 'a'));
  make(path("root/b.exr"), {"--sky", path("sky.ppm")});
  const Outcome outcome = resume();
  EXPECT_EQ(outcome.code, kBadScene);
  EXPECT_THAT(outcome.err, HasSubstr("sky.ppm\": it lies outside --root"));
}

TEST_F(RootOption, TasksOfAJobHaveIt) {
  const Outcome outcome = run({"split", scene(""), "--tasks", "2", "-o", path("job"), "--root", path("root")},
                              {"--photons", "1k", "--spp", "2", "-q"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_THAT(read("job/task.sh"), HasSubstr("root=(--root " + path("root") + ")\n"));
}

}  // namespace
}  // namespace kaustik::app
