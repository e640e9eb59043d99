#pragma once
// The exception that ends a command early. run() catches it, prints the message and returns the code.

#include <stdexcept>
#include <string>

#include "apps/console/exit_code.h"

namespace kaustik::app {

// An empty message prints nothing, for errors that have been reported already.
class ExitError : public std::runtime_error {
 public:
  ExitError(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

// Ends the command because of a bad command line.
[[noreturn]] inline void refuse(const std::string& message) {
  throw ExitError(kBadCommandLine, message);
}

}  // namespace kaustik::app
