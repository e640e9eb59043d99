#pragma once
// Compares a benchmark with an earlier one of the same work.

#include <string>

#include "apps/bench/bench_result.h"

namespace kaustik::app {

// Ratios of the times of the points that both results have, as a table. Throws std::runtime_error if they
// measured different work: other settings, or no point in common.
std::string baseline_table(const BenchResult& now, const BenchResult& before);

// The first point whose total takes more than `most` times as long as before, in words; empty if there is
// none. A difference counts only if all runs of now took longer than all runs of before.
std::string slow_down(const BenchResult& now, const BenchResult& before, double most);

}  // namespace kaustik::app
