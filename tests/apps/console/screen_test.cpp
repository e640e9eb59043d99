// Log, progress line and picture in one terminal: none of them tears another.

#include "apps/console/screen.h"

#include <gtest/gtest.h>

#include <sstream>
#include <thread>

#include "tests/apps/live/support/screen_model.h"

namespace kaustik::app {
namespace {

using test::ScreenModel;

Screen::Paint lines_of(char letter, int rows) {
  return [letter, rows](bool) {
    std::string bytes;
    for (int row = 0; row < rows; ++row) bytes += (row > 0 ? "\r\x1b[1B" : "") + std::string(5, letter);
    return bytes;
  };
}

class ScreenTest : public ::testing::Test {
 protected:
  ScreenModel shown(int columns = 40, int rows = 10) const {
    ScreenModel model(columns, rows);
    model.write(stream_.str());
    EXPECT_TRUE(model.unknown().empty()) << model.unknown()[0];
    EXPECT_FALSE(model.has_unread());
    return model;
  }
  static std::vector<std::string> texts(const ScreenModel& model) {
    std::vector<std::string> all;
    for (size_t i = 0; i < model.lines(); ++i) all.push_back(model.text(i));
    return all;
  }
  using Texts = std::vector<std::string>;

  std::ostringstream stream_;
  Screen screen_{stream_};
};

TEST_F(ScreenTest, ALogLineStandsAboveTheProgressLine) {
  screen_.log("first\n");
  screen_.show_line("10 % of a long line");
  screen_.log("second\n");
  EXPECT_EQ(texts(shown()), Texts({"first", "second", "10 % of a long line"}));
  screen_.show_line("20 %");
  EXPECT_EQ(texts(shown()), Texts({"first", "second", "20 %"}));
  screen_.show_line("");
  screen_.log("third\n");
  EXPECT_EQ(texts(shown()), Texts({"first", "second", "third", ""}));
}

TEST_F(ScreenTest, ThePictureStandsAboveTheLineAndIsRedrawnInItsPlace) {
  screen_.log("note\n");
  screen_.show_line("10 %");
  screen_.draw({3, 5}, "", lines_of('a', 3));
  EXPECT_EQ(texts(shown()), Texts({"note", "aaaaa", "aaaaa", "aaaaa", "10 %"}));
  screen_.show_line("20 %");
  screen_.draw({3, 5}, "", lines_of('b', 3));
  EXPECT_EQ(texts(shown()), Texts({"note", "bbbbb", "bbbbb", "bbbbb", "20 %"}));
  // A larger place, and a smaller one.
  screen_.draw({4, 5}, "", lines_of('c', 4));
  EXPECT_EQ(texts(shown()), Texts({"note", "ccccc", "ccccc", "ccccc", "ccccc", "20 %"}));
  screen_.draw({1, 5}, "", lines_of('d', 1));
  EXPECT_EQ(texts(shown()), Texts({"note", "ddddd", "20 %", "", "", ""}));
  EXPECT_EQ(shown().cursor_line(), 2u);
}

TEST_F(ScreenTest, ALogLineTakesThePlaceOfThePictureUntilItIsDrawnAgain) {
  bool was_empty = false;
  const auto paint = [&](bool all) {
    was_empty = all;
    return lines_of('a', 2)(all);
  };
  screen_.draw({2, 5}, "", paint);
  EXPECT_TRUE(was_empty);
  screen_.draw({2, 5}, "", paint);
  EXPECT_FALSE(was_empty);
  screen_.show_line("10 %");
  screen_.log("one\ntwo\n");
  EXPECT_EQ(texts(shown()), Texts({"one", "two", "10 %"}));
  screen_.draw({2, 5}, "", paint);
  EXPECT_TRUE(was_empty);
  EXPECT_EQ(texts(shown()), Texts({"one", "two", "aaaaa", "aaaaa", "10 %"}));
}

TEST_F(ScreenTest, AtTheLowerEdgeTheTextScrolls) {
  for (int i = 0; i < 20; ++i) screen_.log("line " + std::to_string(i) + "\n");
  screen_.show_line("10 %");
  screen_.draw({6, 5}, "", lines_of('a', 6));
  screen_.log("last\n");
  screen_.draw({6, 5}, "", lines_of('b', 6));
  const ScreenModel model = shown();
  EXPECT_EQ(model.lines(), 28u);
  EXPECT_EQ(model.text(19), "line 19");
  EXPECT_EQ(model.text(20), "last");
  for (size_t i = 21; i < 27; ++i) EXPECT_EQ(model.text(i), "bbbbb");
  EXPECT_EQ(model.text(27), "10 %");
}

// The terminal shows typed keys where the cursor is.
TEST_F(ScreenTest, APictureDrawnAnewHasNothingOfOthers) {
  screen_.show_line("10 %");
  screen_.draw({2, 5}, "", lines_of('a', 2));
  stream_ << "\r\x1b[1A^C and more";
  stream_ << "\r\x1b[1B";
  bool was_empty = false;
  screen_.draw(
      {2, 5}, "", [&](bool all) { return was_empty = all, lines_of('b', 2)(all); }, true);
  EXPECT_TRUE(was_empty);
  EXPECT_EQ(texts(shown()), Texts({"bbbbb", "bbbbb", "10 %"}));
}

TEST_F(ScreenTest, AKeptPictureIsText) {
  screen_.draw({2, 5}, "", lines_of('a', 2));
  screen_.keep_picture();
  screen_.log("after\n");
  EXPECT_EQ(texts(shown()), Texts({"aaaaa", "aaaaa", "after", ""}));
}

TEST_F(ScreenTest, NothingIsWrittenWhereNothingIsDrawn) {
  EXPECT_EQ(screen_.draw({2, 5}, "", [](bool) { return ""; }), 0u);
  screen_.show_line("");
  EXPECT_EQ(stream_.str(), "");
}

TEST_F(ScreenTest, AFailureToPaintLeavesTheScreenUsable) {
  EXPECT_THROW(screen_.draw({2, 5}, "", [](bool) -> std::string { throw std::bad_alloc(); }), std::bad_alloc);
  screen_.log("note\n");
  EXPECT_EQ(texts(shown()), Texts({"note", ""}));
}

// While a slow picture is on its way, lines wait for it and their writers do not.
class SlowBuffer : public std::stringbuf {
 public:
  std::function<void()> before;

 protected:
  std::streamsize xsputn(const char* bytes, std::streamsize count) override {
    if (before) std::exchange(before, nullptr)();
    return std::stringbuf::xsputn(bytes, count);
  }
};

TEST_F(ScreenTest, NobodyWaitsForASlowPicture) {
  SlowBuffer buffer;
  std::ostream stream(&buffer);
  Screen screen(stream);
  // If log() or show_line() waited for the writer, which is their caller here, the test would never end.
  buffer.before = [&] {
    screen.show_line("10 %");
    screen.show_line("20 %");
    screen.log("note\n");
  };
  screen.draw({1, 5}, "", lines_of('a', 1));
  ScreenModel model(40, 10);
  model.write(buffer.str());
  EXPECT_EQ(texts(model), Texts({"note", "20 %"}));
}

TEST_F(ScreenTest, ThreadsDoNotTearEachOther) {
  std::thread bar([&] {
    for (int i = 0; i < 500; ++i) screen_.show_line(std::to_string(i) + " %");
  });
  std::thread notes([&] {
    for (int i = 0; i < 50; ++i) screen_.log("note " + std::to_string(i) + "\n");
  });
  for (int i = 0; i < 200; ++i) screen_.draw({3, 5}, "", lines_of(char('a' + i % 26), 3));
  bar.join();
  notes.join();
  screen_.draw({3, 5}, "", lines_of('z', 3));
  Texts expected;
  for (int i = 0; i < 50; ++i) expected.push_back("note " + std::to_string(i));
  expected.insert(expected.end(), 3, "zzzzz");
  expected.emplace_back("499 %");
  EXPECT_EQ(texts(shown()), expected);
}

}  // namespace
}  // namespace kaustik::app
