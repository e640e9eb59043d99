#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/reference/completions.h"

namespace kaustik::app {

namespace {

// Text inside single quotes and inside the brackets of _arguments.
std::string zsh_quoted(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'')
      out += "'\\''";
    else if (c == '[' || c == ']' || c == ':' || c == '\\')
      out += std::string("\\") + c;
    else
      out += c;
  }
  return out;
}

std::string value_spec(const Option& option) {
  if (option.form() == ValueForm::kNone) return "";
  std::string action;
  if (!option.choices.empty() && option.takes_list)
    action = fmt::format("_values -s , value {}", fmt::join(option.choices, " "));
  else if (!option.choices.empty())
    action = fmt::format("({})", fmt::join(option.choices, " "));
  else if (option.form() == ValueForm::kFile)
    action = "_files";
  else if (option.form() == ValueForm::kFolder)
    action = "_files -/";
  return fmt::format(":{}:{}", zsh_quoted(option.value_name), action);
}

// Each name of the option by itself; `*` since it may be given again.
std::string option_specs(const Option& option) {
  std::string out;
  for (const std::string& name : option.names)
    out += fmt::format(" \\\n        '*{}[{}]{}'", name, zsh_quoted(first_sentence(option.description)),
                       value_spec(option));
  return out;
}

}  // namespace

std::string zsh_completion(const Program& program) {
  const std::vector<Command> commands = visible_commands(program);
  std::string out =
      "#compdef kaustik\n# Completion of kaustik for zsh. Generated: `kaustik reference --format zsh`.\n"
      "_kaustik() {\n  local -a commands=(\n";
  for (const Command& command : commands)
    out += fmt::format("    '{}:{}'\n", command.name, zsh_quoted(command.description));
  out += "  )\n  if (( CURRENT == 2 )); then\n    _describe command commands\n    _arguments";
  for (const Option& option : program.options) out += option_specs(option);
  out +=
      "\n    return\n  fi\n  local command=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $command in\n";
  for (const Command& command : commands) {
    out += fmt::format("    {})\n      _arguments", command.name);
    for (const Option& option : command.options) out += option_specs(option);
    out += " \\\n        '*:file:_files'\n      ;;\n";
  }
  return out + "  esac\n}\n_kaustik \"$@\"\n";
}

}  // namespace kaustik::app
