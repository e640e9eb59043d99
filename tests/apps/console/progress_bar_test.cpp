#include <gtest/gtest.h>

#include <sstream>

#include "apps/console/progress_bar.h"

namespace kaustik::app {
namespace {

TEST(ProgressLine, ShowsShareAndTimeLeft) {
  EXPECT_EQ(progress_line({"render", "", 0.25, 65}, 79),
            "render   [##########------------------------------]  25 %  ETA 1:05");
  EXPECT_EQ(progress_line({"photons", "", 0, {}}, 79),
            "photons  [----------------------------------------]   0 %");
  EXPECT_EQ(progress_line({"render", "", 1, 0}, 79),
            "render   [########################################] 100 %  ETA 0:00");
  EXPECT_EQ(progress_line({"build", "", 0.5, 3725.2}, 79),
            "build    [####################--------------------]  50 %  ETA 1:02:06");
}

TEST(ProgressLine, IsNeverWiderThanTheTerminal) {
  const ProgressText text{"render 12/64", "error 3.21 %, target 1 %", 0.5, 65};
  EXPECT_EQ(progress_line(text, 79),
            "render 12/64 [###########-----------]  50 %  ETA 1:05  error 3.21 %, target 1 %");
  EXPECT_EQ(progress_line(text, 62), "render 12/64 [##---]  50 %  ETA 1:05  error 3.21 %, target 1 %");
  EXPECT_EQ(progress_line(text, 55), "render 12/64  50 %  ETA 1:05  error 3.21 %, target 1 %");
  EXPECT_EQ(progress_line(text, 20), "render 12/64  50 %  ");
  for (int columns = 0; columns < 200; ++columns)
    EXPECT_LE(progress_line(text, columns).size(), size_t(columns));
}

TEST(ProgressBar, RedrawsOneLineOnATerminalAndClearsIt) {
  std::ostringstream out, err;
  const Console console{out, err, true, false};
  {
    ProgressBar bar(console);
    bar.update({"render", 1, 4});
  }
  EXPECT_NE(err.str().find("25 %"), std::string::npos);
  EXPECT_EQ(err.str().find('\n'), std::string::npos);
  EXPECT_TRUE(err.str().ends_with("\r\x1b[K"));
}

TEST(ProgressBar, IsSilentWhenQuietAndHasNoEscapesInALog) {
  std::ostringstream out, quiet_err, log_err;
  const Console quiet{out, quiet_err, true, true};
  ProgressBar(quiet).update({"render", 1, 4});
  EXPECT_EQ(quiet_err.str(), "");
  const Console log{out, log_err, false, false};
  ProgressBar(log).update({"render", 1, 4});
  EXPECT_EQ(log_err.str().find('\x1b'), std::string::npos);
  EXPECT_EQ(log_err.str().find('\r'), std::string::npos);
}

}  // namespace
}  // namespace kaustik::app
