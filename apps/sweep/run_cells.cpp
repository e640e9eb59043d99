#include "apps/sweep/run_cells.h"

#include <algorithm>

#include "apps/bench/measure.h"
#include "apps/session/files/partial_files.h"
#include "apps/session/render_job.h"
#include "apps/sweep/pictures.h"
#include "render/compare/error_parts.h"
#include "render/compare/flip.h"
#include "render/picture/image_io.h"

namespace kaustik::app {

namespace {

// The share of a render's work that is done. `work`: its photons and camera samples.
double fraction_of(const render::Progress& p, const SweepPoint& point, uint64_t work) {
  const double photons = double(point.photons) / double(work);
  const double phase = p.total > 0 ? double(p.done) / double(p.total) : 0;
  const double in_pass = p.phase == "photons" ? photons * phase
                         : p.phase == "build" ? photons
                                              : photons + (1 - photons) * phase;
  return (double(p.pass) + in_pass) / double(std::max<uint64_t>(p.passes, 1));
}

// Renders one point of the grid with all seeds.
class CellRun {
 public:
  CellRun(const SweepJob& sweep, const SweepPoint& point, const SweepFolder& folder)
      : sweep_(sweep),
        folder_(folder),
        settings_(settings_at(point, sweep.grid, sweep.job.settings, sweep.overrides)),
        errors_(sweep.reference.image, sweep.compare) {
    cell_.point = point;
    cell_.flags = flags_of(point, sweep.grid, sweep.overrides);
    key_ =
        folder.key({{"settings", setting_texts(settings_, [](const Setting& s) { return s.decides_sums; })},
                    {"seeds", sweep.grid.seeds},
                    {"reference", sweep.reference.hash}});
    cell_.picture = SweepFolder::picture_of(key_);
    cell_.error_map = SweepFolder::error_map_of(key_);
  }

  std::optional<SweepCell> find(const Console& console) const {
    std::optional<SweepCell> found = folder_.find(key_, console);
    if (!found) return std::nullopt;
    found->point = cell_.point;
    found->flags = cell_.flags;
    return found;
  }

  // Renders all seeds; false when cancelled. go_on(done) receives the work done so far, out of work() per
  // seed.
  bool render_all(const std::function<bool(uint64_t done)>& go_on) {
    for (uint64_t i = 0; i < sweep_.grid.seeds; ++i) {
      render::RenderSettings s = settings_.render;
      s.seed += i;
      const auto progress = [&](const render::Progress& p) {
        const double part = fraction_of(p, cell_.point, work());
        return go_on(i * work() + static_cast<uint64_t>(part * double(work())));
      };
      const RenderOutcome outcome = render_job(sweep_.job.scene, s, progress, {.keep_sums = false});
      if (outcome.result.cancelled) return false;
      add(outcome, i == 0);
      if (!go_on((i + 1) * work())) return false;
    }
    return true;
  }

  // The work of one seed: photons plus camera samples, which cost about the same.
  uint64_t work() const {
    const auto [width, height] = picture_size(sweep_.job);
    return cell_.point.photons + uint64_t(width) * uint64_t(height) * uint64_t(cell_.point.spp);
  }

  // Call after render_all. Computes the cell and stores it in the folder.
  SweepCell finish() {
    cell_.error = errors_.parts();
    for (size_t i = 0; i < kPhases; ++i) cell_.seconds[i] = spread_of(seconds_[i]);
    folder_.keep(key_, cell_);
    return cell_;
  }

 private:
  void add(const RenderOutcome& outcome, bool first) {
    const render::Image image = render::image_of(outcome.result.film);
    errors_.add(image);
    const render::CompareResult compared = render::compare(sweep_.reference.image, image, sweep_.compare);
    cell_.relmse_by_seed.push_back(compared.relmse);
    for (size_t i = 0; i < compared.relmse_of_blocks.size(); ++i)
      cell_.relmse_of_blocks[i] += compared.relmse_of_blocks[i] / double(sweep_.grid.seeds);
    const auto flip = sweep_.reference.image.for_display ? render::flip_of_display : render::flip_of_radiance;
    cell_.flip += flip(sweep_.reference.image, image, {}, sweep_.compare).mean / double(sweep_.grid.seeds);
    const auto seconds = phase_seconds(outcome);
    for (size_t i = 0; i < kPhases; ++i) seconds_[i].push_back(seconds[i]);
    if (!first) return;
    const render::RenderStatistics& s = outcome.result.statistics;
    cell_.radii = {s.direct_radius, s.caustic_radius, s.indirect_radius};
    write_picture(folder_.path(cell_.picture), image, sweep_.reference.about.tone);
    write_error_map(folder_.path(cell_.error_map), sweep_.reference.image, image);
  }

  const SweepJob& sweep_;
  const SweepFolder& folder_;
  Settings settings_;
  render::ErrorPartsSum errors_;
  std::array<std::vector<double>, kPhases> seconds_;
  SweepCell cell_;
  std::string key_;
};

}  // namespace

RunCells run_cells(const SweepJob& sweep, const std::vector<SweepPoint>& points, const SweepFolder& folder,
                   const SweepProgress& progress, const Console& console) {
  RunCells out;
  std::vector<std::optional<SweepCell>> cells;
  uint64_t total = 0, done = 0;
  for (const SweepPoint& point : points) {
    const CellRun run(sweep, point, folder);
    cells.push_back(run.find(console));
    out.reused += cells.back().has_value();
    if (!cells.back()) total += run.work() * sweep.grid.seeds;
  }
  for (size_t i = 0; i < points.size() && !out.cancelled; ++i) {
    if (cells[i]) continue;
    CellRun run(sweep, points[i], folder);
    out.cancelled = !run.render_all([&](uint64_t work) { return progress(done + work, total); });
    if (!out.cancelled) cells[i] = run.finish();
    done += run.work() * sweep.grid.seeds;
  }
  for (std::optional<SweepCell>& cell : cells)
    if (cell) out.cells.push_back(std::move(*cell));
  return out;
}

}  // namespace kaustik::app
