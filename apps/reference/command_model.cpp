#include "apps/reference/command_model.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "apps/settings/list_options.h"
#include "apps/settings/setting_options.h"

namespace kaustik::app {

namespace {

ValueForm form_of(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return ValueForm::kNone;
  if (option.get_option_text() == "FILE") return ValueForm::kFile;
  if (option.get_option_text() == "FOLDER") return ValueForm::kFolder;
  return ValueForm::kText;
}

OptionModel option_model(const CLI::Option& option) {
  OptionModel out;
  for (const std::string& name : option.get_snames()) out.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) out.names.push_back("--" + name);
  out.form = form_of(option);
  out.value_name = out.form == ValueForm::kNone ? "" : option.get_option_text();
  out.description = option.get_description();
  out.choices = offered_choices(option);
  out.takes_list = option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  out.required = option.get_required();
  out.is_setting = option.get_group() == kSettingsGroup;
  return out;
}

CommandModel command_model(const CLI::App& command) {
  CommandModel out{command.get_name(), command.get_description(), {}, {}};
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional())
      out.positionals.push_back({option->get_name(true), option->get_description(), option->get_required(),
                                 option->get_items_expected_max() > 1});
    else
      out.options.push_back(option_model(*option));
  }
  return out;
}

}  // namespace

std::string CommandModel::usage() const {
  std::string text = "kaustik " + name;
  for (const PositionalModel& p : positionals) {
    const std::string word = p.name + (p.repeats ? "..." : "");
    text += p.required ? " " + word : " [" + word + "]";
  }
  for (const OptionModel& option : options)
    if (option.required) text += fmt::format(" {} {}", option.names.front(), option.value_name);
  return text + " [OPTIONS]";
}

ProgramModel program_model(const CLI::App& program) {
  ProgramModel out{program.get_description(), {}, {}};
  for (const CLI::Option* option : program.get_options()) out.options.push_back(option_model(*option));
  const auto visible = [](const CLI::App* command) { return !command->get_group().empty(); };
  for (const CLI::App* command : program.get_subcommands(visible))
    out.commands.push_back(command_model(*command));
  return out;
}

std::string option_heading(const OptionModel& option, bool code) {
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

}  // namespace kaustik::app
