#pragma once
// What a render counted and measured, as JSON for `--stats` and as string attributes for image files.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "render/picture/image_io.h"
#include "render/renderer.h"

namespace kaustik::render {

// Seconds of the phases that the renderer does not see itself.
struct OuterTimes {
  // trials: what found the size that fills a given time.
  double load = 0, bvh = 0, trials = 0, write = 0, total = 0;
};

// Peak resident memory of this process in bytes (VmHWM of /proc/self/status); 0 where it cannot be read.
uint64_t peak_memory_bytes();

// Settings that decide what is computed, the plan's estimators among them. Of photons and samples, not of the
// picture's size.
nlohmann::ordered_json settings_json(const RenderSettings& settings, const EstimatorPlan& plan);

// Every count of a render: photons, rays, gathers, the lecture's fallbacks, dropped samples, sizes of the
// maps. Whole numbers only, the same in every run of the same program on any number of threads.
nlohmann::ordered_json counters_json(const RenderStatistics& statistics);

// The JSON text (UTF-8, indented, ends in a newline): version, seed, settings, plan, the counters, seconds
// per phase, peak memory, radii, the scene's needs and what was left out. 64-bit counts are exact.
std::string statistics_json(const RenderResult& result, const RenderSettings& settings,
                            const SceneNeeds& needs, const OuterTimes& times);

// Settings, version, seed and counts for write_film. Holds nothing that changes between equal renders, so
// that equal renders give equal files.
Metadata metadata_of(const RenderResult& result, const RenderSettings& settings);

}  // namespace kaustik::render
