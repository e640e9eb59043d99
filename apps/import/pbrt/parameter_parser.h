#pragma once
// Numbers and typed parameter lists: "rgb L" [ 17 12 4 ].

#include <optional>
#include <vector>

#include "apps/import/pbrt/tokenizer.h"
#include "core/scene/description/description.h"

namespace kaustik::pbrt {

// The number that a token says; nothing, with an error added, when it is none or lies beyond the range of
// floats.
std::optional<double> parse_number(const Token& token, DiagnosticList& diagnostics);

// Exactly `count` numbers, in brackets or not. what: "LookAt".
std::optional<std::vector<double>> parse_numbers(Tokenizer& tokens, size_t count, std::string_view what,
                                                 DiagnosticList& diagnostics);

// The values that follow a declaration, one or a bracketed list, into the parameter. False after an error;
// then the next token is the first that is not a part of the list.
bool parse_values(Tokenizer& tokens, Parameter& parameter, DiagnosticList& diagnostics);

// All parameters up to the next directive. Those with errors are left out.
std::vector<Parameter> parse_parameters(Tokenizer& tokens, DiagnosticList& diagnostics);

std::optional<ParameterType> parameter_type(std::string_view word);

}  // namespace kaustik::pbrt
