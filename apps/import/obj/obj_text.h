#pragma once
// The words and numbers of OBJ and MTL files.

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace kaustik::obj {

inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

// The text without blanks at its ends.
std::string_view trimmed(std::string_view text);

// The words of a line, one after the other.
class Words {
 public:
  explicit Words(std::string_view line) : line_(line) {}

  // The next word; empty at the end of the line and at a word that begins with #, which begins a comment.
  std::string_view next() {
    while (at_ < line_.size() && is_blank(line_[at_])) ++at_;
    start_ = at_;
    if (at_ < line_.size() && line_[at_] == '#') at_ = line_.size();
    if (at_ == line_.size()) return {};
    while (at_ < line_.size() && !is_blank(line_[at_])) ++at_;
    return line_.substr(start_, at_ - start_);
  }
  // What follows the last word. A # is part of it, since names such as `Material #25` are common.
  std::string_view rest() const { return trimmed(line_.substr(at_)); }
  // Where the last word begins, in bytes from one.
  size_t column() const { return start_ + 1; }

 private:
  std::string_view line_;
  size_t at_ = 0, start_ = 0;
};

// Reads a word such as `.5`, `+2`, `2.`, `-.7e+02`, `.8e-001` or `nan`, also with the comma of some countries
// in place of the point. The NaN and infinity of Microsoft's library, as in `-1.#IND`, are NaN. Nothing when
// the word is no number.
std::optional<double> number_of(std::string_view word);

// Removes the next line, without its line end, from the front of `text`. A backslash at the end of a line of
// numbers (those of v, vt, vn, f, l and p) continues it: then `joined` receives the whole line, with each
// backslash and line end as blanks, and the result is a view of it. `lines` receives the number of lines that
// were removed.
std::string_view take_line(std::string_view& text, std::string& joined, uint32_t& lines);

}  // namespace kaustik::obj
