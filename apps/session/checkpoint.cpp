#include "apps/session/checkpoint.h"

#include <fmt/format.h>

#include "apps/console/exit_error.h"
#include "core/files/hidden_name.h"
#include "core/files/pending_file.h"

namespace kaustik::app {

std::unique_ptr<FileLock> lock_checkpoint(const CheckpointSettings& settings) {
  if (settings.path.empty()) return nullptr;
  try {
    const std::filesystem::path path = settings.path;
    auto lock = std::make_unique<FileLock>(path.parent_path() / (hidden_name_beginning(path) + "lock"));
    remove_leftovers(settings.path);
    return lock;
  } catch (const FileError& error) {
    refuse(fmt::format("cannot write the checkpoint {}: {}", settings.path, error.what()));
  }
}

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
