#pragma once
#include <set>
#include <string>

#include "core/diagnostics/diagnostics.h"

namespace kaustik {

// Reports each warning about a file once.
class FileWarnings {
 public:
  FileWarnings(const SourceLocation& where, DiagnosticList& diagnostics)
      : where_(where), diagnostics_(diagnostics) {}

  void say(const std::string& message) {
    if (said_.insert(message).second) diagnostics_.warning(where_, message);
  }
  const SourceLocation& where() const { return where_; }

 private:
  SourceLocation where_;
  DiagnosticList& diagnostics_;
  std::set<std::string> said_;
};

}  // namespace kaustik
