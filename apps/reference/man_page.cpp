#include "apps/reference/man_page.h"

#include <fmt/format.h>

#include "apps/reference/exit_codes.h"
#include "apps/settings/table/table.h"
#include "core/version.h"

namespace kaustik::app {

namespace {

// Text in which roff finds no request and no escape. Backquotes, which mark code, become bold.
std::string roff(std::string_view text) {
  std::string out;
  bool bold = false;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if (c == '`')
      out += (bold = !bold) ? "\\fB" : "\\fR";
    else
      out += c;
  }
  if (out.starts_with('.') || out.starts_with('\'')) out.insert(0, "\\&");
  return out;
}

// A paragraph with a bold label.
std::string tagged(const std::string& label, std::string_view text) {
  return fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff(label), roff(text));
}

std::string command_section(const Command& command) {
  std::string out = fmt::format(".SS {}\n{}.\n", roff(usage(command)), roff(command.description));
  std::string settings;
  for (const Argument& p : command.arguments) out += tagged(p.name, p.description);
  for (const Option& option : command.options) {
    if (option.is_setting)
      settings += fmt::format("{}`{}`", settings.empty() ? "" : ", ", option.long_name());
    else
      out += tagged(option_heading(option), option.description);
  }
  if (!settings.empty()) out += fmt::format(".PP\nSettings: {}.\n", roff(settings));
  return out;
}

std::string setting_entry(const Setting& s) {
  const std::string unit = s.unit.empty() ? "" : fmt::format(" [{}]", s.unit);
  return tagged(fmt::format("--{} {}", s.name, s.value_name),
                fmt::format("{} Values{}: {}. Default: {}.", s.doc, unit, s.range, s.default_text));
}

std::string exit_status() {
  std::string out = ".SH EXIT STATUS\n";
  for (const ExitCodeRow& row : kExitCodes) out += tagged(std::to_string(int(row.code)), row.meaning);
  return out;
}

constexpr std::string_view kExamples =
    ".SH EXAMPLES\n"
    ".TP\nRender a scene to a picture that shows its radiance and one for the screen:\n"
    "\\fBkaustik render room.pbrt \\-o room.exr \\-o room.png\\fR\n"
    ".TP\nRender until the mean error is below 2 %, ten minutes at most:\n"
    "\\fBkaustik render room.pbrt \\-o room.exr \\-\\-target\\-error 2% \\-\\-time 10m\\fR\n"
    ".TP\nCompare a picture with a reference:\n"
    "\\fBkaustik compare reference.exr room.exr\\fR\n";

}  // namespace

std::string man_page(const Program& program) {
  const std::vector<Command> commands = visible_commands(program);
  std::string out =
      fmt::format(".TH KAUSTIK 1 \"\" \"kaustik {}\" \"User Commands\"\n", roff(std::string(version())));
  out += fmt::format(".SH NAME\nkaustik \\- {}\n", roff("photon-mapping renderer for the command line"));
  out += ".SH SYNOPSIS\n";
  for (const Command& command : commands) {
    if (&command != &commands.front()) out += ".br\n";
    out += fmt::format("\\fB{}\\fR\n", roff(usage(command)));
  }
  out += fmt::format(".SH DESCRIPTION\n{}.\n", roff(program.description));
  for (const Option& option : program.options) out += tagged(option_heading(option), option.description);
  out += ".SH COMMANDS\n";
  for (const Command& command : commands) out += command_section(command);
  out +=
      ".SH SETTINGS\nEach command lists the settings that it takes. All of them are parameters of the scene "
      "file's\n"
      "Integrator \"photonmap\" line too, with or without their dashes; the command line wins over the "
      "file.\n";
  for (const Setting& setting : settings_table()) out += setting_entry(setting);
  out += exit_status();
  return out + std::string(kExamples);
}

}  // namespace kaustik::app
