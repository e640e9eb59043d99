#pragma once
// Describes the machine that a benchmark ran on.

#include "apps/bench/bench_result.h"

namespace kaustik::app {

// Keys: cpu, architecture, isa (the Highway target that the SIMD loops use), caches of the first core, cores
// (hardware, affinity, cgroup_quota, usable), memory_bytes, system, compiler, libraries. Values that the
// system does not report are null or absent.
Json machine_json();

}  // namespace kaustik::app
