#pragma once
// What a sweep found, as a value: measured, kept in files, read back, written as CSV, JSON and a report.

#include <optional>
#include <string>
#include <vector>

#include "apps/bench/bench_result.h"
#include "apps/sweep/sweep_grid.h"
#include "render/passes/passes.h"
#include "render/picture/error_parts.h"

namespace kaustik::app {

// A point of the grid, rendered with every seed.
struct SweepCell {
  SweepPoint point;
  std::string flags;                    // flags_of the point
  render::ErrorParts error;             // over the seeds
  std::vector<double> relmse_by_seed;   // those of the single images
  std::array<Spread, kPhases> seconds;  // by Phase, over the seeds
  render::GatherRadii radii;            // r0 of each map with the first seed, metres; 0: not read
  std::string picture, error_map;       // of the first seed: file names in the sweep's folder

  double time() const { return seconds[static_cast<size_t>(Phase::kTotal)].median; }
  double r0() const { return std::max({radii.direct, radii.caustic, radii.indirect}); }  // metres
};

struct SweepReference {
  std::string source;           // the file's path, or how it was rendered
  std::optional<double> noise;  // its own, in units of relMSE; unset when it came from a file
  double seconds = 0;           // that it took; 0 for a file
  uint64_t passes = 0;
  double mean = 0;      // over pixels and channels, W/(m^2 sr)
  std::string picture;  // file name in the sweep's folder
};

struct SweepResult {
  std::string scene, version, build;  // UTF-8
  Json machine = Json::object();
  Json settings = Json::object();  // of all renders, by the names of their options, as texts
  int width = 0, height = 0, threads = 1;
  uint64_t seeds = 1;
  std::optional<float> mask_bright;
  SweepReference reference;
  std::vector<SweepCell> cells;  // in the grid's order
};

// Indices of the cells that no other beats in both error and time, by rising time.
std::vector<size_t> pareto_front(const std::vector<SweepCell>& cells);

// What to type for an error.
struct Advice {
  double target = 0;           // relative error, sqrt(relMSE)
  std::optional<size_t> cell;  // the cheapest that reaches it; none: the grid has no such cell
  size_t named = 0;            // the cell whose flags the text holds: that one, or the best there is
  std::string text;            // "For 5 % on this scene: --photons 1M --radius 0.5x, 0.85 s."
};

// For relative errors of 20, 10, 5, 2 and 1 %: those that a cell reaches, of several with the same cheapest
// cell only the smallest, and the first that none does.
std::vector<Advice> advice_of(const std::vector<SweepCell>& cells);

}  // namespace kaustik::app
