#pragma once
// Renders whose passes are shared by the ranks that an MPI launcher has started.

#include <functional>
#include <memory>
#include <optional>

#include "accel/bvh.h"
#include "apps/command_line/command.h"
#include "apps/ranks/ranks.h"
#include "apps/session/files/scene_loading.h"
#include "apps/session/interrupt.h"
#include "render/renderer.h"

namespace kaustik::app {

// Passes of a render that a launcher has started and whose settings name none. They do not depend on the
// number of ranks, so that neither do the bits.
inline constexpr uint64_t kRankPasses = 64;

// Adds --rank-timeout.
void add_rank_options(Command& command, double& timeout);

// Joins the other ranks; null if there are none. Warns if the launcher binds them to fewer than half of the
// cores.
std::unique_ptr<Ranks> join_ranks(double timeout, const Console& console);

// Sets the passes that ranks share, where neither the settings nor a rule decide.
void settle_rank_passes(const Console& console, Settings* settings);

// Rank 0: renders the passes of the task that are missing, at least one, on all ranks. task.passes must be
// set; radii count, but photons shot in advance do not. rules: those of the time, the others are set here.
// The sums have the bits of render() in one process, except for the seconds.
render::RenderResult render_on_ranks(Coordinator& coordinator, const Job& job, const accel::Bvh& bvh,
                                     const render::ProgressCallback& progress, RankRules rules,
                                     render::RenderTask task, const Console& console);

// The other ranks: render what rank 0 hands out until it ends the render. load: loads the scene as the
// command line says, quietly; if empty, the scene is loaded as rank 0 says. given: the settings of the
// command line, of which those of this machine count. Returns the exit code.
using LoadQuietly = std::function<Job(const Console&)>;
int serve_passes(Ranks& ranks, const LoadQuietly& load, const SettingOverrides& given,
                 const InterruptGuard& interrupt, const Console& console);

}  // namespace kaustik::app
