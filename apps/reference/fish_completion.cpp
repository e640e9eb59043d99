#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/reference/completions.h"

namespace kaustik::app {

namespace {

std::string in_quotes(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  return out + "'";
}

std::string option_line(const std::string& condition, const OptionModel& option) {
  std::string line = fmt::format("complete -c kaustik -n {}", in_quotes(condition));
  for (const std::string& name : option.names)
    line += name.starts_with("--") ? fmt::format(" -l {}", name.substr(2))
                                   : fmt::format(" -s {}", name.substr(1));
  if (!option.choices.empty())
    line += fmt::format(" -x -a {}", in_quotes(fmt::format("{}", fmt::join(option.choices, " "))));
  else if (option.form == ValueForm::kFile)
    line += " -r -F";
  else if (option.form == ValueForm::kFolder)
    line += " -x -a '(__fish_complete_directories)'";
  else if (option.form == ValueForm::kText)
    line += " -x";
  return line + fmt::format(" -d {}\n", in_quotes(first_sentence(option.description)));
}

}  // namespace

std::string fish_completion(const ProgramModel& program) {
  std::string out = "# Completion of kaustik for fish. Generated: `kaustik reference --format fish`.\n";
  for (const CommandModel& command : program.commands)
    out += fmt::format("complete -c kaustik -n __fish_use_subcommand -f -a {} -d {}\n", command.name,
                       in_quotes(command.description));
  for (const OptionModel& option : program.options) out += option_line("__fish_use_subcommand", option);
  for (const CommandModel& command : program.commands)
    for (const OptionModel& option : command.options)
      out += option_line("__fish_seen_subcommand_from " + command.name, option);
  return out;
}

}  // namespace kaustik::app
