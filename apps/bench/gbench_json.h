#pragma once

#include <string>

#include "apps/bench/bench_result.h"

namespace kaustik::app {

// The result in the form of google-benchmark's JSON, which dashboards read: an aggregate of each phase of
// each point, medians. Its name is "SCENE/photons:N/threads:N/PHASE".
std::string gbench_json(const BenchResult& result);

}  // namespace kaustik::app
