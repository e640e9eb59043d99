#pragma once
// Texts made fit for places in an HTML page.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kaustik::app {

// For element content and quoted attributes: & < > " ' as entities.
std::string html_escaped(std::string_view text);

// JSON for the inside of a script element: < > & as \u escapes, which leave its value as it is and cannot end
// the element. U+2028 and U+2029 too.
std::string script_json(std::string_view json);

// RFC 4648, with padding.
std::string base64(std::string_view bytes);

// The template with each {{name}} replaced by its value, which is not looked at again. Throws
// std::logic_error for a name without a value.
std::string filled(std::string_view page,
                   const std::vector<std::pair<std::string_view, std::string>>& values);

}  // namespace kaustik::app
