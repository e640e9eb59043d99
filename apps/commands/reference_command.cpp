// kaustik reference: the command line described by the program itself, for the reference page, the man page
// and completions. Hidden from the help: the build and scripts/reference call it.

#include <fmt/format.h>

#include <array>

#include "apps/commands/commands.h"
#include "apps/console/exit_error.h"
#include "apps/reference/completions.h"
#include "apps/reference/man_page.h"
#include "apps/reference/reference_page.h"
#include "apps/session/files/output_files.h"

namespace kaustik::app {

namespace {

struct ReferenceOptions {
  std::string format, page, output;
};

std::string reference_text(const ReferenceOptions& options, const Program& program) {
  if (options.format == "man") return man_page(program);
  if (options.format == "bash") return bash_completion(program);
  if (options.format == "zsh") return zsh_completion(program);
  if (options.format == "fish") return fish_completion(program);
  if (options.format != "markdown")
    throw ExitError(kBadCommandLine,
                    fmt::format("--format {}: expected markdown, man, bash, zsh or fish", options.format));
  if (options.page.empty())
    throw ExitError(kBadCommandLine,
                    "--format markdown needs --page, the page whose tables are to be replaced");
  return updated_reference_page(text_of_file(options.page), program);
}

int run_reference(const ReferenceOptions& options, const Program& program, const Console& console) {
  const std::string text = reference_text(options, program);
  if (options.output.empty())
    console.out << text;
  else
    write_text_file(options.output, text);
  return kDone;
}

}  // namespace

Command make_reference_command(const Program& program) {
  Command command("reference", "Describe the command line");
  command.hidden = true;
  const auto options = std::make_shared<ReferenceOptions>();
  command.add_text("--format", "NAME", options->format, "markdown, man, bash, zsh or fish").required = true;
  command.add_text("--page", "FILE", options->page, "The page whose generated parts are to be replaced");
  command.add_text("-o,--output", "FILE", options->output, "File to write. Default: the output stream");
  command.run = [options, &program](const Console& console) {
    return run_reference(*options, program, console);
  };
  return command;
}

}  // namespace kaustik::app
