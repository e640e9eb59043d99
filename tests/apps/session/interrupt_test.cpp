#include "apps/session/interrupt.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "apps/console/exit_code.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

TEST(Interrupt, SignalsThatEndAProgramAreFlags) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    const InterruptGuard guard;
    EXPECT_FALSE(guard.requested());
    std::raise(signal);
    EXPECT_TRUE(guard.requested()) << signal;
  }
}

// The system repeats the signal every second.
TEST(Interrupt, TheLimitOfProcessorTimeMayBeSignalledAgain) {
  const InterruptGuard guard;
  std::raise(SIGXCPU);
  std::raise(SIGXCPU);
  EXPECT_TRUE(guard.requested());
}

// `nohup` ignores SIGHUP, and shells ignore SIGINT for jobs in the background.
TEST(Interrupt, IgnoredSignalsStayIgnored) {
  const auto previous = std::signal(SIGHUP, SIG_IGN);
  {
    const InterruptGuard guard;
    std::raise(SIGHUP);
    EXPECT_FALSE(guard.requested());
  }
  EXPECT_EQ(std::signal(SIGHUP, previous), SIG_IGN);
}

using InterruptedProgram = test::ProgramTest;

// Who reads the messages goes away after their first byte: the render ends as by a signal, writes the picture
// as far as it is and leaves nothing else.
TEST_F(InterruptedProgram, EndsWhenNobodyReadsItsMessages) {
  const std::string command = "( " KAUSTIK_PROGRAM " render " + small_scene(film(64, 64)) +
                              " --spp 100000000 --photons 1000 --threads 2 -o " + path("a.exr") +
                              "; echo $? > " + path("code") + " ) 2>&1 | head -c 1 > " + path("log");
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(read("code"), std::to_string(int(kInterrupted)) + "\n");
  for (const std::string& file : files())
    EXPECT_TRUE(file == "a.exr" || file == "code" || file == "log" || file == "small.pbrt") << file;
}

}  // namespace
}  // namespace kaustik::app
