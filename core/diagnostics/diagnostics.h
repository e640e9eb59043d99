#pragma once
// Errors and warnings as data. Stages add to a list and go on, so that one run reports everything that is
// wrong with its input; nothing here prints or ends the program.

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics/source_location.h"

namespace kaustik {

enum class Severity { kWarning, kError };

// A second place that explains a diagnostic, e.g. where a name was defined first.
struct DiagnosticNote {
  SourceLocation location;
  std::string message;
};

struct Diagnostic {
  Severity severity = Severity::kError;
  SourceLocation location;
  std::string message;  // one sentence without a final stop; what was expected comes with it
  std::vector<DiagnosticNote> notes;
};

// Diagnostics in the order in which they were found. Not thread-safe: parallel work fills one list per item
// and appends them in item order.
class DiagnosticList {
 public:
  void error(const SourceLocation& where, std::string message, std::vector<DiagnosticNote> notes = {});
  void warning(const SourceLocation& where, std::string message, std::vector<DiagnosticNote> notes = {});
  void append(DiagnosticList other);
  // Orders by file (in order of opening), line and column; keeps the order of finding within one place.
  void sort_by_location();

  const std::vector<Diagnostic>& entries() const { return entries_; }
  bool has_errors() const { return error_count() > 0; }
  size_t error_count() const;
  size_t warning_count() const { return entries_.size() - error_count(); }

 private:
  std::vector<Diagnostic> entries_;
};

// Names and texts of the files that locations refer to. Texts stay where they are: views into them remain
// valid.
class SourceFiles {
 public:
  // name: as the user gave it (printed as it is); text may be empty when the file is not a text.
  uint32_t add(std::string name, std::string text);
  // Empty for a file that is not one of these, as where a description outlives what it was read with.
  std::string_view name(uint32_t file) const {
    return file < files_.size() ? std::string_view(files_[file].name) : std::string_view();
  }
  std::string_view text(uint32_t file) const { return files_[file].text; }
  size_t size() const { return files_.size(); }
  // The text of a line (from one) without its line end; empty when there is none.
  std::string_view line(uint32_t file, uint32_t line) const;

 private:
  struct File {
    std::string name, text;
    std::vector<size_t> line_starts;
  };
  std::deque<File> files_;
};

// Everything that a run has to say about its input.
class Diagnostics : public DiagnosticList {
 public:
  SourceFiles files;

  // "scene.pbrt:12:8: error: message", the source line, a caret under the column (tabs kept, so that both
  // lines shift alike; long lines are cut to a window around the caret); then the notes in the same form.
  // Ends with a newline.
  std::string format(const Diagnostic& diagnostic) const;
  // All of them, one after the other.
  std::string format_all() const;
};

}  // namespace kaustik
