#include "apps/import/pbrt/parameter_parser.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/diagnostics/nearest_name.h"
#include "core/spectrum/colour_space.h"
#include "core/text.h"

namespace kaustik::pbrt {
namespace {

constexpr std::array kTypes = {ParameterType::kFloat,  ParameterType::kInteger,  ParameterType::kBool,
                               ParameterType::kString, ParameterType::kPoint2,   ParameterType::kVector2,
                               ParameterType::kPoint3, ParameterType::kVector3,  ParameterType::kNormal,
                               ParameterType::kRgb,    ParameterType::kSpectrum, ParameterType::kBlackbody,
                               ParameterType::kTexture};
constexpr size_t kMostParameters = 1000;  // of a directive: duplicates are found in quadratic time
// 2^53: integers are stored in doubles.
constexpr double kLargestInteger = 9007199254740992.0;

std::string in_quotes(const Token& token) {
  if (token.is(TokenKind::kEnd)) return "the end of the file";
  if (token.is(TokenKind::kString)) return fmt::format("\"{}\"", token.text.substr(0, 60));
  return fmt::format("`{}`", token.text.substr(0, 60));
}

bool is_bool_word(const Token& token) {
  return token.text == "true" || token.text == "false";
}

bool is_value(const Token& token) {
  return token.is(TokenKind::kString) || token.is(TokenKind::kNumber) ||
         (token.is(TokenKind::kWord) && is_bool_word(token));
}

// Programs print these for numbers that are not finite.
bool is_nan_or_infinity(const Token& token) {
  const size_t sign = token.text.starts_with('-') || token.text.starts_with('+') ? 1 : 0;
  if (token.text.size() <= sign || std::string_view("nNiI").find(token.text[sign]) == std::string_view::npos)
    return false;
  const std::string word = lower_case(token.text.substr(sign));
  return word == "nan" || word == "inf" || word == "infinity" || word.starts_with("nan(");
}

bool is_hole_of_mesh(const Token& token, const Parameter& p) {
  return p.may_have_holes() && is_nan_or_infinity(token);
}

std::string_view wanted(ParameterType type) {
  switch (type) {
    case ParameterType::kString:
      return "a string in quotes";
    case ParameterType::kTexture:
      return "a texture's name in quotes";
    case ParameterType::kBool:
      return "true or false";
    case ParameterType::kInteger:
      return "an integer";
    case ParameterType::kSpectrum:
      return "a number or a string in quotes";
    default:
      return "a number";
  }
}

void expected(const Token& token, std::string_view what, DiagnosticList& diagnostics) {
  diagnostics.error(token.location, fmt::format("expected {}, not {}", what, in_quotes(token)));
}

bool add_number(const Token& token, Parameter& p, DiagnosticList& diagnostics) {
  const auto value = parse_number(token, diagnostics);
  if (!value) return false;
  if (p.type == ParameterType::kInteger && *value != std::floor(*value)) {
    diagnostics.warning(token.location,
                        fmt::format("{} is rounded: `{}` is an integer", in_quotes(token), p.name));
    p.numbers.push_back(std::round(*value));
    return true;
  }
  if (p.type == ParameterType::kInteger && std::abs(*value) > kLargestInteger) {
    diagnostics.error(token.location, fmt::format("{} is too large for an integer", in_quotes(token)));
    return false;
  }
  p.numbers.push_back(*value);
  return true;
}

bool add_value(const Token& token, Parameter& p, DiagnosticList& diagnostics) {
  const bool text = token.is(TokenKind::kString);
  p.value_places.push_back({token.location.line, token.location.column});
  if (!text && is_hole_of_mesh(token, p)) {
    p.numbers.push_back(std::numeric_limits<double>::quiet_NaN());
    return true;
  }
  switch (p.type) {
    case ParameterType::kString:
    case ParameterType::kTexture:
      if (!text) break;
      p.strings.push_back(unescape(token.text));
      return true;
    case ParameterType::kBool:
      if (!is_bool_word(token) && token.text != "0" && token.text != "1") break;
      p.numbers.push_back(token.text == "true" || token.text == "1" ? 1 : 0);
      return true;
    case ParameterType::kSpectrum:
      if (text && p.numbers.empty()) {
        p.strings.push_back(unescape(token.text));
        return true;
      }
      if (!token.is(TokenKind::kNumber) || !p.strings.empty()) break;
      return add_number(token, p, diagnostics);
    default:
      if (token.is(TokenKind::kNumber)) return add_number(token, p, diagnostics);
  }
  expected(token, wanted(p.type), diagnostics);
  return false;
}

// Tells whether a number that does not fit into a double is too small (and counts as zero) rather than too
// large.
bool is_tiny(std::string_view text) {
  const size_t exponent = text.find_first_of("eE");
  if (exponent != text.npos) return text.find('-', exponent) != text.npos;
  return text.find_first_of("123456789") > text.find('.');
}

// Tells whether a word in a list is no directive, all of which begin with a capital letter. A directive means
// that the list was not closed.
bool is_stray_word(const Token& token) {
  if (!token.is(TokenKind::kWord)) return false;
  const bool capital = token.text[0] >= 'A' && token.text[0] <= 'Z';
  return !capital || is_nan_or_infinity(token);
}

// Skips the rest of a list after a bad value, so that it causes no further errors.
void skip_list(Tokenizer& tokens) {
  while (is_value(tokens.peek()) || is_stray_word(tokens.peek())) tokens.next();
  if (tokens.peek().is(TokenKind::kClose)) tokens.next();
}

// Tells whether this is pbrt-v3's type `xyz`, as in "xyz L".
bool is_xyz(const Token& declaration) {
  constexpr std::string_view kBlanks = " \t";
  const size_t begin = declaration.text.find_first_not_of(kBlanks);
  const size_t end = declaration.text.find_first_of(kBlanks, begin);
  return begin != end && declaration.text.substr(begin, end - begin) == "xyz";
}

void to_rgb(Parameter& p) {
  for (size_t i = 0; i + 2 < p.numbers.size(); i += 3) {
    const glm::dvec3 c = xyz_to_ours() * glm::dvec3(p.numbers[i], p.numbers[i + 1], p.numbers[i + 2]);
    for (int k = 0; k < 3; ++k) p.numbers[i + static_cast<size_t>(k)] = std::max(0.0, c[k]);
  }
}

// Splits "type name" into the parameter's type and name. False, with an error, when it is malformed.
bool parse_declaration(const Token& token, Parameter& p, DiagnosticList& diagnostics) {
  constexpr std::string_view kBlanks = " \t";
  const std::string_view text = token.text;
  const size_t type_begin = text.find_first_not_of(kBlanks);
  const size_t type_end = text.find_first_of(kBlanks, type_begin);
  const size_t name_begin = text.find_first_not_of(kBlanks, type_end);
  if (type_begin == text.npos || name_begin == text.npos) {
    expected(token, "a parameter \"type name\"", diagnostics);
    return false;
  }
  const size_t name_end = text.find_first_of(kBlanks, name_begin);
  p.name = std::string(text.substr(name_begin, name_end == text.npos ? text.npos : name_end - name_begin));
  p.location = token.location;
  const std::string_view word = text.substr(type_begin, type_end - type_begin);
  if (const auto type = parameter_type(word)) {
    p.type = *type;
    return true;
  }
  std::vector<std::string_view> names;
  for (const ParameterType type : kTypes) names.push_back(parameter_type_name(type));
  diagnostics.error(token.location,
                    fmt::format("unknown parameter type `{}`{}", word.substr(0, 60), name_hint(word, names)));
  return false;
}

}  // namespace

std::optional<ParameterType> parameter_type(std::string_view word) {
  // pbrt-v3's names of types.
  if (word == "color" || word == "xyz") return ParameterType::kRgb;
  if (word == "point") return ParameterType::kPoint3;
  if (word == "vector") return ParameterType::kVector3;
  for (const ParameterType type : kTypes) {
    if (parameter_type_name(type) == word) return type;
  }
  return std::nullopt;
}

std::optional<double> parse_number(const Token& token, DiagnosticList& diagnostics) {
  if (!token.is(TokenKind::kNumber)) {
    expected(token, "a number", diagnostics);
    return std::nullopt;
  }
  std::string_view text = token.text;
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status == std::errc::invalid_argument || end != text.data() + text.size() || std::isnan(value)) {
    expected(token, "a number", diagnostics);
    return std::nullopt;
  }
  if (status == std::errc::result_out_of_range && is_tiny(text)) return 0.0;
  if (status == std::errc::result_out_of_range || std::abs(value) > std::numeric_limits<float>::max()) {
    diagnostics.error(token.location, fmt::format("{} is beyond the range of floats", in_quotes(token)));
    return std::nullopt;
  }
  return value;
}

std::optional<std::vector<PlacedNumber>> read_numbers(uint32_t file, const SourceLocation& where,
                                                      Diagnostics& diagnostics) {
  DiagnosticList unsaid;
  Tokenizer tokens(file, diagnostics.files.text(file), unsaid);
  std::vector<PlacedNumber> numbers;
  for (Token token = tokens.next(); !token.is(TokenKind::kEnd); token = tokens.next()) {
    const auto value = parse_number(token, unsaid);
    if (value && !unsaid.has_errors()) {
      numbers.push_back({*value, token.location});
      continue;
    }
    diagnostics.error(where,
                      fmt::format("cannot read \"{}\": expected a number in line {}, column {}",
                                  diagnostics.files.name(file), token.location.line, token.location.column));
    return std::nullopt;
  }
  return numbers;
}

std::optional<std::vector<double>> parse_numbers(Tokenizer& tokens, size_t count, std::string_view what,
                                                 DiagnosticList& diagnostics) {
  const bool brackets = tokens.peek().is(TokenKind::kOpen);
  if (brackets) tokens.next();
  std::vector<double> out;
  while (out.size() < count) {
    if (!tokens.peek().is(TokenKind::kNumber)) {
      diagnostics.error(tokens.peek().location,
                        fmt::format("`{}` takes {} numbers: expected number {}, not {}", what, count,
                                    out.size() + 1, in_quotes(tokens.peek())));
      return std::nullopt;
    }
    const auto value = parse_number(tokens.next(), diagnostics);
    if (!value) return std::nullopt;
    out.push_back(*value);
  }
  if (!brackets) return out;
  if (tokens.peek().is(TokenKind::kClose)) {
    tokens.next();
    return out;
  }
  expected(tokens.peek(), "`]`", diagnostics);
  return std::nullopt;
}

bool parse_values(Tokenizer& tokens, Parameter& p, DiagnosticList& diagnostics) {
  if (!tokens.peek().is(TokenKind::kOpen)) {
    if (is_value(tokens.peek())) return add_value(tokens.next(), p, diagnostics);
    expected(tokens.peek(), fmt::format("{} for `{}`", wanted(p.type), p.name), diagnostics);
    return false;
  }
  const SourceLocation open = tokens.next().location;
  while (is_value(tokens.peek()) || is_hole_of_mesh(tokens.peek(), p)) {
    if (!add_value(tokens.next(), p, diagnostics)) {
      skip_list(tokens);
      return false;
    }
  }
  if (tokens.peek().is(TokenKind::kClose)) {
    tokens.next();
    return true;
  }
  diagnostics.error(tokens.peek().location,
                    fmt::format("expected a value or `]`, not {}", in_quotes(tokens.peek())),
                    {{open, "the list begins here"}});
  if (is_stray_word(tokens.peek())) skip_list(tokens);
  return false;
}

ParsedParameters parse_parameters(Tokenizer& tokens, DiagnosticList& diagnostics) {
  ParsedParameters out;
  bool too_many = false;
  while (tokens.peek().is(TokenKind::kString)) {
    Parameter p;
    const bool xyz = is_xyz(tokens.peek());
    if (!parse_declaration(tokens.next(), p, diagnostics)) {
      if (tokens.peek().is(TokenKind::kOpen)) tokens.next();
      skip_list(tokens);
      out.incomplete = true;
      continue;
    }
    if (out.parameters.size() == kMostParameters) {
      if (!too_many) diagnostics.error(p.location, fmt::format("more than {} parameters", kMostParameters));
      too_many = true;
    }
    if (!parse_values(tokens, p, diagnostics) || too_many) {
      out.incomplete = true;
      continue;
    }
    if (xyz) to_rgb(p);
    out.parameters.push_back(std::move(p));
  }
  return out;
}

}  // namespace kaustik::pbrt
