#include "apps/session/files/memory_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "accel/bvh_memory.h"
#include "apps/machine/launched.h"
#include "apps/machine/peak_memory.h"
#include "apps/machine/thread_limit.h"
#include "apps/machine/usable_cores.h"
#include "core/memory/memory_room.h"
#include "render/camera/pixel_range.h"
#include "render/passes/memory_forecast.h"

namespace kaustik::app {

namespace {

// Measured: what Embree and oneTBB hold before they have anything to do. Where OpenImageIO is needed, it is
// part of what the process holds: it is loaded for textures, and when the names of output files are checked.
constexpr uint64_t kLibraries = 12u << 20;
constexpr const char* kOption = "--memory";
// Buffers of samples and photons.
constexpr uint64_t kThread = 1u << 19;
// Ranks keep the sums of all passes, those of the present one, and those that are sent or received.
constexpr uint64_t kSumsOfRank = 5;

// A part in words, and what makes it smaller.
struct PartInWords {
  uint64_t bytes;
  std::string part, remedy;
};

PartInWords largest_part(const MemoryPlan& plan, bool in_passes) {
  const std::array parts = {
      PartInWords{plan.scene, "the program and the scene as it was read", ""},
      PartInWords{plan.bvh + plan.surfaces, "the BVH and the edges of its primitives", ""},
      PartInWords{plan.film_and_sums(in_passes),
                  fmt::format("the film, whose picture has {} x {} pixels", plan.width, plan.height),
                  ": render a smaller picture, or parts of it by --crop"},
      PartInWords{plan.libraries, "libraries and the buffers of threads", ": --threads makes it less"}};
  return *std::max_element(parts.begin(), parts.end(),
                           [](const auto& a, const auto& b) { return a.bytes < b.bytes; });
}

}  // namespace

MemoryLimit memory_limit(const render::RenderSettings& settings) {
  return settings.memory > 0 ? MemoryLimit{settings.memory, kOption} : usable_memory();
}

uint64_t MemoryPlan::total(bool in_passes) const {
  return scene + bvh + surfaces + film_and_sums(in_passes) + libraries;
}

MemoryPlan plan_memory(const Scene& scene, const SideEstimate& sides, const render::RenderSettings& settings,
                       bool may_denoise) {
  const int cores = core_limits().usable();
  const int threads = settings.threads > 0 ? std::min(settings.threads, most_useful_threads(cores)) : cores;
  MemoryPlan plan{.sides = sides,
                  .limit = memory_limit(settings),
                  .scene = held_memory() + (scene.textures ? scene.textures->bytes_to_come() : 0),
                  .bvh = accel::forecast_bytes(scene, sides),
                  .surfaces = render::surfaces_bytes(scene, sides, settings),
                  .width = scene.camera.width,
                  .height = scene.camera.height,
                  .libraries = kLibraries + uint64_t(threads) * kThread};
  forecast_film(scene, settings, may_denoise, &plan);
  return plan;
}

void forecast_film(const Scene& scene, const render::RenderSettings& settings, bool may_denoise,
                   MemoryPlan* plan) {
  render::RenderSettings decided = settings;
  decided.denoise = settings.denoise.value_or(may_denoise);
  const uint64_t pixels = render::rendered_range(settings.crop, scene.camera).pixels();
  const uint64_t copies = launched().ranks > 1 ? kSumsOfRank : 1;
  plan->film = pixels * render::film_bytes_per_pixel(decided, scene.needs);
  plan->sums = pixels * copies * render::sums_bytes_per_pixel(decided, scene.needs);
}

void set_photon_memory(const MemoryPlan& plan, bool in_passes, render::RenderSettings* settings) {
  settings->photon_memory = plan.limit.bytes - std::min(plan.limit.bytes, plan.total(in_passes));
  settings->sums_memory = in_passes ? 0 : plan.sums;
}

void check_memory(const MemoryPlan& plan, bool in_passes) {
  const uint64_t total = plan.total(in_passes);
  if (total <= plan.limit.bytes) return;
  const PartInWords largest = largest_part(plan, in_passes);
  throw std::runtime_error(
      fmt::format("not enough memory: the render needs about {} without photons, but {} allows {}{}; the "
                  "largest part, {}, is for {}{}",
                  size_text(total), plan.limit.source, size_text(plan.limit.bytes),
                  plan.limit.source == kOption ? "" : " (--memory sets another limit)",
                  size_text(largest.bytes), largest.part, largest.remedy));
}

nlohmann::ordered_json memory_json(const MemoryPlan& plan, bool in_passes, uint64_t photons) {
  return {{"limit_bytes", plan.limit.bytes},
          {"limit_by", plan.limit.source},
          {"forecast_bytes",
           {{"scene", plan.scene},
            {"bvh", plan.bvh},
            {"surfaces", plan.surfaces},
            {"film", plan.film_and_sums(in_passes)},
            {"photons", photons},
            {"libraries", plan.libraries},
            {"total", plan.total(in_passes) + photons}}},
          {"peak_bytes", peak_held_memory()}};
}

}  // namespace kaustik::app
