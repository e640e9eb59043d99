// kaustik reference: the command line described by the program itself, for the reference page, the man page
// and completions. Hidden from the help: the build and scripts/reference call it.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "apps/commands/commands.h"
#include "apps/console/exit_error.h"
#include "apps/reference/completions.h"
#include "apps/reference/man_page.h"
#include "apps/reference/reference_page.h"
#include "apps/session/output_files.h"

namespace kaustik::app {

namespace {

struct Options {
  std::string format, page, output;
};

std::string file_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw ExitError(kBadCommandLine, fmt::format("{}: {}", path, std::strerror(errno)));
  return text.str();
}

std::string reference_text(const Options& options, const ProgramModel& program) {
  if (options.format == "man") return man_page(program);
  if (options.format == "bash") return bash_completion(program);
  if (options.format == "zsh") return zsh_completion(program);
  if (options.format == "fish") return fish_completion(program);
  if (options.page.empty())
    throw ExitError(kBadCommandLine,
                    "--format markdown needs --page, the page whose tables are to be replaced");
  return updated_reference_page(file_text(options.page), program);
}

int run_reference(const Options& options, const CLI::App& program, const Console& console) {
  const std::string text = reference_text(options, program_model(program));
  if (options.output.empty())
    console.out << text;
  else
    write_text_file(options.output, text);
  return kDone;
}

}  // namespace

Command make_reference_command(CLI::App& program) {
  Command command;
  command.parser = program.add_subcommand("reference", "Describe the command line");
  const auto options = std::make_shared<Options>();
  CLI::App& parser = *command.parser;
  parser.group("");
  parser.add_option("--format", options->format, "markdown, man, bash, zsh or fish")
      ->required()
      ->option_text("NAME")
      ->check(CLI::IsMember({"markdown", "man", "bash", "zsh", "fish"}));
  parser.add_option("--page", options->page, "The page whose generated parts are to be replaced")
      ->option_text("FILE");
  parser.add_option("-o,--output", options->output, "File to write. Default: the output stream")
      ->option_text("FILE");
  command.run = [options, &program](const Console& console) {
    return run_reference(*options, program, console);
  };
  return command;
}

}  // namespace kaustik::app
