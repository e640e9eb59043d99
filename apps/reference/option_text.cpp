#include "apps/reference/option_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace kaustik::app {

std::string usage(const Command& command) {
  std::string text = "kaustik " + command.name;
  for (const Argument& argument : command.arguments) {
    const std::string word = argument.name + (argument.repeats ? "..." : "");
    text += argument.required ? " " + word : " [" + word + "]";
  }
  for (const Option& option : command.options)
    if (option.required) text += fmt::format(" {} {}", option.names.front(), option.value_name);
  return text + " [OPTIONS]";
}

std::string option_heading(const Option& option, bool code) {
  std::string text;
  const std::string_view quote = code ? "`" : "";
  for (const std::string& name : option.names) {
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", quote, name);
    if (!option.value_name.empty()) text += " " + option.value_name;
    text += quote;
  }
  return text;
}

std::string first_sentence(const std::string& description) {
  const size_t end = std::min(description.find(". "), description.size());
  std::string text = description.substr(0, end);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::vector<Command> visible_commands(const Program& program) {
  std::vector<Command> commands;
  std::copy_if(program.commands.begin(), program.commands.end(), std::back_inserter(commands),
               [](const Command& command) { return !command.hidden; });
  return commands;
}

}  // namespace kaustik::app
