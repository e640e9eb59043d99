// Tests --isa: what it pins is what the files say, and machines of different kinds can merge their parts.

#include <gmock/gmock.h>

#include "apps/machine/instruction_set.h"
#include "render/passes/partial_result.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using test::Outcome;
using test::run_kaustik;
using ::testing::HasSubstr;

class InstructionSets : public test::ProgramTest {
 protected:
  ~InstructionSets() override { pin_instruction_set("native"); }  // the pin is state of the process
  Outcome render(std::vector<std::string> more) const {
    more.insert(more.begin(), {"render", scene_, "--spp", "2", "--photons", "5k", "--passes", "2"});
    return run_kaustik(more);
  }
  static bool has(const char* name) {
    try {
      pin_instruction_set(name);
      return true;
    } catch (const std::invalid_argument&) {
      return false;
    }
  }
  std::string isa_of(const std::string& name) const { return render::read_partial(path(name)).manifest.isa; }

  std::string scene_ = small_scene(film(24, 16));
};

// A machine of AVX2 alone has this text without a pin.
TEST_F(InstructionSets, PinnedPartsSayWhatTheyUsed) {
  if (!has("avx2")) GTEST_SKIP() << "this machine has no AVX2";
  EXPECT_EQ(render({"--isa", "avx2", "--pass-range", "0:1", "-o", path("a.kpart")}).code, kDone);
  EXPECT_EQ(isa_of("a.kpart"), "AVX2 (avx fma avx2)");
  EXPECT_EQ(render({"--isa", "avx2", "--pass-range", "1:2", "-o", path("b.kpart")}).code, kDone);
  EXPECT_EQ(run_kaustik({"merge", path("a.kpart"), path("b.kpart"), "-o", path("merged.exr")}).code, kDone);
  EXPECT_EQ(render({"--isa", "avx2", "-o", path("whole.exr")}).code, kDone);
  EXPECT_TRUE(read("merged.exr") == read("whole.exr"));
}

TEST_F(InstructionSets, PartsOfOtherOnesAreRefusedWithThePin) {
  if (!has("avx512")) GTEST_SKIP() << "this machine has no AVX-512";
  EXPECT_EQ(render({"--isa", "avx512", "--pass-range", "0:1", "-o", path("a.kpart")}).code, kDone);
  EXPECT_EQ(render({"--isa", "avx2", "--pass-range", "1:2", "-o", path("b.kpart")}).code, kDone);
  const Outcome outcome = run_kaustik({"merge", path("a.kpart"), path("b.kpart"), "-o", path("merged.exr")});
  EXPECT_EQ(outcome.code, kBadCommandLine);
  EXPECT_THAT(outcome.err, HasSubstr("with --isa avx2 both machines give the same bits"));
}

TEST_F(InstructionSets, ThatDoNotExistAreRefused) {
  const Outcome outcome = render({"--isa", "avx3", "-o", path("a.exr")});
  EXPECT_EQ(outcome.code, kBadCommandLine);
  EXPECT_THAT(outcome.err, HasSubstr("`avx3`: expected one of native, avx512, avx2"));
}

}  // namespace
}  // namespace kaustik::app
