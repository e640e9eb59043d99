#include "apps/session/rank_session.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>

#include "apps/command_line/values.h"
#include "apps/console/exit_error.h"
#include "apps/machine/launched.h"
#include "apps/machine/thread_limit.h"
#include "apps/machine/usable_cores.h"
#include "apps/session/files/partial_files.h"

namespace kaustik::app {

namespace {

// The share of a pass that is done. Photons and maps are taken for half of it.
double share_of(const render::Progress& progress) {
  const double phase = progress.total > 0 ? double(progress.done) / double(progress.total) : 0;
  return progress.phase == "render" ? 0.5 + 0.5 * phase : 0.5 * phase;
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "an unknown machine";
}

// Shows the passes of all ranks as if one process rendered them one after the other.
class JointProgress {
 public:
  JointProgress(const render::PassSet& missing, const render::PassSums& done,
                const render::ProgressCallback& show)
      : show_(show) {
    const bool open = missing.end() == render::kMostPasses;
    first_ = pass_ = open ? done.passes.count() : missing.end() - missing.count();
    passes_ = open ? 0 : missing.end();
  }

  // finished: passes, with the shares of those at work.
  bool update(double finished) {
    finished_ = std::max(finished_, finished);
    const double whole = std::floor(finished_);
    const uint64_t pass = first_ + uint64_t(whole);
    bool go_on = true;
    for (; pass_ < pass && go_on; ++pass_) go_on = show(1);
    return go_on && show(finished_ - whole);
  }

 private:
  bool show(double share) const {
    constexpr uint64_t kParts = 1000;
    return show_({.phase = "render",
                  .done = uint64_t(share * kParts),
                  .total = kParts,
                  .pass = passes_ > 0 ? std::min(pass_, passes_ - 1) : pass_,
                  .passes = passes_});
  }

  const render::ProgressCallback& show_;
  uint64_t first_ = 0, pass_ = 0, passes_ = 0;
  double finished_ = 0;
};

// The settings and radii with which every rank renders. The window of one pixel stands for the picture's,
// which each rank knows.
std::string begin_text(const Job& job, const render::PassSums& sums) {
  render::PassSums none;
  none.shares = sums.shares;
  none.radii = sums.radii;
  none.totals = render::FilmTotals(render::PixelWindow<render::PixelTotals>(1, 1), sums.totals.units());
  return render::manifest_text(manifest_of(job, {}, {}, none), none);
}

// The arguments of this process, each with a zero at its end.
std::string command_line() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Renders what rank 0 hands out.
void render_for_others(Worker& worker, const Job& job, const accel::Bvh& bvh, const render::PassSums& begun,
                       const std::function<bool()>& go_on) {
  const auto progress = [&](const render::Progress& p) {
    worker.share(share_of(p));
    return go_on() && !worker.over();
  };
  render::RenderTask task;
  task.done.radii = begun.radii;
  task.next_pass = [&] { return worker.next(go_on); };
  task.after_pass = [&](render::PassSums& sums) { return worker.deliver(sums); };
  render::render(job.scene, bvh, job.settings.render, progress, std::move(task));
}

// Gives a job the settings of rank 0, which must have read the same files.
void take_settings(const render::PartialManifest& manifest, const SettingOverrides& overrides, Job* job) {
  if (job->content_hash != manifest.scene_hash)
    refuse(fmt::format("the files of {} differ in content from those that rank 0 has read", job->path));
  overrides.apply(job->settings);
}

void serve(Worker& worker, const LoadQuietly& load, const SettingOverrides& given,
           const std::function<bool()>& go_on, const Console& quiet) {
  Job job;  // stays where it is: the BVH refers to its scene
  std::optional<accel::Bvh> bvh;
  if (load) {
    job = load(quiet);
    bvh.emplace(job.scene, job.settings.render.threads);
  }
  const std::optional<BeginText> begin = worker.begin(go_on);
  if (!begin) return;
  const render::PartialResult begun = render::manifest_from_text(begin->manifest).result;
  const render::PartialManifest& manifest = begun.manifest;
  if (begin->command_line != command_line())
    refuse("its command line is not that of rank 0, but all ranks share one render");
  check_program(manifest.build, manifest.isa, "rank 0", "their passes cannot be combined");
  SettingOverrides overrides = overrides_from(manifest.settings, "rank 0");
  overrides.append(given.of_machine());
  if (!load) job = load_job(manifest.scene_path, overrides, quiet);
  take_settings(manifest, overrides, &job);
  if (!bvh) bvh.emplace(job.scene, job.settings.render.threads);
  render_for_others(worker, job, *bvh, begun.sums, go_on);
}

}  // namespace

void add_rank_options(Command& command, double& timeout) {
  command.add_parsed(
      "--rank-timeout", "TIME",
      "Under mpirun: a rank that is silent for so long is lost, and others render its passes. Default: 30s",
      [&timeout](const std::string& text) {
        const std::optional<double> seconds = parse_duration(text);
        if (!seconds || *seconds <= 0)
          throw OptionError("--rank-timeout",
                            fmt::format("`{}`: expected a time with its unit, like 30s or 2m", text));
        timeout = *seconds;
      });
}

std::unique_ptr<Ranks> join_ranks(double timeout, const Console& console) {
  const Launched start = launched();
  if (start.ranks <= 1) return nullptr;
  auto ranks = std::make_unique<Ranks>(timeout);
  if (!ranks->leads()) return ranks;
  const CoreLimits cores = core_limits();
  if (2 * cores.affinity * start.on_machine <= cores.hardware)
    console.warning(
        fmt::format("the launcher binds each of {} ranks to {} of the machine's {} cores; `mpirun --map-by "
                    "numa --bind-to numa` gives a rank "
                    "all cores of a NUMA domain",
                    start.on_machine, cores.affinity, cores.hardware));
  return ranks;
}

void settle_rank_passes(const Console& console, Settings* settings) {
  render::RenderSettings& render = settings->render;
  if (render.passes > 0 || settings->stop.any()) return;
  render.passes = std::min({kRankPasses, uint64_t(render.spp), render.photons});
  console.note(fmt::format("--passes {}: what ranks share; more ranks need more passes", render.passes));
}

render::RenderResult render_on_ranks(Coordinator& coordinator, const Job& job, const accel::Bvh& bvh,
                                     const render::ProgressCallback& show, RankRules rules,
                                     render::RenderTask task, const Console& console) {
  const render::PassSet missing = task.passes.without(task.done.passes);
  JointProgress joint(missing, task.done, show);
  std::mutex showing;
  bool interrupted = false;
  const auto go_on = [&] {
    const std::lock_guard lock(showing);
    interrupted |= !joint.update(double(coordinator.added()) + coordinator.at_work());
    return !interrupted;
  };
  // Rules refer to what is here.
  const std::unique_ptr<Coordinator, void (*)(Coordinator*)> stopping(&coordinator,
                                                                      [](Coordinator* c) { c->stop(); });
  rules.after_pass = [&showing, after = std::move(task.after_pass)](render::PassSums& sums) {
    const std::lock_guard lock(showing);
    return !after || after(sums);
  };
  rules.warn = [&](const std::string& text) {
    const std::lock_guard lock(showing);
    console.warning(text);
  };
  rules.in_order = job.settings.stop.target_error.has_value();
  task.passes = missing;
  task.photons.reset();
  task.on_pixels = {};  // the picture that is followed is that of all ranks
  render::PassSums done = std::exchange(task.done, {});
  task.done.radii = done.radii;
  coordinator.start(missing, std::move(done), std::move(rules));
  task.next_pass = [&] { return coordinator.next(go_on); };
  task.begun = [&](const render::PassSums& sums) {
    coordinator.begin(command_line(), begin_text(job, sums));
  };
  task.after_pass = [&](render::PassSums& sums) { return coordinator.deliver(sums); };
  const auto progress = [&](const render::Progress& p) {
    coordinator.here(share_of(p));
    return go_on() && !coordinator.over();
  };
  render::RenderResult result =
      render::render(job.scene, bvh, job.settings.render, progress, std::move(task));
  result.sums = coordinator.end();
  result.cancelled = interrupted && !missing.without(result.sums.passes).empty();
  if (!result.sums.passes.empty()) render::show_passes(&result);
  return result;
}

int serve_passes(Ranks& ranks, const LoadQuietly& load, const SettingOverrides& given,
                 const InterruptGuard& interrupt, const Console& console) {
  Worker& worker = ranks.worker();
  const auto go_on = [&] { return !interrupt.requested(); };
  std::ostringstream said;
  const Console quiet{said, said, false, true, console.command};
  std::string why;
  try {
    with_thread_limit(given.alone().render.threads, quiet, [&] { serve(worker, load, given, go_on, quiet); });
    if (interrupt.requested()) why = "a signal has ended it";
  } catch (const std::bad_alloc&) {
    why = "out of memory";
  } catch (const std::exception& error) {
    why = said.str() + error.what();
  }
  if (!why.empty()) worker.fail(fmt::format("on {}: {}", host_name(), why));
  if (!worker.deserted()) return kDone;
  console.error(fmt::format("rank {} on {}: rank 0 has fallen silent", ranks.rank(), host_name()));
  return kFailed;
}

}  // namespace kaustik::app
