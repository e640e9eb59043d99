// Tests the program under a limit of its stack, `ulimit -s`.

#include <gmock/gmock.h>

#include <cstdlib>

#include "apps/console/exit_code.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using ::testing::HasSubstr;

class StackLimit : public test::ProgramTest {
 protected:
  // Renders with a stack of so many KB, and gives the exit code as text.
  std::string render(int kilobytes) const {
    const std::string command = "( ulimit -s " + std::to_string(kilobytes) + "; " KAUSTIK_PROGRAM " render " +
                                small_scene(film(16, 16)) + " --spp 1 --photons 1000 -o " + path("a.exr") +
                                "; echo $? > " + path("code") + " ) 2> " + path("log");
    EXPECT_EQ(std::system(command.c_str()), 0);
    return read("code");
  }
};

TEST_F(StackLimit, TooSmallAStackIsRefused) {
  EXPECT_EQ(render(512), std::to_string(int(kFailed)) + "\n");
  EXPECT_THAT(read("log"), HasSubstr("`ulimit -s`"));
  EXPECT_FALSE(exists("a.exr"));
}

TEST_F(StackLimit, AMegabyteSuffices) {
  EXPECT_EQ(render(1024), std::to_string(int(kDone)) + "\n") << read("log");
  EXPECT_TRUE(exists("a.exr"));
}

}  // namespace
}  // namespace kaustik::app
