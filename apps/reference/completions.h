#pragma once
// Completion scripts for shells: commands, options, values of options that have only a few, and file names.

#include <string>

#include "apps/reference/option_text.h"

namespace kaustik::app {

std::string bash_completion(const Program& program);
std::string zsh_completion(const Program& program);
std::string fish_completion(const Program& program);

}  // namespace kaustik::app
