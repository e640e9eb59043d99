#pragma once
// What `render` and `resume` share: they render passes with a progress bar and checkpoints, and write files
// at the end or after a signal.

#include "apps/session/checkpoint.h"
#include "apps/session/interrupt.h"
#include "apps/session/kept_maps.h"
#include "apps/session/live_options.h"
#include "apps/session/rank_session.h"
#include "apps/session/render_outputs.h"
#include "apps/settings/setting_options.h"

namespace kaustik::app {

struct RenderSession {
  OutputOptions outputs;
  CheckpointSettings checkpoint;
  LiveOptions live;
  KeptMaps maps{};
  std::vector<Camera> views{};  // RenderInput::views
  // Whether an MPI launcher has started the render; the ranks that share its passes, null if this process is
  // alone.
  bool launched = false;
  Ranks* ranks = nullptr;
  // Whether files are written only if the render is complete.
  bool only_complete = false;
  // A render that is followed already, or null: `live` decides whether it is.
  std::shared_ptr<LiveRender> followed{};
  const accel::Bvh* bvh = nullptr;  // of the scene, if it exists already
  // Told the settings once nothing in them is open any more, before the render begins. May be empty.
  std::function<void(const Settings&)> settled{};
  render::PassSet goal;  // empty = all passes that the settings ask for
  bool bounded =
      false;  // `goal` holds even with a stop rule, which otherwise renders an open-ended number of passes
  render::PassSums done;        // finished passes, from a partial result
  bool fill_time = false;       // choose photons and samples that fill --time, see settle_time()
  bool settle_sources = false;  // see settle_sources(); not with fill_time
};

// A render of the job that others may follow.
std::shared_ptr<LiveRender> make_live(const Job& job);

// Decides what the settings leave open before anything is rendered: denoising, errors, and whether trials
// choose the work or the paths. given: the settings that were asked for, in place of defaults. Throws
// ExitError (bad command line) for rules that cannot be met.
void settle_session(const SettingOverrides& given, const Console& console, Job* job, RenderSession* session);

// Whether the session writes complete passes that can be resumed: checkpoints or partial results.
bool writes_sums(const RenderSession& session);

// Renders and writes all files, within a thread limit of its own. Returns the exit code; after an
// interruption it writes what is finished. `total`: started with the command. The job's settings become those
// that were chosen.
int run_session(Job& job, RenderSession session, const InterruptGuard& interrupt, const Stopwatch& total,
                const Console& console);

// Throws ExitError (bad command line) for more passes than photons.
void check_photons_of_passes(const Job& job);

// Parses the value of an option for passes or frames, such as "0:16" or "0:4,8:12". Throws OptionError.
render::PassSet parse_ranges(std::string_view option, std::string_view what, const std::string& text);

// Parses the value of --checkpoint-every into seconds. Throws OptionError.
double checkpoint_interval(const std::string& text);

}  // namespace kaustik::app
