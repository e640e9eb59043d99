#pragma once
#include <fmt/format.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics/diagnostics.h"

namespace kaustik {

// Reports each warning about a file once.
class FileWarnings {
 public:
  FileWarnings(const SourceLocation& where, DiagnosticList& diagnostics)
      : where_(where), diagnostics_(diagnostics) {}
  FileWarnings(const FileWarnings&) = delete;
  FileWarnings& operator=(const FileWarnings&) = delete;
  // Reports what was counted.
  ~FileWarnings() {
    for (const Counted& c : counted_)
      diagnostics_.warning(where_,
                           fmt::format("{} ({} {}{})", c.message, c.times, c.noun, c.times == 1 ? "" : "s"));
  }

  void say(const std::string& message) {
    if (said_.insert(message).second) diagnostics_.warning(where_, message);
  }
  // Counts the things that a warning concerns; the warning is reported at the end, as "MESSAGE (3 NOUNs)".
  void count(const std::string& message, std::string_view noun) {
    for (Counted& c : counted_) {
      if (c.message == message) return void(++c.times);
    }
    counted_.push_back({message, noun, 1});
  }
  const SourceLocation& where() const { return where_; }

 private:
  struct Counted {
    std::string message;
    std::string_view noun;
    uint64_t times;
  };

  SourceLocation where_;
  DiagnosticList& diagnostics_;
  std::set<std::string> said_;
  std::vector<Counted> counted_;
};

}  // namespace kaustik
