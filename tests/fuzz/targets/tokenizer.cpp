// The tokenizer of pbrt's text format, which sees texts that the importer would refuse before.

#include "apps/import/pbrt/tokenizer.h"

#include "tests/fuzz/input_folder.h"

namespace kaustik::fuzz {

void fuzz_tokenizer(Bytes input) {
  Diagnostics diagnostics;
  const uint32_t file = diagnostics.files.add("scene.pbrt", std::string(as_text(input)));
  const std::string_view text = diagnostics.files.text(file);
  pbrt::Tokenizer tokens(file, text, diagnostics);
  size_t count = 0;
  for (pbrt::Token token = tokens.next(); !token.is(pbrt::TokenKind::kEnd); token = tokens.next()) {
    // Each token takes at least one byte.
    if (++count > text.size()) throw Violation("more tokens than bytes");
    if (token.is(pbrt::TokenKind::kString)) pbrt::unescape(token.text);
    if (tokens.peek().location.line < token.location.line) throw Violation("lines run backwards");
  }
  diagnostics.format_all();
}

}  // namespace kaustik::fuzz
