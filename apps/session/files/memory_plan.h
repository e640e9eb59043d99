#pragma once
// The memory of a render: its limit, a forecast of its parts, and what is left for photons.

#include <nlohmann/json_fwd.hpp>

#include "apps/machine/usable_memory.h"
#include "core/geometry/side_estimate.h"
#include "core/scene/scene.h"
#include "render/settings/settings.h"

namespace kaustik::app {

// Bytes of the parts of a render.
struct MemoryPlan {
  SideEstimate sides{};       // of the scene's shapes, from which follows what the BVH and surfaces take
  MemoryLimit limit{};        // of all parts; its source is "--memory" if that is given
  uint64_t scene = 0;         // what the process held when the plan was made, and MIP levels yet to come
  uint64_t bvh = 0;           // its build
  uint64_t surfaces = 0;      // what photons need to know of surfaces
  uint64_t film = 0;          // of a render in one pass
  int width = 0, height = 0;  // of the picture
  uint64_t sums = 0;          // the exact sums that renders of several passes keep besides
  uint64_t libraries = 0;     // that are loaded later, and the buffers of threads

  // Of all that is kept for each pixel.
  uint64_t film_and_sums(bool in_passes) const { return film + (in_passes ? sums : 0); }
  // Without photons.
  uint64_t total(bool in_passes) const;
};

// --memory, or what the system leaves.
MemoryLimit memory_limit(const render::RenderSettings& settings);

// The forecast for a scene that is read and whose BVH is not built. sides: of its shapes. may_denoise: see
// forecast_film().
MemoryPlan plan_memory(const Scene& scene, const SideEstimate& sides, const render::RenderSettings& settings,
                       bool may_denoise);

// Forecasts film and sums alone. may_denoise: whether the picture may be denoised although the settings do
// not say so yet.
void forecast_film(const Scene& scene, const render::RenderSettings& settings, bool may_denoise,
                   MemoryPlan* plan);

// Sets what the plan leaves to photons. in_passes: whether sums are kept even of one pass.
void set_photon_memory(const MemoryPlan& plan, bool in_passes, render::RenderSettings* settings);

// Throws std::runtime_error, which names the largest part, if the render cannot fit into the limit whatever
// the number of its photons. in_passes: whether it keeps sums.
void check_memory(const MemoryPlan& plan, bool in_passes);

// For `--stats`: the limit, the forecast of each part, and what the process has held at most. photons:
// render::photons_bytes(), or 0.
nlohmann::ordered_json memory_json(const MemoryPlan& plan, bool in_passes, uint64_t photons);

}  // namespace kaustik::app
