// Tests texts in HTML pages: no part of a scene's name or a setting can become markup or script.

#include <gmock/gmock.h>

#include "apps/html/html.h"
#include "apps/report/sweep_report.h"
#include "apps/sweep/pictures.h"
#include "core/base64.h"
#include "report_assets.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Html, EscapesMarkup) {
  EXPECT_EQ(html_escaped("<b a=\"x\" c='y'>&amp;"), "&lt;b a=&quot;x&quot; c=&#39;y&#39;&gt;&amp;amp;");
}

TEST(Html, JsonCannotEndItsScriptElement) {
  const Json value = {{"name", "</script><!--<script>\xe2\x80\xa8&"}};
  const std::string text = script_json(value.dump());
  EXPECT_THAT(text, Not(HasSubstr("<")));
  EXPECT_THAT(text, Not(HasSubstr("\xe2\x80\xa8")));
  EXPECT_EQ(Json::parse(text), value);
}

// The test vectors of RFC 4648, section 10.
TEST(Html, Base64MatchesTheRfc) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(Html, ValuesAreNotExpandedAsTemplates) {
  EXPECT_EQ(filled("a{{x}}b{{y}}", {{"x", "{{y}}"}, {"y", "2"}}), "a{{y}}b2");
  EXPECT_THROW(filled("{{z}}", {}), std::logic_error);
}

// Text that is embedded in script elements must not end them.
TEST(Html, EmbeddedScriptsCannotEndTheirElement) {
  for (const std::string_view script :
       {assets::chart_library, assets::charts, assets::sweep_script, assets::bench_script}) {
    EXPECT_THAT(std::string(script), Not(HasSubstr("</script")));
    EXPECT_THAT(std::string(script), Not(HasSubstr("<!--")));
  }
  EXPECT_THAT(std::string(assets::chart_licence), HasSubstr("Permission is hereby granted"));
}

class Report : public test::ProgramTest {};

TEST_F(Report, NamesAreEscapedEverywhere) {
  const std::string evil = "</script><img src=x onerror=alert(1)>.pbrt";
  SweepResult result;
  result.scene = result.version = result.build = result.reference.source = evil;
  result.settings["kernel"] = evil;
  result.machine["cpu"] = evil;
  result.reference.picture = "a.png";
  SweepCell cell;
  cell.picture = cell.error_map = "a.png";
  cell.flags = evil;
  cell.error.relmse = 0.0001;
  result.cells = {cell};
  write_picture(path("a.png"), render::Image(2, 2), {});
  const std::string page = sweep_report(result, path(""));
  EXPECT_THAT(page, Not(HasSubstr("<img src=x")));
  EXPECT_THAT(page, HasSubstr("&lt;img src=x"));
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,iVBOR"));
}

// A column for each size of blocks and one for FLIP, between relMSE and bias^2.
TEST_F(Report, TableHoldsTheErrorOfBlocks) {
  SweepResult result;
  result.reference.picture = "a.png";
  SweepCell cell;
  cell.picture = cell.error_map = "a.png";
  cell.error.relmse = 0.5;
  cell.relmse_of_blocks = {0.5, 0.25, 0.125, 0.0625};
  cell.flip = 0.03125;
  result.cells = {cell};
  write_picture(path("a.png"), render::Image(2, 2), {});
  const std::string page = sweep_report(result, path(""));
  EXPECT_THAT(page, HasSubstr("<th scope=\"col\">2 x 2</th><th scope=\"col\">4 x 4</th><th "
                              "scope=\"col\">8 x 8</th>"));
  EXPECT_THAT(page,
              HasSubstr("<td>0.5</td><td>0.25</td><td>0.125</td><td>0.0625</td><td>0.031</td><td>-</td>"));
}

}  // namespace
}  // namespace kaustik::app
