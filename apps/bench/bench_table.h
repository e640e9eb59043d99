#pragma once
// A benchmark's result for a terminal.

#include "apps/bench/bench_result.h"

namespace kaustik::app {

// Per photon count a column for each number of threads and a row for each quantity, "median (min..max)";
// below them the exact counts. Rows of what did not happen are left out. Ends in a newline.
std::string bench_table(const BenchResult& result);

// One line on the machine: "AMD EPYC 7B13, AVX2, 16 usable cores".
std::string machine_line(const BenchResult& result);

}  // namespace kaustik::app
