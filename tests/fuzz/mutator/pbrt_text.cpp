#include "tests/fuzz/mutator/pbrt_text.h"

#include "apps/import/pbrt/tokenizer.h"
#include "core/diagnostics/diagnostics.h"

namespace kaustik::fuzz {

namespace {

using pbrt::Token;
using pbrt::TokenKind;

// "float radius", unlike "sphere": two words.
bool is_declaration(const Token& token) {
  if (!token.is(TokenKind::kString)) return false;
  const size_t blank = token.text.find(' ');
  return blank != token.text.npos && blank > 0 && blank + 1 < token.text.size();
}

bool is_directive(const Token& token) {
  return token.is(TokenKind::kWord) && token.text != "true" && token.text != "false";
}

std::string as_written(const Token& token) {
  switch (token.kind) {
    case TokenKind::kString:
      return '"' + std::string(token.text) + '"';
    case TokenKind::kOpen:
      return "[";
    case TokenKind::kClose:
      return "]";
    default:
      return std::string(token.text);
  }
}

}  // namespace

PbrtText take_apart(std::string_view text) {
  DiagnosticList ignored;
  pbrt::Tokenizer tokens(0, text, ignored);
  PbrtText out;
  for (Token token = tokens.next(); !token.is(TokenKind::kEnd); token = tokens.next()) {
    if (is_directive(token) || out.empty()) {
      out.push_back({as_written(token), {}, {}});
      continue;
    }
    PbrtDirective& last = out.back();
    if (is_declaration(token))
      last.parameters.push_back({std::string(token.text), {}});
    else if (last.parameters.empty())
      last.arguments.push_back(as_written(token));
    else if (!token.is(TokenKind::kOpen) && !token.is(TokenKind::kClose))
      last.parameters.back().values.push_back(as_written(token));
  }
  return out;
}

std::string put_together(const PbrtText& directives) {
  std::string out;
  for (const PbrtDirective& directive : directives) {
    out += directive.word;
    for (const std::string& argument : directive.arguments) out += ' ' + argument;
    for (const PbrtParameter& parameter : directive.parameters) {
      out += " \"" + parameter.declaration + "\" [";
      for (const std::string& value : parameter.values) out += ' ' + value;
      out += " ]";
    }
    out += '\n';
  }
  return out;
}

}  // namespace kaustik::fuzz
