#include "apps/run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <new>
#include <sstream>

#include "apps/commands/commands.h"
#include "apps/console/exit_error.h"
#include "apps/reference/exit_codes.h"
#include "core/diagnostics/nearest_name.h"
#include "core/version.h"

namespace kaustik::app {

namespace {

// Wraps the descriptions of options: CLI11 indents them but does not break lines.
class WrappingFormatter : public CLI::Formatter {
 public:
  std::string make_option_desc(const CLI::Option* option) const override {
    constexpr size_t kWidth = 80;
    std::string text;
    size_t line = 0;
    std::istringstream words(option->get_description());
    for (std::string word; words >> word; line += word.size() + 1) {
      if (line > 0 && line + word.size() > kWidth) {
        text += '\n';
        line = 0;
      } else if (line > 0) {
        text += ' ';
      }
      text += word;
    }
    return text;
  }
};

std::string exit_codes() {
  std::string text;
  for (const ExitCodeRow& row : kExitCodes)
    text += fmt::format("{} {} {}", text.empty() ? "Exit codes:" : ",", int(row.code), row.summary);
  return text + ".";
}

struct Program {
  CLI::App parser{"Photon-mapping renderer: caustics, direct and indirect light from the command line",
                  "kaustik"};
  std::vector<Command> commands;

  Program() {
    parser.set_version_flag("--version", fmt::format("kaustik {} ({})", version(), build_id()));
    parser.formatter(std::make_shared<WrappingFormatter>());  // the commands inherit it
    parser.require_subcommand(1);
    parser.footer(exit_codes() + "\n`kaustik COMMAND --help` explains a command.");
    commands.push_back(make_render_command(parser));
    commands.push_back(make_resume_command(parser));
    commands.push_back(make_merge_command(parser));
    commands.push_back(make_photons_command(parser));
    commands.push_back(make_compare_command(parser));
    commands.push_back(make_info_command(parser));
    commands.push_back(make_convert_command(parser));
    commands.push_back(make_bench_command(parser));
    commands.push_back(make_sweep_command(parser));
    commands.push_back(make_reference_command(parser));
  }

  // The command that was given; null before parsing and when there is none.
  const Command* given() const {
    for (const Command& command : commands) {
      if (command.parser->parsed()) return &command;
    }
    return nullptr;
  }
};

std::vector<std::string> option_names(const CLI::App& parser) {
  std::vector<std::string> names;
  for (const CLI::Option* option : parser.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

// The message for arguments that the parser does not know, such as "unknown option --kernal; did you mean
// --kernel?".
std::string describe_extras(const Program& program, const Command* command) {
  const CLI::App& parser = command ? *command->parser : program.parser;
  const std::vector<std::string> extras = program.parser.remaining(true);
  if (extras.empty()) return "unexpected arguments";
  for (const std::string& extra : extras) {
    if (extra.rfind('-', 0) != 0) continue;
    const std::string name = extra.substr(0, extra.find('='));
    const std::vector<std::string> known = option_names(parser);
    const std::vector<std::string_view> views(known.begin(), known.end());
    const auto nearest = nearest_name(name, views);
    return fmt::format("unknown option {}{}", name,
                       nearest ? fmt::format("; did you mean {}?", *nearest) : "");
  }
  if (command) return fmt::format("unexpected argument {}", extras.front());
  std::vector<std::string_view> names;
  for (const Command& c : program.commands)
    if (!c.parser->get_group().empty()) names.push_back(c.parser->get_name());
  return fmt::format("unknown command {}{}", extras.front(), name_hint(extras.front(), names));
}

// Reports a parse error and returns the exit code. CLI11 throws for --help and --version too, with exit code
// 0.
int report_parse_error(const Program& program, const CLI::ParseError& error, std::ostream& out,
                       std::ostream& err) {
  if (error.get_exit_code() == 0) return program.parser.exit(error, out, err);
  const Command* command = program.given();
  const std::string name = command ? "kaustik " + command->parser->get_name() : "kaustik";
  const bool unknown = dynamic_cast<const CLI::ExtrasError*>(&error) ||
                       (!command && dynamic_cast<const CLI::RequiredError*>(&error) &&
                        !program.parser.remaining(true).empty());
  err << name << ": " << (unknown ? describe_extras(program, command) : std::string(error.what())) << '\n'
      << "`" << name << " --help` lists the " << (command ? "options" : "commands") << '\n';
  return kBadCommandLine;
}

int run_command(const Command& command, const Console& console) {
  try {
    return command.run(console);
  } catch (const ExitError& error) {
    if (*error.what() != '\0') console.error(error.what());
    return error.code();
  } catch (const std::bad_alloc&) {
    console.error("out of memory");
  } catch (const std::exception& error) {
    console.error(error.what());
  }
  return kFailed;
}

}  // namespace

int run(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  Program program;
  try {
    program.parser.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return report_parse_error(program, error, out, err);
  }
  const Command& command = *program.given();
  const std::string name = "kaustik " + command.parser->get_name();
  const bool terminal = &err == &std::cerr && isatty(STDERR_FILENO) != 0;
  return run_command(command, Console{out, err, terminal, *command.quiet, name});
}

}  // namespace kaustik::app
