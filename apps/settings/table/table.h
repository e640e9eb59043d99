#pragma once
// The one table of every render setting. From it come the options of every command that renders or traces,
// the parameters of the scene file's Integrator "photonmap" line, the names in JSON files and partial
// results, and the tables of docs/reference/command_line.md. A new setting is a field of RenderSettings, a
// row here and the code that uses the field.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/settings/table/settings.h"

namespace kaustik::app {

// The commands that take settings as options.
enum class SettingsCommand : unsigned {
  kRender,
  kResume,
  kMerge,
  kPhotons,
  kBench,
  kSweep,
  kInfo,
  kConvert,
  kDenoise,
  kShoot
};

// A set of them. There is no empty one: a row of the table that names no command does not compile.
class CommandSet {
 public:
  constexpr CommandSet(SettingsCommand command) : bits_(1u << static_cast<unsigned>(command)) {}
  constexpr bool has(SettingsCommand command) const { return (bits_ & CommandSet(command).bits_) != 0; }
  friend constexpr CommandSet operator|(CommandSet a, CommandSet b) {
    a.bits_ |= b.bits_;
    return a;
  }

 private:
  unsigned bits_;
};
constexpr CommandSet operator|(SettingsCommand a, SettingsCommand b) {
  return CommandSet(a) | CommandSet(b);
}

// Commands that make pictures of a scene, which take every setting that decides what is computed. A command
// that has a list of values in place of a setting, such as `bench --photons`, does not take that setting.
inline constexpr CommandSet kRenderingCommands =
    SettingsCommand::kRender | SettingsCommand::kBench | SettingsCommand::kSweep;

// What reads a setting. A setting that is given although nothing reads it deserves a warning.
enum class SettingReader {
  kEveryRender,
  kEmission,         // renders that shoot photons
  kGather,           // renders that gather stored photons
  kGuidedEmission,   // caustic or indirect photons
  kLectureTest,      // the direct light of the lecture
  kAdaptiveSamples,  // renders that trace no paths from the camera
};

// What of kept photon maps a setting decides: the photons themselves, the gather radii that were chosen from
// them, or the estimators, and so the kinds of photons.
enum class MapPart { kNone, kPhotons, kRadii, kEstimators };

enum class ValueKind { kCount, kInteger, kNumber, kChoice, kNames, kText };

struct Setting {
  std::string_view name{};  // as on the command line, without the leading dashes: "cone-k"
  CommandSet commands;      // that have it as an option
  ValueKind kind = ValueKind::kChoice;
  std::string_view value_name{};            // placeholder in the help: "COUNT"
  std::string_view unit{};                  // "m", "pixels"; empty for choices and pure numbers
  std::string range{};                      // accepted values, in words
  std::string default_text{};               // the default, in words
  std::string_view doc{};                   // one or two sentences for the help
  int values = 1;                           // number of values that it takes
  std::vector<std::string_view> choices{};  // accepted names, for kChoice and kNames
  // Sets the field from the texts of its values. For invalid texts it leaves the settings unchanged and
  // returns an error message that begins with the text and says what was expected.
  std::function<std::optional<std::string>(Settings&, std::span<const std::string>)> assign{};
  // The inverse of `assign`: texts that set exactly the current value; empty when the field is unset.
  std::function<std::vector<std::string>(const Settings&)> show{};
  // Whether the setting affects the sums over samples, and not only the files written from them or the speed.
  bool decides_sums = true;
  MapPart map_part = MapPart::kNone;
  bool in_scene_files = true;  // as a parameter of Integrator "photonmap"
  SettingReader reader = SettingReader::kEveryRender;
  bool for_everyday = false;  // the help shows it before the settings for experts
};

// All settings in the order of the help. Built once, immutable.
const std::vector<Setting>& settings_table();

// The setting of this name, ignoring dashes, so that "conek" finds "cone-k"; null when there is none.
const Setting* find_setting(std::string_view name);

// The table in Markdown, as docs/reference/command_line.md shows it.
std::string settings_markdown();

}  // namespace kaustik::app
