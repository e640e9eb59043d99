// Collects diagnostics and formats them with an excerpt of the source.

#include "core/diagnostics/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace kaustik {
namespace {

// A longer line is cut to a window around the caret, since inline meshes fill lines of megabytes.
constexpr size_t kWindow = 100;

bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xc0u) == 0x80u;
}

// The line with control characters other than tabs replaced by blanks.
std::string printable(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    if (static_cast<unsigned char>(c) < 0x20u && c != '\t') c = ' ';
    if (c == 0x7f) c = ' ';
  }
  return out;
}

// Replaces the text before the caret by blanks, but keeps its tabs, so that the caret appears below its
// character.
std::string caret_line(std::string_view before) {
  std::string out;
  for (const char c : before) {
    if (!continues_character(c)) out += c == '\t' ? '\t' : ' ';
  }
  return out + '^';
}

std::string source_excerpt(std::string_view line, uint32_t column) {
  if (line.empty() || column == 0) return {};
  const size_t caret = std::min<size_t>(column - 1, line.size());
  size_t begin = 0;
  size_t end = line.size();
  if (line.size() > kWindow) {
    begin = caret > kWindow / 2 ? caret - kWindow / 2 : 0;
    end = std::min(line.size(), begin + kWindow);
    while (begin < caret && continues_character(line[begin])) ++begin;
    while (end < line.size() && continues_character(line[end])) ++end;
  }
  std::string text = begin > 0 ? "..." : "";
  const std::string prefix = text + printable(line.substr(begin, caret - begin));
  text = prefix + printable(line.substr(caret, end - caret)) + (end < line.size() ? "..." : "");
  return fmt::format("{}\n{}\n", text, caret_line(prefix));
}

std::string format_one(const SourceFiles& files, const SourceLocation& where, std::string_view severity,
                       std::string_view message) {
  if (!where.valid()) return fmt::format("{}: {}\n", severity, message);
  const std::string_view name = files.name(where.file);
  if (where.line == 0) return fmt::format("{}: {}: {}\n", name, severity, message);
  return fmt::format("{}:{}:{}: {}: {}\n{}", name, where.line, where.column, severity, message,
                     source_excerpt(files.line(where.file, where.line), where.column));
}

}  // namespace

void DiagnosticList::error(const SourceLocation& where, std::string message,
                           std::vector<DiagnosticNote> notes) {
  entries_.push_back({Severity::kError, where, std::move(message), std::move(notes)});
}

void DiagnosticList::warning(const SourceLocation& where, std::string message,
                             std::vector<DiagnosticNote> notes) {
  entries_.push_back({Severity::kWarning, where, std::move(message), std::move(notes)});
}

void DiagnosticList::append(DiagnosticList other) {
  for (Diagnostic& d : other.entries_) entries_.push_back(std::move(d));
}

void DiagnosticList::sort_by_location() {
  const auto key = [](const Diagnostic& d) {
    return std::tuple(d.location.file, d.location.line, d.location.column);
  };
  std::stable_sort(entries_.begin(), entries_.end(),
                   [&](const Diagnostic& a, const Diagnostic& b) { return key(a) < key(b); });
}

void DiagnosticList::merge_equal_warnings() {
  std::map<std::string, size_t> counts;
  for (const Diagnostic& d : entries_)
    if (d.severity == Severity::kWarning) ++counts[d.message];
  std::vector<Diagnostic> kept;
  for (Diagnostic& d : entries_) {
    if (d.severity == Severity::kWarning) {
      const size_t count = std::exchange(counts[d.message], 0);
      if (count == 0) continue;
      if (count > 1) d.message += fmt::format(" ({} times)", count);
    }
    kept.push_back(std::move(d));
  }
  entries_ = std::move(kept);
}

size_t DiagnosticList::error_count() const {
  return static_cast<size_t>(std::count_if(
      entries_.begin(), entries_.end(), [](const Diagnostic& d) { return d.severity == Severity::kError; }));
}

uint32_t SourceFiles::add(std::string name, std::string text) {
  File& file = files_.emplace_back(File{std::move(name), std::move(text), {0}});
  uint64_t line = 1;
  for (size_t i = file.text.find('\n'); i != std::string::npos; i = file.text.find('\n', i + 1))
    if (line++ % kIndexedLines == 0) file.line_starts.push_back(i + 1);
  return static_cast<uint32_t>(files_.size() - 1);
}

std::string_view SourceFiles::line(uint32_t file, uint32_t line) const {
  if (file >= files_.size() || line == 0) return {};
  const File& f = files_[file];
  if ((line - 1) / kIndexedLines >= f.line_starts.size()) return {};
  std::string_view rest = std::string_view(f.text).substr(f.line_starts[(line - 1) / kIndexedLines]);
  for (uint32_t ahead = (line - 1) % kIndexedLines; ahead > 0; --ahead) {
    const size_t end = rest.find('\n');
    if (end == rest.npos) return {};
    rest.remove_prefix(end + 1);
  }
  rest = rest.substr(0, rest.find('\n'));
  if (!rest.empty() && rest.back() == '\r') rest.remove_suffix(1);
  return rest;
}

std::string Diagnostics::format(const Diagnostic& diagnostic) const {
  const bool is_error = diagnostic.severity == Severity::kError;
  std::string out =
      format_one(files, diagnostic.location, is_error ? "error" : "warning", diagnostic.message);
  for (const DiagnosticNote& note : diagnostic.notes) {
    out += format_one(files, note.location, "note", note.message);
  }
  return out;
}

std::string Diagnostics::format_all() const {
  std::string out;
  for (const Diagnostic& d : entries()) out += format(d);
  return out;
}

}  // namespace kaustik
