#include "apps/session/isa_option.h"

#include "apps/machine/instruction_set.h"

namespace kaustik::app {

void add_isa_option(Command& command) {
  Option& option =
      command.add_parsed("--isa", "NAME",
                         "Use no more than these instructions: avx2 or avx512. Machines that have them then "
                         "give the same bits, and "
                         "their partial results merge. Default: native, all that the machine has",
                         [](const std::string& text) {
                           try {
                             pin_instruction_set(text);
                           } catch (const std::invalid_argument& error) {
                             throw OptionError("--isa", error.what());
                           }
                         });
  option.choices = choices_of(kIsaNames);
}

}  // namespace kaustik::app
