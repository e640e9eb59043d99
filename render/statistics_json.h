#pragma once
// Statistics of a render as JSON, for `--stats`, and as string attributes of image files.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "render/picture/image_io.h"
#include "render/renderer.h"

namespace kaustik::render {

// Seconds of the phases outside the renderer.
struct OuterTimes {
  // trials: the search for the size of render that fills a given time.
  double load = 0, bvh = 0, trials = 0, denoise = 0, write = 0, total = 0;
};

// Peak resident memory of this process in bytes (VmHWM of /proc/self/status); 0 if it cannot be read.
uint64_t peak_memory_bytes();

// All counters of a render: photons, rays, gathers, the lecture's fallbacks, dropped samples, sizes of the
// maps. Integers only, equal in every run of the same program on any number of threads.
nlohmann::ordered_json counters_json(const RenderStatistics& statistics);

// What the scene needs, and what is left out.
nlohmann::ordered_json needs_json(const SceneNeeds& needs);

// The JSON text (UTF-8, indented, ends in a newline): version, seed, settings, plan, counters, seconds per
// phase, peak memory, radii, the scene's needs and what was left out. 64-bit counts are exact.
// shown: the settings to list, by name. memory: the forecast of memory, or null.
std::string statistics_json(const RenderResult& result, const RenderSettings& settings,
                            const nlohmann::ordered_json& shown, const SceneNeeds& needs,
                            const OuterTimes& times, const nlohmann::ordered_json& memory);

// Settings, version, seed and counts for write_film(). Contains nothing that differs between equal renders,
// so that equal renders give equal files.
Metadata metadata_of(const RenderResult& result, const RenderSettings& settings,
                     const nlohmann::ordered_json& shown);

}  // namespace kaustik::render
