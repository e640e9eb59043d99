#include "apps/import/pbrt/tokenizer.h"

#include <fmt/format.h>

namespace kaustik::pbrt {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
}
bool is_control(char c) {
  return !is_blank(c) && (static_cast<unsigned char>(c) < 0x20u || c == 0x7f);
}
bool ends_bare(char c) {
  return is_blank(c) || is_control(c) || c == '"' || c == '[' || c == ']' || c == '#';
}
bool starts_number(char c) {
  return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
}

}  // namespace

Tokenizer::Tokenizer(uint32_t file, std::string_view text, DiagnosticList& diagnostics)
    : file_(file), text_(text), diagnostics_(diagnostics) {
  if (text_.starts_with("\xef\xbb\xbf")) position_ = line_start_ = 3;  // byte order mark
}

SourceLocation Tokenizer::here() const {
  return {file_, line_, static_cast<uint32_t>(position_ - line_start_ + 1)};
}

Token Tokenizer::next() {
  if (!has_peeked_) return read();
  has_peeked_ = false;
  return peeked_;
}

const Token& Tokenizer::peek() {
  if (!has_peeked_) {
    peeked_ = read();
    has_peeked_ = true;
  }
  return peeked_;
}

void Tokenizer::skip_blanks() {
  for (; position_ < text_.size(); ++position_) {
    const char c = text_[position_];
    if (c == '#') {
      while (position_ < text_.size() && text_[position_] != '\n') ++position_;
      if (position_ == text_.size()) return;
    } else if (!is_blank(c)) {
      return;
    }
    if (text_[position_] == '\n') {
      ++line_;
      line_start_ = position_ + 1;
    }
  }
}

Token Tokenizer::read() {
  skip_blanks();
  while (position_ < text_.size() && is_control(text_[position_])) {
    const SourceLocation where = here();
    const auto code = static_cast<unsigned>(static_cast<unsigned char>(text_[position_]));
    while (position_ < text_.size() && is_control(text_[position_])) ++position_;
    diagnostics_.error(where, fmt::format("unexpected character 0x{:02x}: a scene is plain text", code));
    skip_blanks();
  }
  if (position_ == text_.size()) return {TokenKind::kEnd, {}, here()};
  const char c = text_[position_];
  if (c == '"') return read_string();
  if (c == '[' || c == ']') {
    const Token token{c == '[' ? TokenKind::kOpen : TokenKind::kClose, text_.substr(position_, 1), here()};
    ++position_;
    return token;
  }
  return read_bare();
}

Token Tokenizer::read_string() {
  const SourceLocation where = here();
  const size_t begin = ++position_;
  while (position_ < text_.size() && text_[position_] != '"' && text_[position_] != '\n') {
    const bool escape =
        text_[position_] == '\\' && position_ + 1 < text_.size() && text_[position_ + 1] != '\n';
    position_ += escape ? 2 : 1;
  }
  const Token token{TokenKind::kString, text_.substr(begin, position_ - begin), where};
  if (position_ < text_.size() && text_[position_] == '"') {
    ++position_;
  } else {
    diagnostics_.error(where, "this string is not closed on its line");
  }
  return token;
}

Token Tokenizer::read_bare() {
  const SourceLocation where = here();
  const size_t begin = position_;
  while (position_ < text_.size() && !ends_bare(text_[position_])) ++position_;
  const std::string_view text = text_.substr(begin, position_ - begin);
  return {starts_number(text[0]) ? TokenKind::kNumber : TokenKind::kWord, text, where};
}

std::string unescape(std::string_view text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 1 == text.size()) {
      out += text[i];
      continue;
    }
    switch (text[++i]) {
      case 'b':
        out += '\b';
        break;
      case 'f':
        out += '\f';
        break;
      case 'n':
        out += '\n';
        break;
      case 'r':
        out += '\r';
        break;
      case 't':
        out += '\t';
        break;
      default:
        out += text[i];
    }
  }
  return out;
}

}  // namespace kaustik::pbrt
