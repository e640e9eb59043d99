#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/reference/completions.h"

namespace kaustik::app {

namespace {

constexpr std::string_view kBegin =
    R"(# Completion of kaustik for bash. Generated: `kaustik reference --format bash`.
_kaustik() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]}
  local options='' values='' files='' list='' prefix=''
  COMPREPLY=()
  # `--option=value` is three words.
  if [[ $current == '=' ]]; then
    current=''
  elif [[ $previous == '=' ]]; then
    previous=${COMP_WORDS[COMP_CWORD-2]}
  fi
)";

constexpr std::string_view kEnd = R"(  if [[ $values ]]; then
    if [[ $list ]]; then
      prefix=${current%"${current##*,}"}
      current=${current##*,}
    fi
    mapfile -t COMPREPLY < <(compgen -P "$prefix" -W "$values" -- "$current")
  elif [[ $files || $current != -* ]]; then
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen "${files:--f}" -- "$current")
  else
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
  fi
}
complete -F _kaustik kaustik
)";

std::vector<std::string> all_names(const std::vector<Option>& options) {
  std::vector<std::string> names;
  for (const Option& option : options) names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

// What may follow the option; nothing for flags.
std::string value_case(const Option& option) {
  if (option.form() == ValueForm::kNone) return "";
  std::string action = "return";  // a value that nobody can guess
  if (!option.choices.empty())
    action = fmt::format("values='{}'{}", fmt::join(option.choices, " "), option.takes_list ? " list=1" : "");
  else if (option.form() != ValueForm::kText)
    action = option.form() == ValueForm::kFolder ? "files=-d" : "files=-f";
  return fmt::format("        {}) {} ;;\n", fmt::join(option.names, " | "), action);
}

}  // namespace

std::string bash_completion(const Program& program) {
  const std::vector<Command> commands = visible_commands(program);
  std::string out(kBegin);
  std::vector<std::string> first = all_names(program.options);
  for (const Command& command : commands) first.push_back(command.name);
  out += fmt::format(
      "  if ((COMP_CWORD == 1)); then\n    mapfile -t COMPREPLY < <(compgen -W '{}' -- \"$current\")\n"
      "    return\n  fi\n  case $command in\n",
      fmt::join(first, " "));
  for (const Command& command : commands) {
    out += fmt::format("    {})\n      options='{}'\n      case $previous in\n", command.name,
                       fmt::join(all_names(command.options), " "));
    for (const Option& option : command.options) out += value_case(option);
    out += "      esac\n      ;;\n";
  }
  return out + "  esac\n" + std::string(kEnd);
}

}  // namespace kaustik::app
