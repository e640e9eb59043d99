// What a terminal is asked, and how it is treated while it is.

#include "apps/live/terminal/terminal_graphics.h"

#include <gtest/gtest.h>

#include <csignal>
#include <sstream>

#include "tests/apps/live/support/played_terminal.h"

namespace kaustik::app {
namespace {

using namespace std::chrono_literals;
using test::PlayedTerminal;

TEST(TerminalAnswers, AreReadAmongKeys) {
  EXPECT_EQ(read_answers(test::kKittyAnswer), (TerminalAnswers{true, false, 10, 20, true}));
  EXPECT_EQ(read_answers("ls\x1b[A" + test::kSixelAnswer + "\n"),
            (TerminalAnswers{false, true, 10, 20, true}));
  EXPECT_EQ(read_answers(test::kPlainAnswer), (TerminalAnswers{false, false, 0, 0, true}));
  EXPECT_EQ(read_answers("\x1b_Gi=31;ENOTSUPPORTED:no\x1b\\\x1b[?62;4c"),
            (TerminalAnswers{false, true, 0, 0, true}));
  // Not for the device attributes; a class of devices with the number of an attribute; parts of answers.
  EXPECT_EQ(read_answers("\x1b[>4;4c\x1b[4c"), TerminalAnswers());
  EXPECT_EQ(read_answers("\x1b[?4c"), (TerminalAnswers{false, false, 0, 0, true}));
  EXPECT_EQ(read_answers("\x1b[?62;4"), TerminalAnswers());
  EXPECT_EQ(read_answers("\x1b[?62;99999999999999999999;4c"), (TerminalAnswers{false, true, 0, 0, true}));
  EXPECT_EQ(read_answers(""), TerminalAnswers());
}

class TerminalDialogueTest : public test::WithTerminals<::testing::Test> {
 protected:
  // Writes what a screen sends to the terminal.
  class ToFile : public std::stringbuf {
   public:
    explicit ToFile(int file) : file_(file) {}
    int sync() override {
      const std::string text = str();
      EXPECT_EQ(::write(file_, text.data(), text.size()), ssize_t(text.size()));
      str("");
      return 0;
    }

   private:
    const int file_;
  };

  static TerminalAnswers asked(const PlayedTerminal& terminal, TerminalDialogue& dialogue,
                               std::chrono::milliseconds patience) {
    ToFile buffer(terminal.file());
    std::ostream stream(&buffer);
    Screen screen(stream);
    return dialogue.ask(screen, patience);
  }
  static constexpr winsize kSize{24, 80, 0, 0};
};

TEST_F(TerminalDialogueTest, ReadsTheAnswersAndRestoresTheSettings) {
  const PlayedTerminal terminal({test::kKittyAnswer}, kSize);
  TerminalDialogue dialogue(terminal.file());
  EXPECT_EQ(asked(terminal, dialogue, 10s), (TerminalAnswers{true, false, 10, 20, true}));
  EXPECT_NE(terminal.shown().find("\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\"), std::string::npos);
  EXPECT_EQ(terminal.shown().find("OK"), std::string::npos) << "the answer is echoed";
  EXPECT_TRUE(terminal.settings_are_restored());
  EXPECT_EQ(terminal.typed_for_the_next(), "");
}

TEST_F(TerminalDialogueTest, DoesNotWaitForASilentTerminal) {
  const PlayedTerminal terminal({""}, kSize);
  TerminalDialogue dialogue(terminal.file());
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(asked(terminal, dialogue, 200ms), TerminalAnswers());
  dialogue.await_rest(400ms);
  EXPECT_GE(std::chrono::steady_clock::now() - start, 400ms);
  EXPECT_LT(std::chrono::steady_clock::now() - start, 5s);
  EXPECT_TRUE(terminal.settings_are_restored());
}

TEST_F(TerminalDialogueTest, LateAnswersAreNotLeftForTheShell) {
  const PlayedTerminal terminal({test::kKittyAnswer, 300ms}, kSize);
  TerminalDialogue dialogue(terminal.file());
  EXPECT_FALSE(asked(terminal, dialogue, 50ms).complete);
  dialogue.await_rest(20s);
  EXPECT_TRUE(terminal.settings_are_restored());
  EXPECT_EQ(terminal.typed_for_the_next(), "");
}

// The answer has come while nobody listened.
TEST_F(TerminalDialogueTest, AnswersThatNobodyReadAreDropped) {
  const PlayedTerminal terminal({test::kKittyAnswer, 100ms}, kSize);
  TerminalDialogue dialogue(terminal.file());
  EXPECT_FALSE(asked(terminal, dialogue, 1ms).complete);
  EXPECT_TRUE(terminal.has_shown("OK"));  // echoed
  dialogue.await_rest(0ms);
  EXPECT_EQ(terminal.typed_for_the_next(), "");
}

volatile std::sig_atomic_t interrupts = 0;

TEST_F(TerminalDialogueTest, AnInterruptEndsTheWaitAndIsDelivered) {
  const PlayedTerminal terminal({""}, kSize);
  const auto previous = std::signal(SIGINT, [](int) { interrupts = interrupts + 1; });
  TerminalDialogue dialogue(terminal.file());
  std::thread keys([&] {
    terminal.has_shown("\x1b[c");
    terminal.type("\x03");
  });
  const auto start = std::chrono::steady_clock::now();
  asked(terminal, dialogue, 20s);
  EXPECT_LT(std::chrono::steady_clock::now() - start, 10s);
  keys.join();
  EXPECT_EQ(interrupts, 1);
  EXPECT_TRUE(terminal.settings_are_restored());
  std::signal(SIGINT, previous);
}

TEST_F(TerminalDialogueTest, WithoutATerminalNothingIsAsked) {
  std::ostringstream stream;
  Screen screen(stream);
  TerminalDialogue dialogue(-1);
  EXPECT_EQ(dialogue.ask(screen, 20s), TerminalAnswers());
  dialogue.await_rest(20s);
  EXPECT_EQ(stream.str(), "");
}

}  // namespace
}  // namespace kaustik::app
