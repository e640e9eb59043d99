// What must hold for every row of the settings table. A new row is tested here without a change.

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/settings/scene_settings.h"
#include "apps/settings/settings_json.h"
#include "apps/settings/table/table.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using Texts = std::vector<std::string>;

std::map<std::string_view, Texts> shown(const Settings& settings) {
  std::map<std::string_view, Texts> out;
  for (const Setting& setting : settings_table()) out[setting.name] = setting.show(settings);
  return out;
}

// Values that this row accepts and that change what the table shows; none when there are no such values among
// those that are tried.
Texts another_value(const Setting& setting) {
  std::vector<Texts> candidates;
  for (const std::string_view choice : setting.choices) candidates.push_back({std::string(choice)});
  for (const char* number : {"7", "0.25", "1.75", "3s"}) candidates.push_back({number});
  candidates.push_back({"1", "5", "2", "9"});
  candidates.push_back({"0", "0", "9", "0", "0", "0", "0", "1", "0"});
  for (const Texts& texts : candidates) {
    const bool fits =
        setting.kind == ValueKind::kNames || texts.size() == static_cast<size_t>(setting.values);
    Settings settings;
    if (fits && !setting.assign(settings, texts) && shown(settings) != shown({})) return texts;
  }
  return {};
}

Parameter string_parameter(std::string_view name, const Texts& values) {
  Parameter parameter;
  parameter.type = ParameterType::kString;
  parameter.name = name;
  std::erase(parameter.name, '-');
  parameter.strings = values;
  parameter.value_places.assign(values.size(), {1, 1});
  return parameter;
}

TEST(EverySetting, CanBeChangedAndIsShown) {
  for (const Setting& setting : settings_table())
    EXPECT_FALSE(another_value(setting).empty())
        << setting.name << ": no value that was tried changes what the table shows";
}

TEST(EverySetting, SurvivesBeingShown) {
  for (const Setting& setting : settings_table()) {
    Settings changed, copy;
    setting.assign(changed, another_value(setting));
    for (const auto& [name, texts] : shown(changed))
      if (!texts.empty()) {
        EXPECT_EQ(find_setting(name)->assign(copy, texts), std::nullopt) << name;
      }
    EXPECT_EQ(shown(copy), shown(changed)) << setting.name;
  }
}

// Rows that have no value by default say in words what then holds, such as "on if the error is asked for".
TEST(EverySetting, HasTheDefaultThatItsRowStates) {
  for (const Setting& setting : settings_table()) {
    if (setting.show({}).empty()) continue;
    Settings settings;
    const std::string first_word = setting.default_text.substr(0, setting.default_text.find_first_of(" ;"));
    if (!setting.assign(settings, {&first_word, 1})) {
      EXPECT_EQ(shown(settings), shown({})) << setting.name;
    }
  }
}

TEST(EverySetting, IsAParameterOfTheSceneFileUnlessItDecidesHowThatIsRead) {
  for (const Setting& setting : settings_table()) {
    const Texts texts = another_value(setting);
    SceneDescription description;
    description.integrator.emplace();
    description.integrator->type = "photonmap";
    description.integrator->parameters = {string_parameter(setting.name, texts)};
    DiagnosticList diagnostics;
    const SceneSettings scene = settings_from_scene(description, diagnostics);
    EXPECT_EQ(diagnostics.error_count(), setting.in_scene_files ? 0u : 1u) << setting.name;
    Settings expected;
    if (setting.in_scene_files) setting.assign(expected, texts);
    if (setting.name == "photons") expected.render.balance = render::Balance::kOff;  // just as many
    if (setting.name == "spp") expected.render.sample_balance = render::Balance::kOff;
    EXPECT_EQ(shown(scene.settings), shown(expected)) << setting.name;
  }
}

TEST(EverySetting, ThatDecidesTheSumsIsInTheStatistics) {
  for (const Setting& setting : settings_table()) {
    Settings changed;
    setting.assign(changed, another_value(setting));
    if (!setting.decides_sums || setting.show(changed).empty() || setting.name == "passes") continue;
    std::string name(setting.name);
    std::replace(name.begin(), name.end(), '-', '_');
    EXPECT_TRUE(statistics_settings(changed, {}).contains(name)) << name;
  }
}

TEST(SettingsJson, NumbersAreNumbersAndThePlanChoosesTheEstimators) {
  Settings settings;
  settings.render.seed = ~uint64_t{0};
  settings.render.cone_k = 1.5f;
  settings.render.crop = {1, 5, 2, 9};
  render::EstimatorPlan plan;
  plan.direct = render::DirectEstimator::kLecture;
  const auto json = statistics_settings(settings, plan);
  EXPECT_EQ(json["seed"].get<uint64_t>(), ~uint64_t{0});
  EXPECT_EQ(json["cone_k"], 1.5);
  EXPECT_EQ(json["alpha"], 1.0);
  EXPECT_EQ(json["radius"], "auto");
  EXPECT_EQ(json["direct"], "lecture");
  EXPECT_EQ(json["crop"], (std::vector<int>{1, 5, 2, 9}));
  settings.render.radius = 0.25f;
  EXPECT_EQ(statistics_settings(settings, plan)["radius"], 0.25);
}

// Names of the options below the headings "Everyday settings:" and "Expert settings:" in the help of a
// command, sorted.
std::vector<std::string> settings_in_help(const std::string& command) {
  std::istringstream help(test::run_kaustik({command, "--help"}).out);
  std::vector<std::string> names;
  bool found = false;
  for (std::string line; std::getline(help, line);) {
    if (line.ends_with(" settings:")) found = true;
    if (found && line.starts_with("  --")) names.push_back(line.substr(4, line.find(' ', 4) - 4));
  }
  std::sort(names.begin(), names.end());
  return names;
}

TEST(EverySetting, IsAnOptionOfExactlyTheCommandsOfItsRow) {
  using enum SettingsCommand;
  const std::pair<SettingsCommand, const char*> commands[] = {
      {kRender, "render"}, {kResume, "resume"}, {kMerge, "merge"}, {kPhotons, "photons"},
      {kBench, "bench"},   {kSweep, "sweep"},   {kInfo, "info"},   {kConvert, "convert"}};
  for (const auto& [command, name] : commands) {
    std::vector<std::string> expected;
    for (const Setting& setting : settings_table())
      if (setting.commands.has(command)) expected.emplace_back(setting.name);
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(settings_in_help(name), expected) << name;
  }
}

}  // namespace
}  // namespace kaustik::app
