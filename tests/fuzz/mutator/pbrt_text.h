#pragma once
// A pbrt text as directives and parameters, which a mutator changes as such. Any text can be taken apart:
// what belongs nowhere becomes an argument of the directive before it.

#include <string>
#include <string_view>
#include <vector>

namespace kaustik::fuzz {

struct PbrtParameter {
  std::string declaration;          // "type name", without the quotes
  std::vector<std::string> values;  // as written, strings with their quotes
};

struct PbrtDirective {
  std::string word;
  std::vector<std::string> arguments;  // as written: quoted types and names, numbers, brackets
  std::vector<PbrtParameter> parameters;
};

using PbrtText = std::vector<PbrtDirective>;

// Comments are lost.
PbrtText take_apart(std::string_view text);

std::string put_together(const PbrtText& directives);

}  // namespace kaustik::fuzz
