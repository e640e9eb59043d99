#include "apps/reference/reference_page.h"

#include <fmt/format.h>

#include <map>
#include <stdexcept>

#include "apps/reference/exit_codes.h"
#include "apps/settings/table/table.h"

namespace kaustik::app {

namespace {

// Text of a cell of a Markdown table.
std::string cell(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

std::string commands_table(const std::vector<Command>& commands) {
  std::string text = "| command | does |\n| --- | --- |\n";
  for (const Command& command : commands)
    text += fmt::format("| [`{0}`](#kaustik-{0}) | {1} |\n", command.name, cell(command.description));
  return text;
}

std::string exit_codes_table() {
  std::string text = "| exit code | meaning |\n| --- | --- |\n";
  for (const ExitCodeRow& row : kExitCodes)
    text += fmt::format("| {} | {} |\n", static_cast<int>(row.code), cell(row.meaning));
  return text;
}

std::string settings_of(const Command& command) {
  std::string text;
  for (const Option& option : command.options)
    if (option.is_setting) text += fmt::format("{}`{}`", text.empty() ? "" : ", ", option.long_name());
  return text;
}

std::string command_part(const Command& command) {
  std::string text = fmt::format("```\n{}\n```\n\n{}.\n\n", usage(command), command.description);
  text += "| argument or option | meaning |\n| --- | --- |\n";
  for (const Argument& p : command.arguments)
    text += fmt::format("| `{}` | {} |\n", p.name, cell(p.description));
  for (const Option& option : command.options)
    if (!option.is_setting)
      text += fmt::format("| {} | {} |\n", option_heading(option, true), cell(option.description));
  const std::string settings = settings_of(command);
  if (!settings.empty()) text += fmt::format("\n[Settings](#settings): {}.\n", settings);
  return text;
}

std::map<std::string, std::string> parts_of(const Program& program) {
  const std::vector<Command> commands = visible_commands(program);
  std::map<std::string, std::string> parts = {{"commands", commands_table(commands)},
                                              {"exit-codes", exit_codes_table()},
                                              {"settings", settings_markdown()}};
  for (const Command& command : commands) parts[command.name] = command_part(command);
  return parts;
}

}  // namespace

std::string updated_reference_page(const std::string& page, const Program& program) {
  constexpr std::string_view kBegin = "<!-- generated: ", kEndOfLine = " -->\n";
  std::map<std::string, std::string> parts = parts_of(program);
  std::string out;
  size_t at = 0;
  for (size_t begin; (begin = page.find(kBegin, at)) != std::string::npos;) {
    const size_t name_at = begin + kBegin.size(), name_end = page.find(kEndOfLine, name_at);
    const std::string name = page.substr(name_at, std::min(name_end, page.size()) - name_at);
    const auto part = parts.find(name);
    if (part == parts.end())
      throw std::runtime_error(fmt::format("the generated part `{}` is unknown or occurs twice", name));
    const size_t end = page.find(fmt::format("<!-- end of {} -->", name), name_at);
    if (end == std::string::npos) throw std::runtime_error(fmt::format("the part `{}` has no end", name));
    out += page.substr(at, name_end + kEndOfLine.size() - at) + "\n" + part->second + "\n";
    at = end;
    parts.erase(part);
  }
  if (!parts.empty())
    throw std::runtime_error(fmt::format("the page lacks the part `{}`", parts.begin()->first));
  return out + page.substr(at);
}

}  // namespace kaustik::app
