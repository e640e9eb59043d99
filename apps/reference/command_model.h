#pragma once
// The command line as plain data, read from the parser itself: what help, reference page, man page and shell
// completions have in common.

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace kaustik::app {

enum class ValueForm { kNone, kText, kFile, kFolder };  // kNone: a flag

struct OptionModel {
  std::vector<std::string> names;  // with their dashes, short ones first: "-o", "--output"
  ValueForm form = ValueForm::kText;
  std::string value_name;            // "FILE"; empty for flags
  std::string description;           // one line
  std::vector<std::string> choices;  // the values, where there are only so many
  bool takes_list = false;           // choices separated by commas
  bool required = false;
  bool is_setting = false;  // from settings_table()
  const std::string& long_name() const { return names.back(); }
};

struct PositionalModel {
  std::string name, description;
  bool required = false, repeats = false;
};

struct CommandModel {
  std::string name, description;
  std::vector<PositionalModel> positionals;
  std::vector<OptionModel> options;  // in the order of the help
  std::string usage() const;         // "kaustik merge PARTS... [OPTIONS]"
};

struct ProgramModel {
  std::string description;
  std::vector<OptionModel> options;    // without a command
  std::vector<CommandModel> commands;  // without hidden ones
};

ProgramModel program_model(const CLI::App& program);

// "-o FILE, --output FILE"; code: each name in backquotes.
std::string option_heading(const OptionModel& option, bool code = false);

// A description up to the end of its first sentence, without the full stop.
std::string first_sentence(const std::string& description);

}  // namespace kaustik::app
