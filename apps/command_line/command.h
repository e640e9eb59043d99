#pragma once
// The subcommands as plain data. A command adds its options with the functions below; only parser.cpp knows
// the library that parses them.

#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "apps/command_line/option.h"
#include "apps/console/console.h"
#include "apps/console/exit_code.h"

namespace kaustik::app {

struct Command {
  std::string name, description;
  std::string examples;  // lines at the end of its help; empty for none
  bool hidden = false;   // the help and the reference do not show it
  std::vector<Argument> arguments;
  std::vector<Option> options;  // in the order of the help
  // Runs the command and returns the exit code. Throws ExitError, or any other exception for a failure during
  // the work.
  std::function<int(const Console&)> run;
  // Set by --quiet, if the command has this option.
  std::shared_ptr<bool> quiet = std::make_shared<bool>(false);

  // A command with the option --help alone.
  Command(std::string name, std::string description);

  // The functions below add an argument or an option. `names`: "-o,--output". The targets must outlive the
  // parsing, and hold the defaults. A reference that is returned is valid until the next call.

  Argument& add_argument(std::string name, std::string& target, std::string description);
  Argument& add_arguments(std::string name, Texts& target, std::string description);
  Option& add_flag(std::string_view names, bool& target, std::string description);
  void add_quiet(std::string description = "Suppress log and progress, but not warnings and errors");
  Option& add_text(std::string_view names, std::string value_name, std::string& target,
                   std::string description);
  // A finite number of at least 0.
  Option& add_number(std::string_view names, std::string value_name, std::optional<float>& target,
                     std::string description);
  // Values separated by commas, which replace those of the target; a repeated option adds its values.
  Option& add_list(std::string_view names, std::string value_name, Texts& target, std::string description);
  // `assign` receives the text of the value; it throws OptionError.
  Option& add_parsed(std::string_view names, std::string value_name, std::string description,
                     std::function<void(const std::string&)> assign);
  Option& add_option(Option option);
};

// Names as an option's choices.
std::vector<std::string> choices_of(std::span<const std::string_view> names);

struct Program {
  std::string name, description;
  std::string version;            // what --version prints
  std::string footer;             // the last lines of the help
  std::vector<Option> options;    // those of the program itself, before a command: --help and --version
  std::vector<Command> commands;  // in the order of the help

  Program(std::string name, std::string description);
};

}  // namespace kaustik::app
