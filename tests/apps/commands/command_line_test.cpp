// Tests exit codes and messages of command lines and scenes that cannot work, and the text of --help.

#include <gmock/gmock.h>

#include "apps/command_line/other_names.h"
#include "apps/commands/commands.h"
#include "apps/settings/table/table.h"
#include "core/version.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using test::Outcome;
using test::run_kaustik;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class CommandLine : public test::ProgramTest {};

TEST_F(CommandLine, HelpAndVersionSucceed) {
  const Outcome help = run_kaustik({"--help"});
  EXPECT_EQ(help.code, kDone);
  for (const char* command : {"render", "photons", "compare", "info"})
    EXPECT_THAT(help.out, HasSubstr(command));
  const Outcome version_line = run_kaustik({"--version"});
  EXPECT_EQ(version_line.code, kDone);
  EXPECT_THAT(version_line.out, HasSubstr(std::string(version())));
}

// Any other exception would end the program without naming the option.
TEST_F(CommandLine, OptionsRefuseValuesByOptionErrors) {
  for (const auto make : {make_render_command, make_view_command, make_shoot_command, make_resume_command,
                          make_merge_command, make_split_command, make_status_command, make_photons_command,
                          make_compare_command, make_denoise_command, make_info_command, make_convert_command,
                          make_bench_command, make_sweep_command}) {
    const Command command = make();
    for (const Option& option : command.options) {
      if (option.form() == ValueForm::kNone) continue;
      for (const char* value : {"", "x", "-1", "nan", "1e400", "99999999999999999999", "\xff"}) {
        try {
          option.assign(Texts(size_t(option.values), value));
        } catch (const OptionError& error) {
          EXPECT_THAT(error.what(), HasSubstr(option.long_name())) << command.name;
        } catch (const std::exception& error) {
          ADD_FAILURE() << command.name << " " << option.long_name() << " " << value << ": " << error.what();
        }
      }
    }
  }
}

TEST_F(CommandLine, PortsAreWholeNumbers) {
  const std::string scene = small_scene(film(4, 4));
  for (const std::string port : {"nan", "-1", "65536"}) {
    const Outcome outcome = run_kaustik({"view", scene, "--port", port});
    EXPECT_EQ(outcome.code, kBadCommandLine);
    EXPECT_THAT(outcome.err, HasSubstr("--port: `" + port + "`: expected a whole number, 0 to 65535"));
  }
}

TEST_F(CommandLine, RenderHelpExplainsEverySettingWithItsDefault) {
  const Outcome help = run_kaustik({"render", "--help"});
  EXPECT_EQ(help.code, kDone);
  std::string flat;  // the help without its line breaks
  for (const char c : help.out) {
    if (c != '\n') flat += c;
    while (flat.ends_with("  ")) flat.pop_back();
  }
  for (const Setting& setting : settings_table()) {
    EXPECT_THAT(flat, HasSubstr("--" + std::string(setting.name)));
    EXPECT_THAT(flat, HasSubstr("Default: " + setting.default_text)) << setting.name;
  }
}

TEST_F(CommandLine, RenderHelpHasAPartForEverydayAndEndsWithExamples) {
  const std::string help = run_kaustik({"render", "--help"}).out;
  const size_t everyday = help.find("\nEveryday settings:"), expert = help.find("\nExpert settings:");
  const size_t examples = help.find("\nExamples:");
  ASSERT_LT(everyday, expert);
  ASSERT_LT(expert, examples);
  ASSERT_NE(examples, help.npos);
  for (const Setting& setting : settings_table()) {
    if (!setting.commands.has(SettingsCommand::kRender)) continue;
    const size_t at = help.find("\n  --" + std::string(setting.name) + " ");
    EXPECT_EQ(at < expert, setting.for_everyday) << setting.name;
    EXPECT_GT(at, everyday);
    EXPECT_LT(at, examples);
  }
  EXPECT_LT(help.find("--time TIME"), expert);
  EXPECT_GT(help.find("--cone-k K"), expert);
  EXPECT_THAT(help.substr(examples), HasSubstr("\n  kaustik render "));
}

TEST_F(CommandLine, OptionsOfOtherProgramsAreTranslated) {
  const auto message = [&](const std::string& command, const std::vector<std::string>& more) {
    std::vector<std::string> words = {command, "a.pbrt"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run_kaustik(words);
    EXPECT_EQ(outcome.code, kBadCommandLine);
    return outcome.err;
  };
  EXPECT_THAT(message("render", {"--r0", "0.1"}), HasSubstr("unknown option --r0; did you mean --radius?"));
  EXPECT_THAT(message("render", {"-N", "5"}), HasSubstr("unknown option -N; did you mean --photons?"));
  EXPECT_THAT(message("render", {"--samples=5"}), HasSubstr("did you mean --spp?"));
  EXPECT_THAT(message("render", {"--resolution", "8", "8"}), HasSubstr("did you mean --width and --height?"));
  EXPECT_THAT(message("render", {"-j4"}), HasSubstr("did you mean --threads?"));
  EXPECT_THAT(message("info", {"--r0", "0.1"}), Not(HasSubstr("--radius")));  // which it does not have
}

// A name that is translated into one that does not exist would never be suggested.
TEST_F(CommandLine, TranslationsExist) {
  const std::string help = run_kaustik({"render", "--help"}).out;
  for (const char* other : {"--r0", "-N", "-k", "--samples", "--size", "-j", "--depth", "--integrator",
                            "--preset", "--out", "--region", "--timeout", "--noise", "--hdri", "--layers"}) {
    ASSERT_FALSE(names_here(other).empty()) << other;
    for (const std::string& name : names_here(other)) EXPECT_THAT(help, HasSubstr(name + " ")) << other;
  }
}

TEST_F(CommandLine, UnknownNamesExitWithTwoAndSuggestTheNearest) {
  const Outcome option = run_kaustik({"render", "a.pbrt", "--kernal", "cone"});
  EXPECT_EQ(option.code, kBadCommandLine);
  EXPECT_THAT(option.err, HasSubstr("unknown option --kernal; did you mean --kernel?"));
  const Outcome assigned = run_kaustik({"render", "a.pbrt", "--photon=5"});
  EXPECT_EQ(assigned.code, kBadCommandLine);
  EXPECT_THAT(assigned.err, HasSubstr("did you mean --photons?"));
  const Outcome value = run_kaustik({"render", "a.pbrt", "--kernel", "cones"});
  EXPECT_EQ(value.code, kBadCommandLine);
  EXPECT_THAT(value.err, HasSubstr("--kernel"));
  EXPECT_THAT(value.err, HasSubstr("did you mean `cone`"));
  const Outcome command = run_kaustik({"rendr", "a.pbrt"});
  EXPECT_EQ(command.code, kBadCommandLine);
  EXPECT_THAT(command.err, HasSubstr("render"));
}

TEST_F(CommandLine, MissingAndSurplusArgumentsExitWithTwo) {
  EXPECT_EQ(run_kaustik({}).code, kBadCommandLine);
  EXPECT_EQ(run_kaustik({"render"}).code, kBadCommandLine);
  EXPECT_EQ(run_kaustik({"render", "a.pbrt", "--photons"}).code, kBadCommandLine);
  EXPECT_EQ(run_kaustik({"render", "a.pbrt", "--crop", "1", "2", "3"}).code, kBadCommandLine);
  EXPECT_EQ(run_kaustik({"render", "a.pbrt", "b.pbrt"}).code, kBadCommandLine);
  EXPECT_EQ(run_kaustik({"compare", "a.exr"}).code, kBadCommandLine);
}

TEST_F(CommandLine, BadValuesExitWithTwo) {
  for (const std::vector<std::string>& bad : std::vector<std::vector<std::string>>{{"--photons", "0"},
                                                                                   {"--photons", "1.5"},
                                                                                   {"--radius", "-1"},
                                                                                   {"--spp", "many"},
                                                                                   {"--aov", "dept"}}) {
    std::vector<std::string> arguments = {"render", small_scene(), "-o", path("a.exr")};
    arguments.insert(arguments.end(), bad.begin(), bad.end());
    const Outcome outcome = run_kaustik(arguments);
    EXPECT_EQ(outcome.code, kBadCommandLine) << bad[0] << " " << bad[1];
    EXPECT_THAT(outcome.err, HasSubstr(bad[0]));
    EXPECT_FALSE(exists("a.exr"));
  }
}

// The scene does not exist either: exit code 2 shows that the outputs were checked first.
TEST_F(CommandLine, OutputsThatCannotBeWrittenAreReportedFirst) {
  const std::string scene = path("missing.pbrt");
  EXPECT_EQ(run_kaustik({"render", scene, "-o", path("no/such/folder.exr")}).code, kBadCommandLine);
  EXPECT_EQ(run_kaustik({"render", scene, "-o", path("picture.gif")}).code, kBadCommandLine);
  EXPECT_EQ(run_kaustik({"render", scene, "-o", path("picture")}).code, kBadCommandLine);
  EXPECT_EQ(run_kaustik({"render", scene, "-o", path("a.exr"), "--stats", path("no/stats.json")}).code,
            kBadCommandLine);
  EXPECT_EQ(run_kaustik({"photons", scene}).code, kBadCommandLine);
  EXPECT_EQ(run_kaustik({"photons", scene, "-o", path("map.obj")}).code, kBadCommandLine);
  EXPECT_EQ(run_kaustik({"photons", scene, "-o", path("map.ply"), "--kinds", "caustics"}).code,
            kBadCommandLine);
  EXPECT_THAT(files(), IsEmpty());
}

// 10^12 photons take at least 24 TB, more than any machine that runs this test has.
TEST_F(CommandLine, PhotonsThatDoNotFitInMemoryExitWithOne) {
  const Outcome outcome =
      run_kaustik({"photons", small_scene(film(8, 8)), "-o", path("a.ply"), "--photons", "1T"});
  EXPECT_EQ(outcome.code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("1000000000000 photons would need about"));
  EXPECT_THAT(outcome.err, HasSubstr("emit at most about"));
  EXPECT_FALSE(exists("a.ply"));
}

TEST_F(CommandLine, BadScenesExitWithThree) {
  const Outcome missing = run_kaustik({"render", path("missing.pbrt"), "-o", path("a.exr")});
  EXPECT_EQ(missing.code, kBadScene);
  EXPECT_THAT(missing.err, HasSubstr("missing.pbrt"));
  EXPECT_EQ(run_kaustik({"info", path("missing.pbrt")}).code, kBadScene);
  EXPECT_EQ(run_kaustik({"photons", path("missing.pbrt"), "-o", path("a.ply")}).code, kBadScene);
}

TEST_F(CommandLine, SettingsErrorsInTheSceneHaveALocation) {
  const std::string scene = small_scene("Integrator \"photonmap\" \"string kernal\" \"cone\"");
  const Outcome outcome = run_kaustik({"render", scene, "-o", path("a.exr")});
  EXPECT_EQ(outcome.code, kBadScene);
  EXPECT_THAT(outcome.err, HasSubstr("small.pbrt:3:"));
  EXPECT_THAT(outcome.err, HasSubstr("did you mean `kernel`"));
  EXPECT_FALSE(exists("a.exr"));
}

// An error of the scene and an error of its settings are reported in the same run.
TEST_F(CommandLine, AllErrorsOfAFileAreReportedInOneRun) {
  const std::string scene = small_scene(
      "Integrator \"photonmap\" \"string kernal\" \"cone\"\nFilm \"rgb\" \"integer xresolutio\" 5");
  const Outcome outcome = run_kaustik({"info", scene});
  EXPECT_EQ(outcome.code, kBadScene);
  EXPECT_THAT(outcome.err, HasSubstr("small.pbrt:3:"));
  EXPECT_THAT(outcome.err, HasSubstr("small.pbrt:4:"));
}

// The number is out of range for the scene's schema and for --spp alike.
TEST_F(CommandLine, OneMistakeGivesOneError) {
  const Outcome outcome = run_kaustik({"info", small_scene("Sampler \"halton\" \"integer pixelsamples\" 0")});
  EXPECT_EQ(outcome.code, kBadScene);
  EXPECT_THAT(outcome.err, HasSubstr("small.pbrt:3:41: error: `pixelsamples`"));
  EXPECT_THAT(outcome.err, HasSubstr("small.pbrt: 1 error\n"));
}

}  // namespace
}  // namespace kaustik::app
