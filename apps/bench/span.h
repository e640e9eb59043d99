#pragma once
// How far a render can scale, from a run in one thread: see core/parallel/work_span.h.

#include <functional>
#include <map>
#include <string>

#include "apps/bench/bench_result.h"
#include "apps/session/files/scene_loading.h"

namespace kaustik::app {

// Numbers of cores for which speed-ups are predicted.
inline constexpr std::array<int, 4> kSpanCores = {4, 16, 64, 256};

// Loads the scene and renders it in one thread. Nothing if go_on() returned false.
std::optional<SpanPoint> measure_span(const std::string& scene, const SettingOverrides& overrides,
                                      uint64_t photons, const Console& console,
                                      const std::function<bool()>& go_on);

// The whole of a render's phases but the BVH, whose loops are Embree's own.
PhaseSpan total_of(const SpanPoint& point);

std::string span_table(const SpanPoint& point);

}  // namespace kaustik::app
