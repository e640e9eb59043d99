#pragma once
// Completion scripts for shells: commands, options, values of options that have only a few, and file names.

#include <string>

#include "apps/reference/command_model.h"

namespace kaustik::app {

std::string bash_completion(const ProgramModel& program);
std::string zsh_completion(const ProgramModel& program);
std::string fish_completion(const ProgramModel& program);

}  // namespace kaustik::app
