#pragma once
// Errors and warnings as data. Each stage adds to a list and continues, so that one run reports everything
// that is wrong with its input. Nothing here prints or ends the program.

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics/nearest_name.h"
#include "core/diagnostics/source_location.h"
#include "core/files/read_root.h"

namespace kaustik {

enum class Severity { kWarning, kError };

// A second location that explains a diagnostic, for example where a name was defined first.
struct DiagnosticNote {
  SourceLocation location;
  std::string message;
};

struct Diagnostic {
  Severity severity = Severity::kError;
  SourceLocation location;
  std::string message;  // one sentence without a full stop, which also says what was expected
  std::vector<DiagnosticNote> notes;
};

// Diagnostics in the order in which they were found. Not thread-safe: parallel code fills one list per item
// and appends the lists in the order of the items.
class DiagnosticList {
 public:
  void error(const SourceLocation& where, std::string message, std::vector<DiagnosticNote> notes = {});
  void warning(const SourceLocation& where, std::string message, std::vector<DiagnosticNote> notes = {});
  void append(DiagnosticList other);
  // name_hint() among names of the scene, of which there may be very many: names() returns them. A file with
  // thousands of wrong names would take minutes, so after kMostCompared comparisons there are no more hints.
  template <class Names>
  std::string hint(std::string_view name, const Names& names) {
    if (compared_ > kMostCompared) return {};
    const std::vector<std::string_view> candidates = names();
    compared_ += candidates.size();
    return name_hint(name, candidates);
  }
  // Sorts by file (in the order of opening), line and column; keeps the order of entries with the same
  // location.
  void sort_by_location();
  // Keeps the first of the warnings whose messages are equal, and appends to it how many there are.
  void merge_equal_warnings();

  const std::vector<Diagnostic>& entries() const { return entries_; }
  bool has_errors() const { return error_count() > 0; }
  size_t error_count() const;
  size_t warning_count() const { return entries_.size() - error_count(); }

 private:
  static constexpr size_t kMostCompared = 1'000'000;  // takes a second or less

  std::vector<Diagnostic> entries_;
  size_t compared_ = 0;
};

// Names and texts of the files that locations refer to. Texts never move, so views into them remain valid.
class SourceFiles {
 public:
  // name: as the user gave it (printed unchanged). text may be empty when the file is not a text file.
  uint32_t add(std::string name, std::string text);
  // Empty for an unknown file, for example when a description outlives the importer that read it.
  std::string_view name(uint32_t file) const {
    return file < files_.size() ? std::string_view(files_[file].name) : std::string_view();
  }
  std::string_view text(uint32_t file) const { return files_[file].text; }
  size_t size() const { return files_.size(); }
  // The text of a line (counted from one) without its line end; empty when there is no such line.
  std::string_view line(uint32_t file, uint32_t line) const;

  // Which files those that are added may name: all, unless a root is set.
  const ReadRoot& root() const { return root_; }
  ReadRoot& root() { return root_; }

 private:
  struct File {
    std::string name, text;
    std::vector<size_t> line_starts;  // of the first line and of each that is kIndexedLines later
  };
  // An index of every line would need as much memory as half of the text of a mesh.
  static constexpr uint32_t kIndexedLines = 1024;
  std::deque<File> files_;
  ReadRoot root_;
};

// Everything that a run reports about its input.
class Diagnostics : public DiagnosticList {
 public:
  SourceFiles files;

  // Formats "scene.pbrt:12:8: error: message", the source line and a caret under the column (tabs are kept,
  // so that both lines are indented alike; long lines are cut to a window around the caret), then the notes
  // in the same form. Ends with a newline.
  std::string format(const Diagnostic& diagnostic) const;
  // Formats all diagnostics, one after the other.
  std::string format_all() const;
};

}  // namespace kaustik
