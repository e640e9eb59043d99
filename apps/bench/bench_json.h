#pragma once
// Writes and reads a benchmark's result as the JSON file of `kaustik bench`. docs/reference/command_line.md
// explains its fields.

#include "apps/bench/bench_result.h"

namespace kaustik::app {

// Replaces bytes that are not UTF-8: paths may hold such bytes, but JSON, SVG and HTML may not.
std::string utf8(const std::string& text);

// The value of a JSON text. Throws std::runtime_error if the text is not valid JSON, or nested deeper than
// any file of ours: values are copied, compared and written by functions that call themselves for each level,
// so that a deep one would take the whole stack.
Json parse_json(const std::string& text);

// Converts a spread to JSON, and reads the member `key` of an object back. Throws std::runtime_error when it
// is not a valid spread.
Json spread_json(const Spread& spread);
Spread read_spread(const Json& object, std::string_view key);

// The result as UTF-8 JSON. Speed-ups and efficiencies are included for other readers; bench_from_json
// computes them anew.
std::string bench_json(const BenchResult& result);

// The inverse of bench_json. Throws std::runtime_error, which names the problem, when the text is not such a
// file.
BenchResult bench_from_json(const std::string& text);

}  // namespace kaustik::app
