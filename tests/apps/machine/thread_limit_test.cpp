// Tests that the program runs where the system does not let it start threads.

#include "apps/machine/thread_limit.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using ::testing::HasSubstr;

class ThreadLimit : public test::ProgramTest {};

TEST_F(ThreadLimit, CountsTheThreadsThatCanBeStarted) {
  EXPECT_EQ(startable_threads(1), 1);
  EXPECT_EQ(startable_threads(2), 2);
  EXPECT_EQ(startable_threads(40), 40);
  EXPECT_EQ(startable_threads(3), 3);
}

// Runs the program as a user who may have `processes` processes and threads. Returns its exit code, -1 if a
// signal ended it, or 127 if this user cannot start it. Root has no such limit and becomes another user.
int run_with_limit(const std::vector<std::string>& arguments, rlim_t processes, const std::string& log) {
  std::vector<std::string> texts = {KAUSTIK_PROGRAM};
  texts.insert(texts.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& text : texts) argv.push_back(text.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    constexpr uid_t kNobody = 65534;
    const rlimit limit{processes, processes};
    const bool ready = freopen(log.c_str(), "w", stderr) != nullptr &&
                       (geteuid() != 0 || setuid(kNobody) == 0) && setrlimit(RLIMIT_NPROC, &limit) == 0;
    // The leak sanitizer could not start the process by which it searches.
    const char* const sanitizer = getenv("ASAN_OPTIONS");
    setenv("ASAN_OPTIONS", ((sanitizer ? sanitizer + std::string(":") : "") + "detect_leaks=0").c_str(), 1);
    if (ready) execv(KAUSTIK_PROGRAM, argv.data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST_F(ThreadLimit, FewerThreadsRenderWithAWarning) {
  namespace fs = std::filesystem;
  const std::string scene = small_scene(film(40, 40));
  fs::permissions(path("."), fs::perms::all);
  const int code = run_with_limit(
      {"render", scene, "-o", path("a.exr"), "--photons", "2k", "--spp", "1", "--threads", "16", "-q"}, 3,
      path("log"));
  if (code == 127) GTEST_SKIP() << "another user cannot start the program";
  EXPECT_EQ(code, kDone) << read("log");
  EXPECT_TRUE(exists("a.exr"));
  EXPECT_THAT(read("log"), HasSubstr("of 16 threads"));
}

}  // namespace
}  // namespace kaustik::app
