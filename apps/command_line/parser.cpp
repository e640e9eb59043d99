#include "apps/command_line/parser.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "apps/command_line/other_names.h"
#include "core/diagnostics/nearest_name.h"

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

// CLI11 converts nothing: assign() receives the texts.
CLI::callback_t assigning(const std::function<void(const Texts&)>& assign, const std::string& name) {
  return [&assign, name](const CLI::results_t& texts) {
    try {
      assign(texts);
    } catch (const OptionError& error) {
      throw CLI::ParseError(error.what(), CLI::ExitCodes::ValidationError);
    }
    return true;
  };
}

void add_argument(CLI::App& parser, const Argument& argument) {
  CLI::Option* added =
      parser.add_option(argument.name, assigning(argument.assign, argument.name), argument.description);
  added->required(argument.required)->option_text(" ");
  if (argument.repeats) added->expected(1, CLI::detail::expected_max_vector_size)->allow_extra_args();
}

void add_option(CLI::App& parser, const Option& option) {
  const std::string names = fmt::format("{}", fmt::join(option.names, ","));
  if (option.long_name() == "--help") {
    parser.set_help_flag(names, option.description);
    return;
  }
  if (option.form() == ValueForm::kNone) {
    parser.add_flag_callback(
        names, [&option] { option.assign({}); }, option.description);
    return;
  }
  CLI::Option* added =
      parser.add_option(names, assigning(option.assign, option.long_name()), option.description);
  added->option_text(option.value_name)->expected(option.values)->required(option.required);
  if (option.is_setting) added->group(option.for_everyday ? "Everyday settings" : "Expert settings");
  if (option.at_commas) added->delimiter(',');
  if (option.takes_list) added->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  if (option.last_wins) added->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

void add_command(CLI::App& program, const Command& command) {
  CLI::App& parser = *program.add_subcommand(command.name, command.description);
  if (command.hidden) parser.group("");
  if (!command.examples.empty()) parser.footer("Examples:\n" + command.examples);
  for (const Argument& argument : command.arguments) add_argument(parser, argument);
  // Headings stand in the order in which their first options are added.
  for (const bool expert : {false, true})
    for (const Option& option : command.options)
      if ((option.is_setting && !option.for_everyday) == expert) add_option(parser, option);
  for (const Option& option : command.options) {
    for (const std::string& other : option.needs)
      parser.get_option(option.long_name())->needs(parser.get_option(other));
    for (const std::string& other : option.excludes)
      parser.get_option(option.long_name())->excludes(parser.get_option(other));
  }
}

// "; did you mean --kernel?" for a name that is near, or that is another program's; empty if there is
// neither.
std::string suggestion(const std::string& name, const std::vector<std::string_view>& known) {
  std::vector<std::string> here = names_here(name);
  std::erase_if(
      here, [&](const std::string& n) { return std::find(known.begin(), known.end(), n) == known.end(); });
  if (here.empty())
    if (const auto nearest = nearest_name(name, known)) here.emplace_back(*nearest);
  return here.empty() ? "" : fmt::format("; did you mean {}?", fmt::join(here, " and "));
}

// The message for arguments that the parser does not know, such as "unknown option --kernal; did you mean
// --kernel?".
std::string describe_extras(const CLI::App& parser, const Program& program, const Command* command) {
  const std::vector<std::string> extras = parser.remaining(true);
  if (extras.empty()) return "unexpected arguments";
  std::vector<std::string_view> known;
  for (const std::string& extra : extras) {
    if (!extra.starts_with('-')) continue;
    for (const Option& option : command ? command->options : program.options)
      known.push_back(option.long_name());
    const std::string name = extra.substr(0, extra.find('='));
    return fmt::format("unknown option {}{}", name, suggestion(name, known));
  }
  if (command) return fmt::format("unexpected argument {}", extras.front());
  for (const Command& c : program.commands)
    if (!c.hidden) known.push_back(c.name);
  return fmt::format("unknown command {}{}", extras.front(), name_hint(extras.front(), known));
}

// The command that was given; null if there is none.
const Command* given_command(const CLI::App& parser, const Program& program) {
  for (const Command& command : program.commands)
    if (parser.got_subcommand(command.name)) return &command;
  return nullptr;
}

// Reports a parse error and returns the exit code. CLI11 throws for --help and --version too, with exit code
// 0.
ExitCode report_error(const CLI::App& parser, const Program& program, const CLI::ParseError& error,
                      std::ostream& out, std::ostream& err) {
  if (error.get_exit_code() == 0) {
    parser.exit(error, out, err);
    return kDone;
  }
  const Command* command = given_command(parser, program);
  const std::string name = command ? program.name + " " + command->name : program.name;
  const bool unknown =
      dynamic_cast<const CLI::ExtrasError*>(&error) ||
      (!command && dynamic_cast<const CLI::RequiredError*>(&error) && !parser.remaining(true).empty());
  err << name << ": " << (unknown ? describe_extras(parser, program, command) : std::string(error.what()))
      << "\n`" << name << " --help` lists the " << (command ? "options" : "commands") << '\n';
  return kBadCommandLine;
}

}  // namespace

std::variant<const Command*, ExitCode> parse_arguments(const Program& program, int argc,
                                                       const char* const* argv, std::ostream& out,
                                                       std::ostream& err) {
  CLI::App parser(program.description, program.name);
  parser.set_version_flag("--version", program.version);
  parser.formatter(std::make_shared<WrappingFormatter>());  // the commands inherit it
  parser.require_subcommand(1);
  parser.footer(program.footer);
  for (const Command& command : program.commands) add_command(parser, command);
  try {
    parser.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return report_error(parser, program, error, out, err);
  }
  return given_command(parser, program);
}

}  // namespace kaustik::app
