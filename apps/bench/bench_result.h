#pragma once
// The result of a benchmark.

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/parallel/work_span.h"

namespace kaustik::app {

using Json = nlohmann::ordered_json;

// Median and range of repeated measurements.
struct Spread {
  double median = 0, min = 0, max = 0;
};

// The spread of at least one value. The median of an even number of values is the mean of the middle two.
Spread spread_of(std::vector<double> values);

// Phases of a render, with the names that --stats uses. Their times are wall-clock times.
enum class Phase { kBvh, kPhotonTrace, kPhotonBuild, kRender, kTotal };
inline constexpr std::array<std::string_view, 5> kPhaseNames = {"bvh", "photon_trace", "photon_build",
                                                                "render", "total"};
inline constexpr size_t kPhases = kPhaseNames.size();

// Counts per second. The first three are per second of photon tracing, the others per second of rendering.
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

// The measurements for one photon count and one number of threads.
struct BenchPoint {
  uint64_t photons = 1;
  int threads = 1;
  uint64_t photons_per_thread = 0;        // where photons grow with the threads (weak scaling), otherwise 0
  std::array<Spread, kPhases> seconds;    // by Phase; the total of each run is the sum of its other phases
  std::array<Spread, kRates> per_second;  // by Rate; 0 if the phase took no time
  Spread busy_cores;                      // CPU time of the process divided by the time of the run
  // Share of the threads' time in which they were ready, but other programs had the cores; and the energy of
  // all processors, in joules. Nothing where the system does not tell.
  std::optional<Spread> waiting, joules;
  Spread peak_memory_bytes;        // peak resident memory of the process
  Json counters = Json::object();  // exact counts, equal in all runs with this photon count

  const Spread& operator[](Phase phase) const { return seconds[static_cast<size_t>(phase)]; }
  const Spread& operator[](Rate rate) const { return per_second[static_cast<size_t>(rate)]; }
};

// How far the phases of a render can scale, by their names in --stats.
struct SpanPoint {
  uint64_t photons = 1;
  std::map<std::string, PhaseSpan> phases;
};

struct BenchResult {
  std::string scene, version, build;  // UTF-8
  Json machine = Json::object();      // see machine_json
  Json settings = Json::object();     // of the render, without photons and threads
  uint64_t repeat = 1;
  std::vector<BenchPoint> points;  // by photon count, then by threads, in the order of the command line
  std::vector<SpanPoint> spans{};  // by photon count, where they were asked for
};

// The first point with the same photon count, or with as many photons per thread; speed-ups are relative to
// it.
const BenchPoint& baseline_of(const BenchResult& result, const BenchPoint& point);

// The baseline's median time divided by this point's times, for as many photons. Nothing if the phase took no
// time in one of them.
std::optional<Spread> speed_up(const BenchResult& result, const BenchPoint& point, Phase phase);

// The share of the time of the first point's number of threads that does not become shorter with more of
// them, fitted to all points with its photon count: Amdahl's t = t1 (s + (1 - s) / n), least squares, 0 to 1.
// Nothing for fewer than two numbers of threads.
std::optional<double> fitted_serial_share(const BenchResult& result, const BenchPoint& first, Phase phase);

// Points where threads waited for cores longer than this share of the time tell more about the other programs
// than about this one.
inline constexpr double kMostWaiting = 0.05;
bool is_disturbed(const BenchResult& result);  // any point is

// The speed-up divided by the ratio of thread counts; 1 is ideal.
std::optional<double> efficiency(const BenchResult& result, const BenchPoint& point, Phase phase);

}  // namespace kaustik::app
