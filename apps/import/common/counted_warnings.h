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
    add({where, cause, cause, times});
  }
  // For causes of one kind whose texts differ, as in names: the first text is reported, with the number of
  // others.
  void say_one_of(const std::string& kind, const SourceLocation& where, const std::string& text) {
    add({where, kind, text, 1});
  }

  bool knows(const std::string& cause) const { return index_.count(cause) > 0; }

  // Appends the causes of a later part of the file.
  void append(const CountedWarnings& later) {
    for (const Cause& cause : later.causes_) add(cause);
  }

  // Reports all causes in the order in which they were met, and forgets them.
  void report(DiagnosticList& diagnostics) {
    for (const Cause& cause : causes_) diagnostics.warning(cause.where, cause.text + count(cause));
    causes_.clear();
    index_.clear();
  }

 private:
  struct Cause {
    SourceLocation where;
    std::string kind, text;
    uint64_t times = 0;
  };

  void add(const Cause& cause) {
    const auto [at, is_new] = index_.try_emplace(cause.kind, causes_.size());
    if (is_new)
      causes_.push_back(cause);
    else
      causes_[at->second].times += cause.times;
  }

  static std::string count(const Cause& cause) {
    if (cause.times == 1) return "";
    return cause.kind == cause.text ? " (" + std::to_string(cause.times) + " times)"
                                    : " (and " + std::to_string(cause.times - 1) + " more)";
  }

  std::vector<Cause> causes_;
  std::map<std::string, size_t> index_;  // into causes_, by kind
};

}  // namespace kaustik
