// `--preview` in terminals that the test plays: what they are asked, what they show in the end, and what is
// left of it.

#include "apps/live/terminal_preview.h"

#include <gmock/gmock.h>

#include <csignal>

#include "render/picture/image_io.h"
#include "tests/apps/live/support/decoders.h"
#include "tests/apps/live/support/played_terminal.h"
#include "tests/apps/live/support/screen_model.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using namespace std::chrono_literals;
using test::PlayedTerminal;
using test::ScreenModel;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr winsize kSize{24, 80, 800, 480};

class TerminalPreviewTest : public test::WithTerminals<test::ProgramTest> {
 protected:
  // A picture of 48 x 30 pixels, which no terminal has to shrink.
  std::vector<std::string> render(const std::string& output,
                                  const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {
        "render",   small_scene(film(48, 30)), "-o", path(output), "--spp", "4", "--photons", "20k",
        "--preview"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  // The terminal's text when the program has ended.
  static ScreenModel after(const PlayedTerminal& terminal, pid_t program, int code = 0,
                           const winsize& size = kSize) {
    EXPECT_EQ(terminal.wait(program), code);
    ScreenModel model(size.ws_col, size.ws_row);
    std::string text = terminal.shown();
    // The terminal's driver ends lines by both.
    for (size_t at = 0; (at = text.find("\r\n", at)) != std::string::npos;) text.erase(at, 1);
    model.write(text);
    // It also shows ^C wherever it is typed, even amid a sequence.
    for (const std::string& unknown : model.unknown()) EXPECT_THAT(unknown, HasSubstr("^"));
    EXPECT_TRUE(terminal.settings_are_restored());
    EXPECT_EQ(terminal.typed_for_the_next(), "");
    EXPECT_EQ(model.cursor_column(), 0u);
    EXPECT_EQ(model.text(model.cursor_line()), "");
    return model;
  }
  // All that is text: lines of the log, none of them torn.
  static void expect_whole_lines(const ScreenModel& model, bool files = true) {
    bool wrote = false;
    for (size_t i = 0; i < model.lines(); ++i) {
      const std::string text = model.text(i);
      wrote |= text.starts_with("wrote ");
      EXPECT_THAT(text, Not(HasSubstr("ETA"))) << "a progress line is left";
      EXPECT_TRUE(text.find("\u2580") == std::string::npos || text.starts_with("\u2580")) << text;
    }
    EXPECT_TRUE(wrote || !files);
  }
  Pixels8 png(const std::string& name) const {
    const render::Image image = render::read_image(path(name));
    Pixels8 pixels(image.width, image.height);
    for (size_t i = 0; i < pixels.colours.size(); ++i)
      pixels.colours[i] = render::to_srgb8(image.pixels[i], {});
    return pixels;
  }
};

TEST_F(TerminalPreviewTest, KittyShowsThePixelsOfThePng) {
  const PlayedTerminal terminal({test::kKittyAnswer}, kSize);
  const ScreenModel model = after(terminal, terminal.start(render("a.png")));
  ASSERT_EQ(model.graphics().size(), 1u);
  test::KittyImage image = test::decoded_kitty(model.graphics()[0].bytes);
  EXPECT_EQ(image.pixels.width, 48);
  EXPECT_EQ(image.pixels.colours, png("a.png").colours);
  EXPECT_FALSE(image.keys.contains("c"));
  expect_whole_lines(model);
  // 30 pixels are two lines of 20; the picture is the last that there is.
  EXPECT_EQ(model.cursor_line(), model.graphics()[0].line + 2);
}

TEST_F(TerminalPreviewTest, SixelsShowThePictureToTheirPalette) {
  const PlayedTerminal terminal({test::kSixelAnswer}, kSize);
  const ScreenModel model = after(terminal, terminal.start(render("a.png")));
  ASSERT_EQ(model.graphics().size(), 1u);
  const test::SixelDecoder image(model.graphics()[0].bytes);
  const Pixels8 expected = png("a.png");
  ASSERT_EQ(image.pixels().width, 48);
  ASSERT_EQ(image.pixels().height, 30);
  for (size_t i = 0; i < expected.colours.size(); ++i)
    for (size_t c = 0; c < 3; ++c)  // one level, and rounded percents
      ASSERT_NEAR(image.pixels().colours[i][c], expected.colours[i][c],
                  255 * (c == 1 ? 1 / 6.0 : 1 / 5.0) + 2);
  expect_whole_lines(model);
}

TEST_F(TerminalPreviewTest, OthersShowHalfBlocks) {
  for (const std::string& answer : {test::kPlainAnswer, std::string()}) {
    const PlayedTerminal terminal({answer}, kSize);
    const ScreenModel model = after(terminal, terminal.start(render("a.png")));
    EXPECT_EQ(model.half_blocks().width, 48);
    EXPECT_EQ(model.half_blocks().colours, png("a.png").colours);
    expect_whole_lines(model);
    EXPECT_EQ(model.text(model.cursor_line() - 1).substr(0, 3), "\u2580");
  }
}

// A slow line, or a busy machine.
TEST_F(TerminalPreviewTest, AnswersMayTakeAWhile) {
  const PlayedTerminal terminal({test::kKittyAnswer, 400ms}, kSize);
  EXPECT_EQ(after(terminal, terminal.start(render("a.png"))).graphics().size(), 1u);
}

TEST_F(TerminalPreviewTest, AnswersThatAreLateAreTakenAway) {
  const PlayedTerminal terminal({test::kKittyAnswer, 2500ms}, kSize);
  EXPECT_EQ(terminal.wait(terminal.start(render("a.png", {"--time", "5s", "--passes", "400"}))), 0);
  EXPECT_TRUE(terminal.settings_are_restored());
  EXPECT_EQ(terminal.typed_for_the_next(), "");
}

TEST_F(TerminalPreviewTest, ATinyTerminalShowsASmallPictureOrNone) {
  const winsize small{9, 20, 0, 0}, tiny{2, 80, 0, 0};
  const PlayedTerminal terminal({test::kPlainAnswer}, small);
  const ScreenModel model = after(terminal, terminal.start(render("a.png")), 0, small);
  EXPECT_EQ(model.half_blocks().width, 19);  // 6 lines are 12 pixels, and 12 * 48 / 30 = 19.2
  EXPECT_EQ(model.half_blocks().height, 12);
  const PlayedTerminal none({test::kPlainAnswer}, tiny);
  EXPECT_EQ(after(none, none.start(render("b.png")), 0, tiny).half_blocks().width, 0);
}

TEST_F(TerminalPreviewTest, NoColorAllowsPicturesOnly) {
  const PlayedTerminal plain({test::kPlainAnswer}, kSize), kitty({test::kKittyAnswer}, kSize);
  const ScreenModel without = after(plain, plain.start(render("a.png"), {"NO_COLOR=1"}));
  EXPECT_EQ(without.half_blocks().width, 0);
  EXPECT_THAT(plain.shown(), HasSubstr("warning: --preview shows nothing: "));
  EXPECT_THAT(plain.shown(), HasSubstr("NO_COLOR"));
  const ScreenModel with = after(kitty, kitty.start(render("b.png"), {"NO_COLOR=1"}));
  EXPECT_EQ(with.graphics().size(), 1u);
  const PlayedTerminal unset({test::kPlainAnswer}, kSize);
  EXPECT_EQ(after(unset, unset.start(render("c.png"), {"NO_COLOR="})).half_blocks().width, 48);
}

TEST_F(TerminalPreviewTest, ElsewhereAWarningSaysWhyNothingIsShown) {
  const test::Outcome outcome = test::run_kaustik(render("a.png"));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("warning: --preview shows nothing: the error stream is not a terminal"));
  EXPECT_THAT(outcome.err, Not(HasSubstr("\x1b")));
  const PlayedTerminal dumb({test::kKittyAnswer}, kSize);
  after(dumb, dumb.start(render("b.png"), {"TERM=dumb"}));
  EXPECT_THAT(dumb.shown(), HasSubstr("TERM=dumb"));
  EXPECT_THAT(dumb.shown(), Not(HasSubstr("\x1b")));
}

TEST_F(TerminalPreviewTest, TheFilesAreThoseOfARenderWithout) {
  const PlayedTerminal terminal({test::kKittyAnswer}, kSize);
  std::vector<std::string> arguments =
      render("a.exr", {"-o", path("a.png"), "--passes", "3", "--aov", "all", "--threads", "2"});
  after(terminal, terminal.start(arguments));
  const std::string layers = read("a.exr"), picture = read("a.png");
  EXPECT_GT(layers.size(), 1000u);
  std::erase(arguments, "--preview");
  EXPECT_EQ(test::run_kaustik(arguments).code, 0);
  EXPECT_TRUE(read("a.exr") == layers);
  EXPECT_TRUE(read("a.png") == picture);
}

// At no time does a line hold parts of two of them, or is there a second progress line.
TEST_F(TerminalPreviewTest, PictureProgressAndLogDoNotTearEachOther) {
  PlayedTerminal terminal({test::kPlainAnswer}, kSize);
  const pid_t program = terminal.start(render("a.png", {"--time", "3s", "--passes", "400", "--checkpoint",
                                                        path("c.kpart"), "--checkpoint-every", "0s"}));
  EXPECT_TRUE(terminal.has_shown("\u2580"));
  const ScreenModel model = after(terminal, program);
  EXPECT_EQ(model.half_blocks().colours, png("a.png").colours);
  expect_whole_lines(model);
  const std::string shown = terminal.shown();
  ScreenModel past(kSize.ws_col, kSize.ws_row);
  int looks = 0;
  for (size_t at = 0, end = 0; end != std::string::npos; at = end, ++looks) {
    end = shown.find("\x1b[?2026l", at + 1);
    past.write(shown.substr(at, end == std::string::npos ? end : end - at));
    int progress = 0;
    for (size_t i = 0; i < past.lines(); ++i) {
      const std::string text = past.text(i);
      const bool picture = text.find("\u2580") != std::string::npos;
      ASSERT_TRUE(!picture || text.find_first_not_of("\u2580") == std::string::npos) << text;
      progress += text.starts_with("render ") || text.starts_with("photons ");
    }
    ASSERT_LE(progress, 1);
  }
  EXPECT_GT(looks, 3);
}

TEST_F(TerminalPreviewTest, FollowsTheSizeOfTheTerminal) {
  PlayedTerminal terminal({test::kPlainAnswer}, kSize);
  const pid_t program = terminal.start(render("a.png", {"--time", "4s", "--passes", "400"}));
  EXPECT_TRUE(terminal.has_shown("\u2580"));
  const winsize lower{12, 80, 800, 240};
  terminal.resize(lower);
  EXPECT_EQ(terminal.wait(program), 0);
  // The last place is that of 8 lines: all moves up from below it go as far.
  const std::string shown = terminal.shown();
  EXPECT_THAT(shown.substr(shown.rfind("\x1b[?2026h")), HasSubstr("\r\x1b[8A"));
}

TEST_F(TerminalPreviewTest, AnInterruptedRenderKeepsItsPictureAndTheTerminal) {
  const PlayedTerminal terminal({test::kPlainAnswer}, kSize);
  const pid_t program =
      terminal.start(render("a.png", {"--passes", "2000", "--spp", "200000", "--denoise", "off"}));
  EXPECT_TRUE(terminal.has_shown("\u2580"));
  terminal.type("\x03");
  const ScreenModel model = after(terminal, program, 130);
  EXPECT_EQ(model.half_blocks().width, 48);
  EXPECT_EQ(model.half_blocks().height, 30);
  expect_whole_lines(model, false);
  EXPECT_THAT(terminal.shown(), HasSubstr("interrupted"));
}

// A terminal that stops reading holds up neither the render nor its progress.
TEST_F(TerminalPreviewTest, ATerminalThatTakesNothingDoesNotStopTheRender) {
  PlayedTerminal terminal({"", 0ms, false}, kSize);
  const pid_t program = terminal.start(
      render("a.png", {"--width", "400", "--height", "300", "--time", "4s", "--passes", "400", "--quiet"}));
  EXPECT_TRUE(PlayedTerminal::eventually([&] { return exists("a.png"); }));
  terminal.read_on();
  EXPECT_EQ(terminal.wait(program), 0);
}

}  // namespace
}  // namespace kaustik::app
