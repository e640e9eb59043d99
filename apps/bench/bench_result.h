#pragma once
// What a benchmark found, as a value: measured, written to JSON, read back, printed and drawn.

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kaustik::app {

using Json = nlohmann::ordered_json;

// Of repeated measurements.
struct Spread {
  double median = 0, min = 0, max = 0;
};

// values: at least one. The median of an even number is the mean of the middle two.
Spread spread_of(std::vector<double> values);

// Wall-clock phases, by the names that --stats gives them.
enum class Phase { kBvh, kPhotonTrace, kPhotonBuild, kRender, kTotal };
inline constexpr std::array<std::string_view, 5> kPhaseNames = {"bvh", "photon_trace", "photon_build",
                                                                "render", "total"};
inline constexpr size_t kPhases = kPhaseNames.size();

// What is counted per second: the first three of photon tracing, the others of the image.
enum class Rate {
  kPhotons,
  kPhotonRays,
  kPhotonShadowRays,
  kCameraRays,
  kSpecularRays,
  kShadowRays,
  kBounceRays,
  kGatherQueries,
  kGatherCandidates
};
inline constexpr std::array<std::string_view, 9> kRateNames = {
    "photons",     "photon_rays", "photon_shadow_rays", "camera_rays",      "specular_rays",
    "shadow_rays", "bounce_rays", "gather_queries",     "gather_candidates"};
inline constexpr size_t kRates = kRateNames.size();

// One photon count on one number of threads.
struct BenchPoint {
  uint64_t photons = 1;
  int threads = 1;
  std::array<Spread, kPhases> seconds;    // by Phase; total is the sum of the others, run by run
  std::array<Spread, kRates> per_second;  // by Rate; 0 where the phase took no time
  Spread busy_cores;                      // CPU time of the process over the time of the run
  Spread peak_memory_bytes;               // resident, of the process
  Json counters = Json::object();         // exact, the same in every run of these photons

  const Spread& operator[](Phase phase) const { return seconds[static_cast<size_t>(phase)]; }
  const Spread& operator[](Rate rate) const { return per_second[static_cast<size_t>(rate)]; }
};

struct BenchResult {
  std::string scene, version, build;  // UTF-8
  Json machine = Json::object();      // see machine_json
  Json settings = Json::object();     // of the render, without photons and threads
  uint64_t repeat = 1;
  std::vector<BenchPoint> points;  // by photon count, then by threads, as the command line gave them
};

// The first point of the same photon count: what speed-ups are measured against.
const BenchPoint& baseline_of(const BenchResult& result, const BenchPoint& point);

// The baseline's median over this point's times. Nothing when the phase took no time in one of them.
std::optional<Spread> speed_up(const BenchResult& result, const BenchPoint& point, Phase phase);

// The speed-up per thread added: 1 is ideal.
std::optional<double> efficiency(const BenchResult& result, const BenchPoint& point, Phase phase);

}  // namespace kaustik::app
