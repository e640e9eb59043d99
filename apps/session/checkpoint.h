#pragma once
// Partial results written while a render is at work.

#include <string>

#include "apps/session/partial_files.h"
#include "core/stopwatch.h"

namespace kaustik::app {

struct CheckpointSettings {
  std::string path;   // empty: none are written
  double every = 60;  // seconds
};

// Written after the pass in which the time has run out, and at the end.
class Checkpoint {
 public:
  // outputs, goal: for the manifest. job and console must outlive it.
  Checkpoint(CheckpointSettings settings, const Job& job, std::vector<std::string> outputs,
             render::PassSet goal, const Console& console)
      : settings_(std::move(settings)),
        job_(job),
        outputs_(std::move(outputs)),
        goal_(std::move(goal)),
        console_(console) {}

  // Failures to write are warnings: the render goes on, and the next time may do.
  void after_pass(const render::PassSums& sums);
  // stopped_by: the rule that ended the render, or nothing. Unless the last one written holds these passes,
  // and no rule did. False when there was nothing to write. Throws
  // PartialError.
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
