#pragma once
// Reports each cause of warnings once, where it was met first, with the number of times.

#include <map>
#include <string>
#include <vector>

#include "core/diagnostics/diagnostics.h"

namespace kaustik {

class CountedWarnings {
 public:
  void say(const SourceLocation& where, const std::string& cause, uint64_t times = 1) {
    const auto [at, is_new] = index_.try_emplace(cause, causes_.size());
    if (is_new) causes_.push_back({where, cause, 0});
    causes_[at->second].times += times;
  }

  bool knows(const std::string& cause) const { return index_.count(cause) > 0; }

  // Appends the causes of a later part of the file.
  void append(const CountedWarnings& later) {
    for (const Cause& cause : later.causes_) say(cause.where, cause.text, cause.times);
  }

  // Reports all causes in the order in which they were met, and forgets them.
  void report(DiagnosticList& diagnostics) {
    for (const Cause& cause : causes_)
      diagnostics.warning(cause.where, cause.times == 1
                                           ? cause.text
                                           : cause.text + " (" + std::to_string(cause.times) + " times)");
    causes_.clear();
    index_.clear();
  }

 private:
  struct Cause {
    SourceLocation where;
    std::string text;
    uint64_t times = 0;
  };
  std::vector<Cause> causes_;
  std::map<std::string, size_t> index_;  // into causes_
};

}  // namespace kaustik
