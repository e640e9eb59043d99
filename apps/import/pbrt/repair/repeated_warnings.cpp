#include "apps/import/pbrt/repair/repeated_warnings.h"

#include <fmt/format.h>

namespace kaustik::pbrt {

void RepeatedWarnings::add(const std::string& cause, const SourceLocation& where, std::string message) {
  const auto [found, is_new] = by_cause_.emplace(cause, warnings_.size());
  if (is_new) warnings_.push_back({where, std::move(message)});
  ++warnings_[found->second].count;
}

void RepeatedWarnings::report(DiagnosticList& diagnostics) {
  for (Warning& w : warnings_) {
    if (w.count > 1) w.message += fmt::format(" ({} times in all)", w.count);
    diagnostics.warning(w.where, std::move(w.message));
  }
  warnings_.clear();
  by_cause_.clear();
}

}  // namespace kaustik::pbrt
