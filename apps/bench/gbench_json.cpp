#include "apps/bench/gbench_json.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <filesystem>

namespace kaustik::app {

namespace {

Json context(const BenchResult& result) {
  const Json cores = result.machine.value("cores", Json::object());
  return {{"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))},
          {"executable", "kaustik"},
          {"num_cpus", cores.value("usable", Json(nullptr))},
          {"cpu", result.machine.value("cpu", Json(nullptr))},
          {"kaustik_version", result.version},
          {"kaustik_build", result.build},
          {"library_build_type", "release"}};
}

}  // namespace

std::string gbench_json(const BenchResult& result) {
  const std::string scene = std::filesystem::path(result.scene).filename().string();
  Json benchmarks = Json::array();
  for (const BenchPoint& point : result.points)
    for (size_t i = 0; i < kPhases; ++i) {
      const std::string run =
          fmt::format("{}/photons:{}/threads:{}/{}", scene, point.photons, point.threads, kPhaseNames[i]);
      const double seconds = point.seconds[i].median;
      benchmarks.push_back({{"name", run + "_median"},
                            {"run_name", run},
                            {"run_type", "aggregate"},
                            {"aggregate_name", "median"},
                            {"aggregate_unit", "time"},
                            {"repetitions", result.repeat},
                            {"threads", point.threads},
                            {"iterations", result.repeat},
                            {"real_time", 1e3 * seconds},
                            {"cpu_time", 1e3 * seconds * point.busy_cores.median},
                            {"time_unit", "ms"}});
    }
  return Json{{"context", context(result)}, {"benchmarks", std::move(benchmarks)}}.dump(2) + "\n";
}

}  // namespace kaustik::app
