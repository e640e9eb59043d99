#pragma once
// Warnings that a file may cause many times: each cause is reported once, at its first place, with a count.

#include <map>
#include <string>
#include <vector>

#include "core/diagnostics/diagnostics.h"

namespace kaustik::pbrt {

class RepeatedWarnings {
 public:
  // Counts one more warning of this cause; the message and the place are those of the first.
  void add(const std::string& cause, const SourceLocation& where, std::string message);
  // Adds one warning per cause, which says how often it occurred, and forgets them.
  void report(DiagnosticList& diagnostics);

 private:
  struct Warning {
    SourceLocation where;
    std::string message;
    size_t count = 0;
  };
  std::map<std::string, size_t> by_cause_;  // indices into warnings_
  std::vector<Warning> warnings_;
};

}  // namespace kaustik::pbrt
