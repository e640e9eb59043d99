#include "apps/run.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <new>
#include <string_view>

#include "apps/command_line/parser.h"
#include "apps/commands/commands.h"
#include "apps/console/exit_error.h"
#include "apps/reference/exit_codes.h"
#include "core/version.h"

namespace kaustik::app {

namespace {

std::string exit_codes() {
  std::string text;
  for (const ExitCodeRow& row : kExitCodes)
    text += fmt::format("{} {} {}", text.empty() ? "Exit codes:" : ",", int(row.code), row.summary);
  return text + ".";
}

void add_commands(Program& program) {
  program.commands.push_back(make_render_command());
  program.commands.push_back(make_view_command());
  program.commands.push_back(make_shoot_command());
  program.commands.push_back(make_resume_command());
  program.commands.push_back(make_merge_command());
  program.commands.push_back(make_split_command());
  program.commands.push_back(make_status_command());
  program.commands.push_back(make_photons_command());
  program.commands.push_back(make_compare_command());
  program.commands.push_back(make_denoise_command());
  program.commands.push_back(make_info_command());
  program.commands.push_back(make_convert_command());
  program.commands.push_back(make_bench_command());
  program.commands.push_back(make_sweep_command());
  program.commands.push_back(make_reference_command(program));
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

// Readers of nested scenes and Embree recurse.
bool stack_is_too_small() {
  constexpr rlim_t kSmallestStack = 1 << 20;  // bytes
  rlimit limit{};
  return getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur < kSmallestStack;
}

// Whether a file is a terminal that can redraw a line.
bool redraws_lines(int file) {
  const char* const type = std::getenv("TERM");
  return isatty(file) != 0 && !(type && std::string_view(type) == "dumb");
}

int run_program(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  Program program("kaustik",
                  "Photon-mapping renderer: caustics, direct and indirect light from the command line");
  program.version = fmt::format("kaustik {} ({})", version(), build_id());
  program.footer = exit_codes() + "\n`kaustik COMMAND --help` explains a command.";
  add_commands(program);
  const auto parsed = parse_arguments(program, argc, argv, out, err);
  if (const ExitCode* code = std::get_if<ExitCode>(&parsed)) return *code;
  const Command& command = *std::get<const Command*>(parsed);
  const std::string name = program.name + " " + command.name;
  const bool terminal = &err == &std::cerr && redraws_lines(STDERR_FILENO);
  return run_command(command, Console{out, err, terminal, *command.quiet, name});
}

}  // namespace

int run(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  if (stack_is_too_small()) {
    err << "kaustik: the stack is limited to less than 1 MB (`ulimit -s`)\n";
    return kFailed;
  }
  int code = kFailed;
  try {
    code = run_program(argc, argv, out, err);
  } catch (const std::bad_alloc&) {  // before the command ran
    err << "kaustik: out of memory\n";
  } catch (const std::exception& error) {
    err << "kaustik: " << error.what() << '\n';
  }
  errno = 0;
  if (out.flush()) return code;
  err << "kaustik: cannot write to the standard output: "
      << (errno != 0 ? std::strerror(errno) : "it did not take all of the results") << '\n';
  return code == kDone ? kFailed : code;
}

}  // namespace kaustik::app
