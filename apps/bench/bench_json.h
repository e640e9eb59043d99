#pragma once
// A benchmark's result as the JSON file of `kaustik bench`. docs/cli.md explains its fields.

#include "apps/bench/bench_result.h"

namespace kaustik::app {

// A path need not be UTF-8; JSON, SVG and HTML are: what is not is replaced.
std::string utf8(const std::string& text);

// The spread by the names of its fields, and back. Throws std::runtime_error when it is none.
Json spread_json(const Spread& spread);
Spread read_spread(const Json& object, std::string_view key);

// UTF-8, indented, ends in a newline. Speed-ups and efficiencies are written for other readers: they follow
// from the seconds.
std::string bench_json(const BenchResult& result);

// The inverse. Throws std::runtime_error saying what is wrong when the text is not such a file.
BenchResult bench_from_json(const std::string& text);

}  // namespace kaustik::app
