// Parser, help, reference page, man page and completions name the same commands and options.

#include <gmock/gmock.h>

#include <cstdlib>
#include <regex>
#include <set>

#include "apps/reference/option_text.h"
#include "apps/reference/reference_page.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using test::run_kaustik;
using ::testing::HasSubstr;
using ::testing::Not;
using Names = std::set<std::string>;

constexpr const char* kCommands[] = {"render", "resume",  "merge", "photons", "compare",
                                     "info",   "convert", "bench", "sweep"};
const std::string kPage = std::string(KAUSTIK_SOURCE_DIR) + "/docs/reference/command_line.md";

Names found_in(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  Names names;
  for (std::sregex_iterator it(text.begin(), text.end(), expression), end; it != end; ++it)
    names.insert((*it)[1].str());
  return names;
}

// Options at the beginning of the lines of the help: "  -o,--output FILE   File to write".
Names options_in_help(const std::string& command) {
  return found_in(run_kaustik({command, "--help"}).out, "\n  (?:-[a-z],)?(--[a-z-]+)");
}

std::string reference(const std::string& format) {
  const test::Outcome outcome = run_kaustik({"reference", "--format", format});
  EXPECT_EQ(outcome.code, kDone) << outcome.err;
  return outcome.out;
}

// The part of text from begin to end, which is the end of the text where it is missing.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const size_t at = text.find(begin);
  if (at == std::string::npos) return "";
  const size_t from = at + begin.size();
  return text.substr(from, text.find(end, from) - from);
}

class Reference : public test::ProgramTest {
 protected:
  std::string page() const {
    std::ifstream file(kPage, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  // Runs a command of the shell with the completion script or man page in a file of its own.
  int shell(const std::string& command) const {
    return std::system(("cd " + path("") + " && " + command).c_str());
  }
};

TEST_F(Reference, ThePageIsWhatTheProgramGenerates) {
  const test::Outcome outcome = run_kaustik({"reference", "--format", "markdown", "--page", kPage});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_EQ(page(), outcome.out) << "scripts/reference rewrites " << kPage;
}

TEST_F(Reference, PageHelpAndParserHaveTheSameOptions) {
  for (const std::string command : kCommands) {
    const Names in_help = options_in_help(command);
    ASSERT_FALSE(in_help.empty()) << command;
    const std::string part =
        between(page(), "<!-- generated: " + command + " -->", "<!-- end of " + command + " -->");
    EXPECT_EQ(found_in(part.substr(part.find("| --- |")), "`(--[a-z-]+)"), in_help) << command;
    for (const std::string& name : in_help)
      EXPECT_THAT(run_kaustik({command, name}).err, Not(HasSubstr("unknown option"))) << command << name;
  }
}

TEST_F(Reference, ManPageAndCompletionsHaveTheSameOptions) {
  const std::string man = reference("man"), bash = reference("bash"), zsh = reference("zsh"),
                    fish = reference("fish");
  for (const std::string command : kCommands) {
    const Names expected = options_in_help(command);
    std::string section = between(man, ".SS kaustik " + command, "\n.S");
    section = std::regex_replace(section, std::regex(R"(\\-)"), "-");
    const Names in_man = found_in(section, "[ B](--[a-z-]+)");
    EXPECT_TRUE(std::includes(in_man.begin(), in_man.end(), expected.begin(), expected.end())) << command;
    EXPECT_EQ(found_in(between(bash, "    " + command + ")\n      options='", "'"), "(--[a-z-]+)"), expected);
    EXPECT_EQ(found_in(between(zsh, "    " + command + ")\n", ";;"), "'\\*(--[a-z-]+)\\["), expected);
    Names in_fish;
    for (const std::string& name : found_in(fish, "seen_subcommand_from " + command + "'[^\n]* -l ([a-z-]+)"))
      in_fish.insert("--" + name);
    EXPECT_EQ(in_fish, expected) << command;
  }
}

TEST_F(Reference, TheHelpDoesNotShowTheCommandThatGeneratesThis) {
  EXPECT_THAT(run_kaustik({"--help"}).out, Not(HasSubstr("\n  reference ")));
}

TEST_F(Reference, PagesWithDamagedMarksAreRefused) {
  const auto complaint = [](const std::string& text) {
    Program program("kaustik", "");
    program.commands.emplace_back("render", "");
    try {
      updated_reference_page(text, program);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto part = [](const std::string& name) {
    return "<!-- generated: " + name + " -->\nold\n<!-- end of " + name + " -->\n";
  };
  const std::string good = part("commands") + part("exit-codes") + part("settings") + part("render");
  EXPECT_EQ(complaint(good), "");
  EXPECT_THAT(complaint(good + part("render")), HasSubstr("`render` is unknown or occurs twice"));
  EXPECT_THAT(complaint(part("commands")), HasSubstr("lacks the part `exit-codes`"));
  EXPECT_THAT(complaint("<!-- generated: commands -->\n"), HasSubstr("`commands` has no end"));
}

// groff and mandoc warn about requests that they do not know and text that is lost. The page has no date, of
// which mandoc warns too, so that a build can be repeated.
TEST_F(Reference, TheManPageIsCleanRoff) {
  write("kaustik.1", reference("man"));
  write("warnings", "");
  EXPECT_EQ(shell("! command -v groff >/dev/null || groff -ww -man -Tutf8 kaustik.1 >text 2>warnings"), 0);
  EXPECT_EQ(read("warnings"), "");
  EXPECT_NE(
      shell(
          "command -v mandoc >/dev/null && mandoc -T lint -W warning kaustik.1 | grep -v 'missing date' >&2"),
      0);
  for (const char* line : {"\n.SH NAME\n", "\n.SH SYNOPSIS\n", "\n.SH EXIT STATUS\n"})
    EXPECT_THAT(read("kaustik.1"), HasSubstr(line));
}

TEST_F(Reference, ShellsAcceptTheirCompletions) {
  for (const std::string name : {"bash", "zsh", "fish"}) {
    write(name, reference(name));
    EXPECT_EQ(shell("! command -v " + name + " >/dev/null || " + name + " -n " + name), 0) << name;
  }
}

TEST_F(Reference, BashCompletesCommandsOptionsValuesAndFiles) {
  write("completion", reference("bash"));
  write("some scene.pbrt", "");
  // words: the command line as bash splits it; the last one is completed.
  const auto completed = [&](const std::string& words) {
    write("query",
          "source ./completion\nCOMP_WORDS=(kaustik " + words +
              ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_kaustik\nprintf '%s;' \"${COMPREPLY[@]}\"\n");
    EXPECT_EQ(shell("bash query >replies 2>errors"), 0) << words;
    EXPECT_EQ(read("errors"), "") << words;
    return read("replies");
  };
  EXPECT_EQ(completed("sw"), "sweep;");
  EXPECT_EQ(completed("render --kern"), "--kernel;");
  EXPECT_EQ(completed("bench --gui"), "--guide;");
  EXPECT_EQ(completed("render --guide ''"), "off;on;");
  EXPECT_EQ(completed("render --guide = of"), "off;");
  EXPECT_EQ(completed("render --guide ="), "off;on;");
  EXPECT_EQ(completed("render --aov direct,dep"), "direct,depth;");
  EXPECT_EQ(completed("sweep --methods mc,ray"), "mc,raytrace;");
  EXPECT_EQ(completed("photons --kinds sh"), "shadow;");
  EXPECT_EQ(completed("render --photons ''"), ";");
  EXPECT_EQ(completed("render som"), "some scene.pbrt;");
  EXPECT_EQ(completed("render -o some"), "some scene.pbrt;");
}

}  // namespace
}  // namespace kaustik::app
