// Tests jobs that are divided into tasks: their scripts, run by the shell, give the files of one render, byte
// for byte, whatever is killed on the way. scripts/check-slurm does the same under Slurm.

#include <gmock/gmock.h>

#include <cstdlib>

#include "apps/cluster/job_scripts.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using test::Outcome;
using test::run_kaustik;
using ::testing::HasSubstr;
using ::testing::Not;

using Arguments = std::vector<std::string>;

class DividedRenders : public test::ProgramTest {
 protected:
  Outcome split(const Arguments& more = {}, const std::string& engine = "shell",
                const std::string& tasks = "3") const {
    Arguments all = {"split", scene_, "--tasks", tasks, "-o", path("the job"), "--engine", engine};
    all.insert(all.end(), settings_.begin(), settings_.end());
    all.insert(all.end(), more.begin(), more.end());
    return run_kaustik(all);
  }
  // Runs a script of the job's folder; returns its exit code.
  int run(const std::string& script) const {
    const std::string command = "KAUSTIK='" KAUSTIK_PROGRAM "' '" + path("the job") + "'/" + script + " > '" +
                                path("log.txt") + "' 2>&1";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string status() const { return run_kaustik({"status", path("the job")}).out; }
  void render_whole() const {
    Arguments all = {"render", scene_, "-o", path("whole.exr")};
    all.insert(all.end(), settings_.begin(), settings_.end());
    EXPECT_EQ(run_kaustik(all).code, kDone);
  }
  void expect_refused(const Outcome& outcome, const std::string& text) const {
    EXPECT_EQ(outcome.code, kBadCommandLine);
    EXPECT_THAT(outcome.err, HasSubstr(text));
  }

  std::string scene_ = small_scene(film(24, 16));
  Arguments settings_ = {"--photons", "24k", "--spp", "8", "--passes", "8", "--alpha", "0.8"};
};

TEST_F(DividedRenders, GiveTheFilesOfOneRender) {
  render_whole();
  EXPECT_EQ(split().code, kDone);
  EXPECT_EQ(run("run.sh"), 0) << read("log.txt");
  EXPECT_TRUE(read("the job/small.exr") == read("whole.exr"));
  EXPECT_TRUE(exists("the job/small.png"));
  EXPECT_EQ(status(),
            "8 of 8 passes done in 3 of 3 tasks\n'" + path("the job") + "'/merge.sh writes the picture\n");
}

TEST_F(DividedRenders, GoOnWithTasksThatAreMissing) {
  render_whole();
  EXPECT_EQ(split().code, kDone);
  EXPECT_EQ(run("task.sh 1"), 0) << read("log.txt");
  setenv("SLURM_JOB_ID", "5", 1);  // as within another job
  EXPECT_EQ(run("task.sh 1"), 0) << read("log.txt");
  unsetenv("SLURM_JOB_ID");
  EXPECT_EQ(run("merge.sh"), kBadCommandLine);
  EXPECT_THAT(read("log.txt"), HasSubstr("passes 0:2,5:8 of 8 are missing"));
  EXPECT_THAT(read("log.txt"), HasSubstr("task 2: 0 of 3 passes done, missing 5:8"));
  EXPECT_THAT(read("log.txt"), HasSubstr("missing passes 0:2,5:8: ./task.sh 0 && ./task.sh 2 && ./merge.sh"));
  EXPECT_FALSE(exists("the job/small.exr"));
  EXPECT_EQ(run("task.sh 0"), 0);
  EXPECT_EQ(run("task.sh 2"), 0);
  EXPECT_EQ(run("task.sh 2"), 0);  // again: nothing is left to do
  EXPECT_EQ(run("merge.sh -o other.exr"), 0) << read("log.txt");
  EXPECT_TRUE(read("the job/other.exr") == read("whole.exr"));
}

TEST_F(DividedRenders, FindDamagedParts) {
  EXPECT_EQ(split().code, kDone);
  EXPECT_EQ(run("task.sh 0"), 0);
  std::filesystem::resize_file(path("the job/parts/0.kpart"), 1000);
  EXPECT_THAT(status(), HasSubstr("task 0: 0 of 2 passes done, missing 0:2; "));
  EXPECT_THAT(status(), HasSubstr("0.kpart"));
}

// The radii of the first pass are settled once: a task that does not begin with it shoots its own photons
// only.
TEST_F(DividedRenders, SettleTheRadiiOnce) {
  EXPECT_EQ(split().code, kDone);
  const auto resume = [&](const std::string& range, const std::string& name) {
    return run_kaustik(
        {"resume", path("the job/start.kpart"), "--pass-range", range, "--checkpoint", path(name)});
  };
  EXPECT_EQ(resume("4:6", "part.kpart").code, kDone);
  const render::PassSums part = render::read_partial(path("part.kpart")).sums;
  EXPECT_EQ(part.radii, render::read_partial(path("the job/start.kpart")).sums.radii);
  EXPECT_TRUE(part.radii);
  EXPECT_EQ(part.passes.text(), "4:6");
  expect_refused(resume("4:9", "other.kpart"), "asks for passes 0:8");
  expect_refused(resume("4:5", "the job/start.kpart"), "start.kpart");
  expect_refused(resume("4:5", "small.pbrt"), "small.pbrt");
  expect_refused(run_kaustik({"resume", path("the job/start.kpart"), "--pass-range", "4:5", "--checkpoint",
                              path("x.kpart"), "--time", "1s"}),
                 "--pass-range cannot be combined with");
  expect_refused(run_kaustik({"resume", path("the job/start.kpart"), "--pass-range", "4:6"}), "--checkpoint");
}

TEST_F(DividedRenders, HaveScriptsForSlurm) {
  EXPECT_EQ(split({}, "slurm").code, kDone);
  EXPECT_THAT(read("the job/submit.sh"),
              HasSubstr("--array=\"${TASKS:-0-2}\" --requeue --signal=B:TERM@120"));
  EXPECT_FALSE(exists("the job/run.sh"));
  EXPECT_EQ(run("task.sh 0"), 0) << read("log.txt");
  EXPECT_THAT(status(), HasSubstr("missing passes 2:8: TASKS=1,2 "));
}

// Without --passes, a task has up to four.
TEST_F(DividedRenders, HavePassesForEveryTask) {
  settings_ = {"--photons", "24k", "--spp", "8"};
  EXPECT_EQ(split().code, kDone);
  EXPECT_THAT(status(), HasSubstr("0 of 6 passes done in 0 of 3 tasks"));
}

TEST_F(DividedRenders, WithoutMeaningAreRefused) {
  expect_refused(split({}, "shell", "9"), "there are only 8 passes to divide");
  expect_refused(split({"--time", "3s"}), "cannot be divided among tasks");
  expect_refused(split({}, "shell", "0"), "expected a whole number");
  expect_refused(split({}, "slurn"), "slurm");
  expect_refused(run_kaustik({"split", scene_, "-o", path("x")}), "--tasks is required");
  expect_refused(run_kaustik({"split", scene_, "--tasks", "2"}), "-o is required");
  EXPECT_FALSE(exists("the job"));
  EXPECT_EQ(split().code, kDone);
  expect_refused(split(), "the folder exists and is not empty");
  expect_refused(run_kaustik({"status", path("none")}), "not a folder that `kaustik split` has written");
  write("the job/job.json", "{}");
  expect_refused(run_kaustik({"status", path("the job")}), "not a folder that `kaustik split` has written");
  expect_refused(run_kaustik({"merge", path("the job/start.kpart"), "-o", path("a.exr")}),
                 "no part holds any pass");
}

TEST(JobScripts, QuoteWhatTheShellWouldRead) {
  EXPECT_EQ(quoted("/usr/bin/kaustik-1.0_x"), "/usr/bin/kaustik-1.0_x");
  EXPECT_EQ(quoted("a b"), "'a b'");
  EXPECT_EQ(quoted(""), "''");
  EXPECT_EQ(quoted("it's $HOME"), "'it'\\''s $HOME'");
}

}  // namespace
}  // namespace kaustik::app
