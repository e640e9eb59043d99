#include "apps/command_line/command.h"

#include <fmt/format.h>

#include <utility>

#include "apps/command_line/values.h"

namespace kaustik::app {

namespace {

Option make_option(std::string_view names, std::string value_name, std::string description,
                   std::function<void(const Texts&)> assign) {
  Option option;
  option.names = split_at_commas(names);
  option.value_name = std::move(value_name);
  option.description = std::move(description);
  option.assign = std::move(assign);
  return option;
}

Option help_option() {
  return make_option("-h,--help", "", "Print this help message and exit", nullptr);
}

}  // namespace

Command::Command(std::string its_name, std::string its_description)
    : name(std::move(its_name)), description(std::move(its_description)), options{help_option()} {}

Argument& Command::add_argument(std::string argument, std::string& target, std::string text) {
  arguments.push_back(
      {std::move(argument), std::move(text), [&target](const Texts& texts) { target = texts.front(); }});
  return arguments.back();
}

Argument& Command::add_arguments(std::string argument, Texts& target, std::string text) {
  arguments.push_back(
      {std::move(argument), std::move(text), [&target](const Texts& texts) { target = texts; }});
  arguments.back().repeats = true;
  return arguments.back();
}

Option& Command::add_flag(std::string_view names, bool& target, std::string text) {
  return add_option(make_option(names, "", std::move(text), [&target](const Texts&) { target = true; }));
}

void Command::add_quiet(std::string text) {
  add_flag("-q,--quiet", *quiet, std::move(text));
}

Option& Command::add_text(std::string_view names, std::string value_name, std::string& target,
                          std::string text) {
  return add_parsed(names, std::move(value_name), std::move(text),
                    [&target](const std::string& value) { target = value; });
}

Option& Command::add_number(std::string_view names, std::string value_name, std::optional<float>& target,
                            std::string text) {
  const auto parse = [&target, name = split_at_commas(names).back()](const std::string& value) {
    target = parse_number(value);
    if (!target || *target < 0)
      throw OptionError(name, fmt::format("`{}`: expected a number of at least 0", value));
  };
  return add_parsed(names, std::move(value_name), std::move(text), parse);
}

Option& Command::add_list(std::string_view names, std::string value_name, Texts& target, std::string text) {
  Option& option = add_option(make_option(names, std::move(value_name), std::move(text),
                                          [&target](const Texts& texts) { target = texts; }));
  option.takes_list = option.at_commas = true;
  return option;
}

Option& Command::add_parsed(std::string_view names, std::string value_name, std::string text,
                            std::function<void(const std::string&)> assign) {
  return add_option(make_option(names, std::move(value_name), std::move(text),
                                [assign = std::move(assign)](const Texts& texts) { assign(texts.front()); }));
}

Option& Command::add_option(Option option) {
  options.push_back(std::move(option));
  return options.back();
}

std::vector<std::string> choices_of(std::span<const std::string_view> names) {
  return {names.begin(), names.end()};
}

Program::Program(std::string its_name, std::string its_description)
    : name(std::move(its_name)), description(std::move(its_description)), options{help_option()} {
  options.push_back(make_option("--version", "", "Display program version information and exit", nullptr));
}

}  // namespace kaustik::app
