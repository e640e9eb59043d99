#pragma once
// Writes partial results while a render is running.

#include <memory>
#include <string>

#include "apps/session/files/partial_files.h"
#include "core/files/file_lock.h"
#include "core/stopwatch.h"

namespace kaustik::app {

struct CheckpointSettings {
  std::string path;   // empty = no checkpoints
  double every = 60;  // seconds
};

// Makes this process the only writer of the checkpoint, and removes what killed ones have left of it. Null if
// there is no checkpoint. Throws ExitError (bad command line) if another process writes it.
std::unique_ptr<FileLock> lock_checkpoint(const CheckpointSettings& settings);

// Writes a checkpoint after the pass in which its interval has elapsed, and at the end.
class Checkpoint {
 public:
  // `outputs` and `goal` go into the manifest. `job` and `console` must outlive the checkpoint.
  Checkpoint(CheckpointSettings settings, const Job& job, std::vector<std::string> outputs,
             render::PassSet goal, const Console& console)
      : settings_(std::move(settings)),
        job_(job),
        outputs_(std::move(outputs)),
        goal_(std::move(goal)),
        console_(console) {}

  // Writes a checkpoint if it is due. A failure to write is only a warning: the render continues, and the
  // next attempt may succeed.
  void after_pass(const render::PassSums& sums);
  // Writes the last checkpoint, unless the file already holds these passes and no rule stopped the render.
  // `stopped_by`: the rule that ended the render, or empty. False when checkpoints are off or no pass is
  // complete. Throws PartialError.
  bool finish(const render::PassSums& sums, const std::string& stopped_by);

 private:
  void write(const render::PassSums& sums, const std::string& stopped_by = {});

  CheckpointSettings settings_;
  const Job& job_;
  std::vector<std::string> outputs_;
  render::PassSet goal_, written_;
  const Console& console_;
  Stopwatch since_written_;
};

}  // namespace kaustik::app
