// kaustik merge: combines partial results into a picture or one partial result.

#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "apps/console/exit_error.h"
#include "apps/session/files/partial_files.h"
#include "apps/session/isa_option.h"
#include "apps/session/render_outputs.h"
#include "core/stopwatch.h"

namespace kaustik::app {

namespace {

struct MergeOptions {
  std::vector<std::string> parts;
  OutputOptions outputs;
  bool allow_gaps = false;
  SettingOverrides overrides;
};

// A file whose sums have been added to the total.
struct MergedPart {
  std::string path;
  render::PassSet passes;
};

void add_part(const std::string& path, const render::PartialResult& part, std::vector<MergedPart>& merged,
              render::PartialResult& total) {
  const std::string why = render::difference(total, part);
  if (!why.empty()) refuse(fmt::format("{} and {} cannot be merged: {}", merged.front().path, path, why));
  for (const MergedPart& other : merged) {
    const render::PassSet common = other.passes.common(part.sums.passes);
    if (!common.empty())
      refuse(fmt::format("{} and {} both hold passes {}", other.path, path, common.text()));
  }
  total.sums.add(part.sums);
  total.manifest.goal.add(part.manifest.goal);
  if (total.manifest.stopped_by.empty()) total.manifest.stopped_by = part.manifest.stopped_by;
  merged.push_back({path, part.sums.passes});
}

render::PartialResult merge_files(const MergeOptions& options) {
  render::PartialResult total = load_partial(options.parts.front());
  std::vector<MergedPart> merged = {{options.parts.front(), total.sums.passes}};
  for (size_t i = 1; i < options.parts.size(); ++i)
    add_part(options.parts[i], load_partial(options.parts[i]), merged, total);
  const uint64_t asked_for = total.manifest.stopped_by.empty() ? total.sums.shares : 0;
  total.manifest.goal =
      render::PassSet(0, std::max(asked_for, std::max(total.manifest.goal.end(), total.sums.passes.end())));
  total.manifest.outputs.clear();
  return total;
}

// Throws ExitError for missing passes, or logs them with --allow-gaps. A pass is missing if a later one
// exists, or if the settings ask for it and no stop rule ended the render earlier.
void check_gaps(const MergeOptions& options, const render::PartialResult& total, const Console& console) {
  const render::PassSums& sums = total.sums;
  const uint64_t end = std::max(total.manifest.stopped_by.empty() ? sums.shares : 0, sums.passes.end());
  const render::PassSet missing = render::PassSet(0, end).without(sums.passes);
  if (missing.empty()) return;
  if (sums.passes.empty()) refuse("no part holds any pass");
  const std::string message = fmt::format("passes {} of {} are missing", missing.text(), end);
  if (!options.allow_gaps) refuse(message + "; --allow-gaps merges the others");
  console.note(message);
}

int run_merge(const MergeOptions& options, const Console& console) {
  const Stopwatch watch;
  if (options.outputs.files.empty()) refuse("-o is required: it names the file to write");
  check_outputs(options.outputs);
  check_collisions(named_files(options.outputs), {});
  render::PartialResult total = merge_files(options);
  check_gaps(options, total, console);
  SettingOverrides overrides = settings_of(total.manifest, options.parts.front());
  overrides.append(options.overrides);
  const Settings settings = overrides.alone();
  render::RenderResult result;
  result.plan = render::make_plan(settings.render, total.manifest.needs);
  result.sums = std::move(total.sums);
  render::show_passes(&result);
  console.note(fmt::format("passes {}", result.sums.passes.text()));
  render::OuterTimes times;
  times.total = watch.seconds();
  const bool written = write_outputs(options.outputs, {result, settings, total.manifest}, times, console);
  return written ? kDone : kFailed;
}

}  // namespace

Command make_merge_command() {
  Command command("merge", "Merge partial results into a picture");
  const auto options = std::make_shared<MergeOptions>();
  command.add_arguments("PARTS", options->parts, "Partial results (.kpart) of one render, in any order");
  add_output_options(command, options->outputs, "none");
  command.add_flag("--allow-gaps", options->allow_gaps, "Merge even if passes are missing");
  add_isa_option(command);
  command.add_quiet("Suppress the log, but not warnings and errors");
  add_setting_options(command, options->overrides, SettingsCommand::kMerge);
  command.run = [options](const Console& console) { return run_merge(*options, console); };
  return command;
}

}  // namespace kaustik::app
