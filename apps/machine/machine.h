#pragma once
// The machine that a benchmark ran on, for whoever compares two of them.

#include "apps/bench/bench_result.h"

namespace kaustik::app {

// cpu, architecture, isa (Highway's best target here: what the SIMD loops use), caches of the first core,
// cores (hardware, affinity, cgroup_quota, usable), memory_bytes, system, compiler, libraries. What the
// system does not tell is null or left out.
Json machine_json();

}  // namespace kaustik::app
