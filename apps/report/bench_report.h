#pragma once
// A benchmark as one HTML page that needs nothing else: no network, no other file.

#include <string>

#include "apps/bench/bench_result.h"

namespace kaustik::app {

// UTF-8. Charts of the speed-up for each photon count, of photons traced per second, and, for two photon
// counts and more, of the time over photons; then the table of bench_table(). Texts of the result are
// escaped.
std::string bench_report(const BenchResult& result);

}  // namespace kaustik::app
