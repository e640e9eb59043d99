#pragma once
// Parses numbers and typed parameter lists such as "rgb L" [ 17 12 4 ].

#include <optional>
#include <vector>

#include "apps/import/pbrt/tokenizer.h"
#include "core/scene/description/description.h"

namespace kaustik::pbrt {

// The value of a number token; nothing, with an error, when it is not a number or outside the range of a
// float.
std::optional<double> parse_number(const Token& token, DiagnosticList& diagnostics);

// A number of a file that holds nothing else, and its place there.
struct PlacedNumber {
  double value = 0;
  SourceLocation where;
};

// Reads a file of numbers alone; nothing, with an error, when it holds anything else. `where`: what names the
// file. The error points there and quotes nothing, since the file may be of any kind.
std::optional<std::vector<PlacedNumber>> read_numbers(uint32_t file, const SourceLocation& where,
                                                      Diagnostics& diagnostics);

// Reads exactly `count` numbers, with or without brackets; nothing, with an error, when there are fewer.
// `what`: the directive, for the message.
std::optional<std::vector<double>> parse_numbers(Tokenizer& tokens, size_t count, std::string_view what,
                                                 DiagnosticList& diagnostics);

// Reads the values after a declaration, one value or a bracketed list, into `parameter`. False after an
// error; the next token is then the first after the list.
bool parse_values(Tokenizer& tokens, Parameter& parameter, DiagnosticList& diagnostics);

struct ParsedParameters {
  std::vector<Parameter> parameters;
  bool incomplete = false;  // invalid ones were left out
};

// Reads all parameters up to the next directive. Invalid ones are reported and left out.
ParsedParameters parse_parameters(Tokenizer& tokens, DiagnosticList& diagnostics);

std::optional<ParameterType> parameter_type(std::string_view word);

}  // namespace kaustik::pbrt
