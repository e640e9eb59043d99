#pragma once
// The result of a sweep.

#include <optional>
#include <string>
#include <vector>

#include "apps/bench/bench_result.h"
#include "apps/sweep/sweep_grid.h"
#include "render/compare/error_parts.h"
#include "render/maps/gather_radii.h"
#include "render/picture/tonemap.h"

namespace kaustik::app {

// The measurements of one point of the grid over all seeds.
struct SweepCell {
  SweepPoint point;
  std::string flags;                   // flags_of the point
  render::ErrorParts error;            // over the seeds
  std::vector<double> relmse_by_seed;  // relMSE of each image
  // relMSE of means over blocks, the mean over the seeds; see CompareResult
  std::array<double, render::kBlockSides.size()> relmse_of_blocks{};
  double flip = 0;                      // mean of FLIP over pixels and seeds
  std::array<Spread, kPhases> seconds;  // by Phase, over the seeds
  render::GatherRadii radii;            // r0 of each map with the first seed, metres; 0 = not gathered from
  std::string picture, error_map;       // of the first seed; file names in the sweep's folder

  double time() const { return seconds[static_cast<size_t>(Phase::kTotal)].median; }
  double r0() const { return std::max({radii.direct, radii.caustic, radii.indirect}); }  // metres
};

struct SweepReference {
  std::string source;           // the file's path, or how it was rendered
  std::optional<double> noise;  // its own noise in units of relMSE; unset for a file
  double seconds = 0;           // render time; 0 for a file
  uint64_t passes = 0;
  double mean = 0;      // mean radiance over pixels and channels, W/(m^2 sr)
  std::string picture;  // file name in the sweep's folder
  // Of all pictures of the sweep, so that they can be compared by eye.
  render::ToneSettings tone;
};

struct SweepResult {
  std::string scene, version, build;  // UTF-8
  Json machine = Json::object();
  Json settings = Json::object();  // settings common to all renders, as texts by option name
  int width = 0, height = 0, threads = 1;
  uint64_t seeds = 1;
  std::optional<float> mask_bright;
  SweepReference reference;
  std::vector<SweepCell> cells;  // in the grid's order
};

// Indices of the cells that no other cell beats in both error and time, by increasing time.
std::vector<size_t> pareto_front(const std::vector<SweepCell>& cells);

// The options to use for a target error.
struct Advice {
  double target = 0;           // relative error, sqrt(relMSE)
  std::optional<size_t> cell;  // the fastest cell that reaches it; nothing if no cell does
  size_t named = 0;            // the cell whose flags the text contains: `cell`, or else the best one
  std::string text;            // such as "For 5 % on this scene: --photons 1M --radius 0.5x, 0.85 s."
};

// Advice for relative errors of 20, 10, 5, 2 and 1 %, up to and including the first that no cell reaches. Of
// several targets with the same fastest cell only the smallest is listed.
std::vector<Advice> advice_of(const std::vector<SweepCell>& cells);

}  // namespace kaustik::app
