// Tests `render --denoise` and `kaustik denoise` from the outside.

#include <gmock/gmock.h>

#include "render/picture/exr_file.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using test::Outcome;
using test::run_kaustik;
using ::testing::HasSubstr;

class DenoiseCommand : public test::ProgramTest {
 protected:
  // Renders to NAME.exr and returns the log.
  std::string render(const std::string& name, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"render", scene_, "--photons", "5k", "-o", path(name)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run_kaustik(arguments);
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return outcome.err;
  }
  render::ExrChannels channels(const std::string& name) const {
    return render::read_exr_file(path(name), 1 << 20);
  }
  bool is_denoised(const std::string& name) const { return channels(name).find("noisy.R") != nullptr; }
  // The values of a channel, which the file must have.
  std::vector<float> values(const std::string& name, const std::string& channel) const {
    const render::ExrChannels file = channels(name);
    const std::vector<float>* const found = file.find(channel);
    EXPECT_NE(found, nullptr) << channel;
    return found ? *found : std::vector<float>{};
  }

  std::string scene_ = small_scene(film(40, 30));
};

TEST_F(DenoiseCommand, FiltersThePictureAndKeepsTheLayers) {
  render("off.exr", {"--spp", "4", "--denoise", "off", "--aov", "direct"});
  render("on.exr", {"--spp", "4", "--denoise", "on", "--aov", "direct"});
  EXPECT_FALSE(is_denoised("off.exr"));
  EXPECT_EQ(values("on.exr", "noisy.G"), values("off.exr", "G"));
  EXPECT_EQ(values("on.exr", "direct.G"), values("off.exr", "direct.G"));
  EXPECT_NE(values("on.exr", "G"), values("off.exr", "G"));
}

TEST_F(DenoiseCommand, AnyNumberOfThreadsGivesTheSameBytes) {
  render("one.exr", {"--spp", "4", "--denoise", "on", "--threads", "1"});
  render("three.exr", {"--spp", "4", "--denoise", "on", "--threads", "3"});
  EXPECT_EQ(read("one.exr"), read("three.exr"));
}

TEST_F(DenoiseCommand, IsOnForFewSamplesAlone) {
  render("few.exr", {"--spp", "4"});
  EXPECT_TRUE(is_denoised("few.exr"));
  const std::vector<std::vector<std::string>> not_denoised = {{"--spp", "257", "--width", "8"},
                                                              {"--spp", "4", "--passes", "2"},
                                                              {"--spp", "4", "--crop", "0", "20", "0", "20"},
                                                              {"--spp", "4", "--method", "mc"},
                                                              {"--spp", "4", "-o", path("part.kpart")}};
  for (const auto& options : not_denoised) {
    render("raw.exr", options);
    EXPECT_FALSE(is_denoised("raw.exr")) << ::testing::PrintToString(options);
  }
}

TEST_F(DenoiseCommand, OneSampleIsNotEnough) {
  EXPECT_THAT(render("one.exr", {"--spp", "1", "--adaptive", "0"}), HasSubstr("not denoised"));
  EXPECT_FALSE(is_denoised("one.exr"));
}

TEST_F(DenoiseCommand, MergedPassesGiveTheBitsOfOneRender) {
  const std::vector<std::string> options = {"--spp", "8", "--passes", "4", "--denoise", "on"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), options.begin(), options.end());
    return more;
  };
  render("whole.exr", options);
  ASSERT_TRUE(is_denoised("whole.exr"));
  render("a.kpart", with({"--pass-range", "0:1"}));
  render("b.kpart", with({"--pass-range", "1:4"}));
  const Outcome merged =
      run_kaustik({"merge", path("b.kpart"), path("a.kpart"), "-o", path("merged.exr"), "-q"});
  ASSERT_EQ(merged.code, kDone) << merged.err;
  for (const char* channel : {"R", "G", "B", "noisy.R"})
    EXPECT_EQ(values("merged.exr", channel), values("whole.exr", channel));
}

// A file that holds all that the render knew gives what the render would have written.
TEST_F(DenoiseCommand, OfAFileGivesThePictureOfTheRender) {
  render("on.exr", {"--spp", "4", "--denoise", "on"});
  render("raw.exr", {"--spp", "4", "--denoise", "off", "--aov", "denoising"});
  const Outcome outcome =
      run_kaustik({"denoise", path("raw.exr"), "-o", path("later.exr"), "-o", path("later.png")});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_EQ(values("later.exr", "R"), values("on.exr", "R"));
  EXPECT_EQ(values("later.exr", "noisy.R"), values("on.exr", "noisy.R"));
  EXPECT_EQ(values("later.exr", "direct.R"), values("raw.exr", "direct.R"));
  EXPECT_TRUE(exists("later.png"));
}

TEST_F(DenoiseCommand, OfAPictureAloneSaysWhatItLacks) {
  render("raw.exr", {"--spp", "4", "--denoise", "off", "--aov", "albedo"});
  const Outcome outcome = run_kaustik({"denoise", path("raw.exr"), "-o", path("out.exr")});
  EXPECT_EQ(outcome.code, kDone);
  EXPECT_THAT(outcome.err, HasSubstr("its noise is estimated"));
  EXPECT_THAT(outcome.err, HasSubstr("no layer of normal"));
  EXPECT_NE(values("out.exr", "R"), values("raw.exr", "R"));
}

TEST_F(DenoiseCommand, RefusesWhatIsNoPicture) {
  write("text.exr", "not a picture");
  const Outcome outcome = run_kaustik({"denoise", path("text.exr"), "-o", path("out.exr")});
  EXPECT_EQ(outcome.code, kBadCommandLine);
  EXPECT_THAT(outcome.err, HasSubstr("text.exr"));
  EXPECT_FALSE(exists("out.exr"));
  EXPECT_EQ(run_kaustik({"denoise", path("text.exr")}).code, kBadCommandLine);
  EXPECT_EQ(run_kaustik({"denoise", path("text.exr"), "-o", path("text.exr")}).code, kBadCommandLine);
}

}  // namespace
}  // namespace kaustik::app
