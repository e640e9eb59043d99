#pragma once
// Formats a benchmark's result as text tables.

#include "apps/bench/bench_result.h"

namespace kaustik::app {

// One table per photon count, with a column for each number of threads, a row "median (min..max)" for each
// quantity, and the exact counts below. Rows without values are omitted.
std::string bench_table(const BenchResult& result);

// One line that describes the machine: "AMD EPYC 7B13, AVX2, 16 usable cores".
std::string machine_line(const BenchResult& result);

}  // namespace kaustik::app
