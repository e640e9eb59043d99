#pragma once
// Splits a pbrt file into words, strings, numbers and brackets with their locations.

#include <string>
#include <string_view>

#include "core/diagnostics/diagnostics.h"

namespace kaustik::pbrt {

enum class TokenKind { kWord, kString, kNumber, kOpen, kClose, kEnd };

struct Token {
  TokenKind kind = TokenKind::kEnd;
  std::string_view text;  // for strings: the text between the quotes, with escapes unresolved
  SourceLocation location;

  bool is(TokenKind k) const { return kind == k; }
};

// Splits a file's text, which must outlive the tokens. Skips comments (# to the end of the line) and blanks.
// Reports unclosed strings and control characters, and continues after them.
class Tokenizer {
 public:
  Tokenizer(uint32_t file, std::string_view text, DiagnosticList& diagnostics);

  Token next();
  const Token& peek();

 private:
  Token read();
  Token read_string();
  Token read_bare();
  void skip_blanks();
  SourceLocation here() const;

  uint32_t file_;
  std::string_view text_;
  DiagnosticList& diagnostics_;
  size_t position_ = 0;
  size_t line_start_ = 0;
  uint32_t line_ = 1;
  bool has_peeked_ = false;
  Token peeked_;
};

// Resolves the escapes of a string: \" \\ \n \t \r \b \f.
std::string unescape(std::string_view text);

}  // namespace kaustik::pbrt
