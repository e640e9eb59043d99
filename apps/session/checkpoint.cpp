#include "apps/session/checkpoint.h"

#include <fmt/format.h>

namespace kaustik::app {

void Checkpoint::write(const render::PassSums& sums, const std::string& stopped_by) {
  render::write_partial(settings_.path, manifest_of(job_, outputs_, goal_, sums, stopped_by), sums);
  written_ = sums.passes;
}

void Checkpoint::after_pass(const render::PassSums& sums) {
  if (settings_.path.empty() || since_written_.seconds() < settings_.every) return;
  try {
    write(sums);
  } catch (const std::exception& error) {
    console_.warning(fmt::format("the checkpoint was not written: {}", error.what()));
  }
  since_written_ = {};
}

bool Checkpoint::finish(const render::PassSums& sums, const std::string& stopped_by) {
  if (settings_.path.empty() || sums.passes.empty()) return false;
  if (written_ != sums.passes || !stopped_by.empty()) write(sums, stopped_by);
  return true;
}

}  // namespace kaustik::app
