// kaustik bench: measures how fast a scene renders, for lists of photon counts and threads.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "apps/bench/baseline.h"
#include "apps/bench/bench_json.h"
#include "apps/bench/bench_table.h"
#include "apps/bench/gbench_json.h"
#include "apps/bench/machine.h"
#include "apps/bench/measure.h"
#include "apps/bench/span.h"
#include "apps/command_line/whole_numbers.h"
#include "apps/commands/commands.h"
#include "apps/console/exit_error.h"
#include "apps/console/progress_bar.h"
#include "apps/machine/peak_memory.h"
#include "apps/machine/thread_limit.h"
#include "apps/machine/usable_cores.h"
#include "apps/report/bench_report.h"
#include "apps/session/files/collisions.h"
#include "apps/session/files/file_writer.h"
#include "apps/session/files/output_files.h"
#include "apps/session/files/scene_loading.h"
#include "apps/session/interrupt.h"
#include "apps/session/isa_option.h"
#include "apps/settings/settings_json.h"
#include "core/version.h"

namespace kaustik::app {

namespace fs = std::filesystem;

namespace {

struct BenchOptions {
  std::string scene, from, json, plot, baseline, format = "kaustik";
  std::vector<std::string> photons = {"1M"}, photons_per_thread, threads;
  std::string repeat = "5";
  bool span = false, require_idle = false;
  std::optional<float> most_slowdown;  // percent
  SettingOverrides overrides;
};

constexpr std::string_view kReportName = "scaling.html";
constexpr int kMostThreads = 65535;  // as for `render --threads`

// 1, 2, 4 ... and the number of usable cores.
std::vector<int> doubling_threads(int usable) {
  std::vector<int> threads;
  for (int t = 1; t < usable; t *= 2) threads.push_back(t);
  threads.push_back(usable);
  return threads;
}

BenchPlan plan_of(const BenchOptions& options, const CoreLimits& cores) {
  BenchPlan plan;
  plan.photons = whole_numbers("--photons", options.photons);
  plan.photons_per_thread = whole_numbers("--photons-per-thread", options.photons_per_thread);
  if (options.threads.empty()) plan.threads = doubling_threads(cores.usable());
  for (const uint64_t threads : whole_numbers("--threads", options.threads, kMostThreads))
    plan.threads.push_back(static_cast<int>(threads));
  plan.repeat = whole_number("--repeat", options.repeat, 1'000'000);
  return plan;
}

// Checks that figures can be written. The folder need not exist yet, but its parent must.
void check_plot_folder(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return check_writable((fs::path(path) / kReportName).string());
  if (fs::exists(path, ignored))
    throw ExitError(kBadCommandLine, fmt::format("cannot write {}: it is not a folder", path));
  check_writable(path.substr(0, path.find_last_not_of('/') + 1));
}

std::string report_of(const std::string& folder) {
  return (fs::path(folder) / kReportName).string();
}

std::vector<NamedFile> files_written(const BenchOptions& options) {
  return {{"--json", options.json}, {"--plot", options.plot.empty() ? "" : report_of(options.plot)}};
}

void check_options(const BenchOptions& options) {
  if (options.scene.empty() == options.from.empty())
    throw ExitError(kBadCommandLine, "give a scene to measure, or --from FILE with an earlier result");
  if (!options.json.empty()) check_writable(options.json);
  if (!options.plot.empty()) check_plot_folder(options.plot);
  check_collisions(
      files_written(options),
      {{"the scene", options.scene}, {"--from", options.from}, {"--baseline", options.baseline}});
}

// The settings that all points have in common; each point has its own photons and threads.
Json bench_settings(const Settings& settings, const render::EstimatorPlan& plan) {
  return settings_json(settings, plan,
                       [](const Setting& setting) { return setting.commands.has(SettingsCommand::kBench); });
}

void warn_of_threads(const BenchPlan& plan, const CoreLimits& cores, const Console& console) {
  const int most = *std::max_element(plan.threads.begin(), plan.threads.end());
  if (most > cores.usable())
    console.warning(fmt::format("{} threads share {} usable core{}", most, cores.usable(),
                                cores.usable() == 1 ? "" : "s"));
  if (!restart_peak_memory())
    console.warning("the peak memory cannot be reset on this system: it is the peak of all runs so far");
}

std::vector<BenchPoint> measure_job(const Job& job, const BenchPlan& plan, const InterruptGuard& interrupt,
                                    const Console& console) {
  ProgressBar bar(console);
  uint64_t shown = plan.runs();
  const auto progress = [&](uint64_t done) {
    if (done != shown) bar.update({"runs", shown = done, plan.runs()});
    return !interrupt.requested();
  };
  std::optional<std::vector<BenchPoint>> points = measure(job.scene, job.settings.render, plan, progress);
  if (points) return std::move(*points);
  bar.clear();
  throw ExitError(kInterrupted, "interrupted; nothing was written");
}

std::vector<SpanPoint> measure_spans(const BenchOptions& options, const BenchPlan& plan,
                                     const InterruptGuard& interrupt, const Console& console) {
  std::vector<SpanPoint> spans;
  std::ostream nowhere(nullptr);
  const Console silent{console.out, nowhere, false, true};  // the scene's messages have been shown
  for (const uint64_t photons : plan.photons) {
    auto span = measure_span(options.scene, options.overrides, photons, silent,
                             [&] { return !interrupt.requested(); });
    if (!span) throw ExitError(kInterrupted, "interrupted; nothing was written");
    spans.push_back(std::move(*span));
  }
  return spans;
}

BenchResult run_scene(const BenchOptions& options, const Console& console) {
  const CoreLimits cores = core_limits();
  const BenchPlan plan = plan_of(options, cores);
  const InterruptGuard interrupt;
  Job job;
  const int most = *std::max_element(plan.threads.begin(), plan.threads.end());
  if (const int possible = startable_threads(most); possible < most)
    throw ExitError(kFailed,
                    fmt::format("the system lets this process run {} of {} threads", possible, most));
  with_thread_limit(most, [&] { job = load_job(options.scene, options.overrides, console); });
  check_collisions(files_written(options), files_of(job));
  const render::EstimatorPlan estimators = render::make_plan(job.settings.render, job.scene.needs);
  for (const std::string& note : estimators.notes) console.note(note);
  warn_of_threads(plan, cores, console);
  BenchResult result{.scene = utf8(options.scene),
                     .version = std::string(version()),
                     .build = std::string(build_id()),
                     .machine = machine_json(),
                     .settings = bench_settings(job.settings, estimators),
                     .repeat = plan.repeat,
                     .points = {}};
  result.points = measure_job(job, plan, interrupt, console);
  if (options.span) result.spans = measure_spans(options, plan, interrupt, console);
  return result;
}

BenchResult read_result(const std::string& path) {
  const std::string text = text_of_file(path);
  try {
    return bench_from_json(text);
  } catch (const std::exception& error) {
    throw ExitError(kBadCommandLine,
                    fmt::format("{} is not a result of kaustik bench: {}", path, error.what()));
  }
}

void write_report(const BenchResult& result, const std::string& folder) {
  fs::create_directory(folder);
  write_text_file(report_of(folder), bench_report(result));
}

// Prints the ratios to the baseline; returns what is wrong, or an empty string.
std::string compare_with_baseline(const BenchOptions& options, const BenchResult& result,
                                  const BenchResult& baseline, const Console& console) {
  try {
    console.out << baseline_table(result, baseline);
  } catch (const std::runtime_error& error) {
    throw ExitError(kBadCommandLine, fmt::format("{}: {}", options.baseline, error.what()));
  }
  if (!options.most_slowdown) return {};
  return slow_down(result, baseline, 1 + double(*options.most_slowdown) / 100);
}

int run_bench(const BenchOptions& options, const Console& console) {
  check_options(options);
  std::optional<BenchResult> baseline;
  if (!options.baseline.empty()) baseline = read_result(options.baseline);
  const BenchResult result = options.from.empty() ? run_scene(options, console) : read_result(options.from);
  console.out << bench_table(result);
  std::string trouble;
  if (baseline) trouble = compare_with_baseline(options, result, *baseline, console);
  if (options.require_idle && is_disturbed(result)) trouble = "other programs ran: threads waited for cores";
  FileWriter writer(console);
  const auto text = options.format == "gbench" ? gbench_json : bench_json;
  if (!options.json.empty()) writer.write(options.json, [&] { write_text_file(options.json, text(result)); });
  if (!options.plot.empty())
    writer.write(report_of(options.plot), [&] { write_report(result, options.plot); });
  if (!trouble.empty()) console.error(trouble);
  return writer.report() && trouble.empty() ? kDone : kFailed;
}

// Whether the option does something with a result that has been measured earlier.
bool is_of_results(const std::string& option) {
  constexpr std::string_view kNames[] = {"--help",     "--plot",         "--json",        "--format",
                                         "--baseline", "--max-slowdown", "--require-idle"};
  return std::find(std::begin(kNames), std::end(kNames), option) != std::end(kNames);
}

void add_options(Command& command, BenchOptions& options) {
  command.add_argument("SCENE", options.scene, "Scene file").required = false;
  command.add_list("--photons", "COUNTS", options.photons,
                   "Photon counts, separated by commas, like 1M,10M. Default: 1M");
  command.add_list(
      "--photons-per-thread", "COUNTS", options.photons_per_thread,
      "Also measure these numbers of photons for each thread, whose tracing and maps then take the "
      "same time on any number of threads if they scale (weak scaling)");
  command.add_list(
      "--threads", "COUNTS", options.threads,
      "Thread counts, separated by commas. Speed-ups are relative to the first. Default: 1, 2, 4 ... up "
      "to the usable cores");
  command.add_flag("--span", options.span,
                   "Also measure work and span in one thread, and print from them how far the render can "
                   "scale on more cores than this machine has, and what holds it up");
  command.add_text("--repeat", "COUNT", options.repeat, "Runs per point. Default: 5");
  command.add_text("--json", "FILE", options.json, "Write the result to this JSON file");
  command
      .add_parsed(
          "--format", "NAME",
          "Form of that file. kaustik: all that was measured, for --from and --baseline. gbench: that "
          "of google-benchmark, for the dashboards that read it. Default: kaustik",
          [&options](const std::string& text) {
            if (text != "kaustik" && text != "gbench")
              throw OptionError("--format", fmt::format("`{}`: expected kaustik or gbench", text));
            options.format = text;
          })
      .needs = {"--json"};
  command.add_flag("--require-idle", options.require_idle,
                   "Exit with 1 if other programs ran, so that threads waited for cores");
  command.add_text(
      "--plot", "FOLDER", options.plot,
      "Write charts of the scaling to the page scaling.html in this folder, which is created if missing");
  command.add_text("--baseline", "FILE", options.baseline,
                   "Compare with the JSON of an earlier run: print the ratios of the times");
  command
      .add_number("--max-slowdown", "PERCENT", options.most_slowdown,
                  "Exit with 1 if a total takes so much longer than that of the baseline, and all its runs "
                  "longer than all of those")
      .needs = {"--baseline"};
  const size_t place = command.options.size();
  command.add_text("--from", "FILE", options.from, "Read the JSON of an earlier run instead of measuring");
  add_setting_options(command, options.overrides, SettingsCommand::kBench);
  Option& from = command.options[place];
  for (const Option& option : command.options)
    if (&option != &from && !is_of_results(option.long_name())) from.excludes.push_back(option.long_name());
}

}  // namespace

Command make_bench_command() {
  Command command("bench", "Measure speed, memory and scaling on a scene");
  const auto options = std::make_shared<BenchOptions>();
  add_options(command, *options);
  add_isa_option(command);
  command.add_quiet();
  command.run = [options](const Console& console) { return run_bench(*options, console); };
  return command;
}

}  // namespace kaustik::app
