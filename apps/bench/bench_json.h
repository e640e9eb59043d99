#pragma once
// A benchmark's result as the JSON file of `kaustik bench`. docs/cli.md explains its fields.

#include "apps/bench/bench_result.h"

namespace kaustik::app {

// UTF-8, indented, ends in a newline. Speed-ups and efficiencies are written for other readers: they follow
// from the seconds.
std::string bench_json(const BenchResult& result);

// The inverse. Throws std::runtime_error saying what is wrong when the text is not such a file.
BenchResult bench_from_json(const std::string& text);

}  // namespace kaustik::app
