#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/reference/completions.h"

namespace kaustik::app {

namespace {

std::string fish_quoted(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  return out + "'";
}

std::string option_line(const std::string& condition, const Option& option) {
  std::string line = fmt::format("complete -c kaustik -n {}", fish_quoted(condition));
  for (const std::string& name : option.names)
    line += name.starts_with("--") ? fmt::format(" -l {}", name.substr(2))
                                   : fmt::format(" -s {}", name.substr(1));
  if (!option.choices.empty())
    line += fmt::format(" -x -a {}", fish_quoted(fmt::format("{}", fmt::join(option.choices, " "))));
  else if (option.form() == ValueForm::kFile)
    line += " -r -F";
  else if (option.form() == ValueForm::kFolder)
    line += " -x -a '(__fish_complete_directories)'";
  else if (option.form() == ValueForm::kText)
    line += " -x";
  return line + fmt::format(" -d {}\n", fish_quoted(first_sentence(option.description)));
}

}  // namespace

std::string fish_completion(const Program& program) {
  const std::vector<Command> commands = visible_commands(program);
  std::string out = "# Completion of kaustik for fish. Generated: `kaustik reference --format fish`.\n";
  for (const Command& command : commands)
    out += fmt::format("complete -c kaustik -n __fish_use_subcommand -f -a {} -d {}\n", command.name,
                       fish_quoted(command.description));
  for (const Option& option : program.options) out += option_line("__fish_use_subcommand", option);
  for (const Command& command : commands)
    for (const Option& option : command.options)
      out += option_line("__fish_seen_subcommand_from " + command.name, option);
  return out;
}

}  // namespace kaustik::app
