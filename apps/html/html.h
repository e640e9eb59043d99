#pragma once
// Escapes texts for HTML pages and fills page templates.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kaustik::app {

// Escapes & < > " ' as entities, for element content and quoted attributes.
std::string html_escaped(std::string_view text);

// Makes JSON safe inside a script element: writes < > & U+2028 and U+2029 as \u escapes. The JSON's value
// stays the same, and it cannot end the element.
std::string script_json(std::string_view json);

// Replaces each {{name}} of the template by its value; values are not searched again. Throws std::logic_error
// for a name without a value.
std::string filled(std::string_view page,
                   const std::vector<std::pair<std::string_view, std::string>>& values);

}  // namespace kaustik::app
