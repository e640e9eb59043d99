#pragma once
// What `render` and `resume` have in common: passes under a progress bar, checkpoints, files at the end or
// when a signal comes.

#include "apps/session/checkpoint.h"
#include "apps/session/interrupt.h"
#include "apps/session/render_outputs.h"

namespace kaustik::app {

struct RenderSession {
  OutputOptions outputs;
  CheckpointSettings checkpoint;
  render::PassSet goal;    // empty: all passes that the settings ask for
  bool bounded = false;    // also where a rule says when to stop, which else knows no last pass
  render::PassSums done;   // passes that are there, and in the checkpoint's file
  bool fill_time = false;  // with as many photons and samples, see settle_time()
};

// Whether files hold complete passes, which can be gone on with: checkpoints, partial results.
bool writes_sums(const RenderSession& session);

// Within a thread limit of its own. Returns the exit code: done, or interrupted after writing what there is.
// total: started when the command was.
int run_session(Job job, RenderSession session, const InterruptGuard& interrupt, const Stopwatch& total,
                const Console& console);

// --checkpoint-every: for options of commands. Throws CLI::ValidationError.
double checkpoint_interval(const std::string& text);

}  // namespace kaustik::app
