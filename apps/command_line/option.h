#pragma once
// An option or an argument of a subcommand, as plain data: what the parser, the help, the reference page, the
// man page and the completions say about it.

#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace kaustik::app {

using Texts = std::vector<std::string>;

// Thrown for a value that an option does not take. what() begins with the option's name.
class OptionError : public std::runtime_error {
 public:
  OptionError(std::string_view option, std::string_view message)
      : std::runtime_error(std::string(option) + ": " + std::string(message)) {}
};

enum class ValueForm { kNone, kText, kFile, kFolder };  // kNone: a flag

struct Option {
  std::vector<std::string> names;  // with their dashes, short ones first: "-o", "--output"
  std::string value_name;          // "FILE", "FOLDER" or any other word; empty for flags
  std::string description;
  // Receives the texts of all values, after parsing and only if the option was given; a flag receives none.
  // Throws OptionError.
  std::function<void(const Texts&)> assign;

  int values = 1;           // number of texts after the name
  bool takes_list = false;  // may be repeated, which adds values
  bool at_commas = false;   // texts are split at commas before assign() receives them
  bool last_wins = false;   // may be repeated: the last value counts. Without this or takes_list, it may not
  bool required = false;
  bool is_setting = false;    // a row of settings_table(), under a heading of its own
  bool for_everyday = false;  // a setting for everyday use, under another heading than those for experts
  std::vector<std::string> choices;          // the values, where there are only so many: for completions
  std::vector<std::string> needs, excludes;  // long names of other options of the command

  const std::string& long_name() const { return names.back(); }
  ValueForm form() const {
    if (value_name.empty()) return ValueForm::kNone;
    if (value_name == "FILE") return ValueForm::kFile;
    return value_name == "FOLDER" ? ValueForm::kFolder : ValueForm::kText;
  }
};

// A value without a name, such as the scene of `kaustik render`.
struct Argument {
  std::string name, description;  // "SCENE"
  std::function<void(const Texts&)> assign;
  bool required = true, repeats = false;
};

}  // namespace kaustik::app
