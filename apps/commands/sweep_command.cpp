// kaustik sweep: measures error against time for lists of photon counts, radii, methods and samples, and
// writes a report.

#include <fmt/format.h>

#include <filesystem>

#include "apps/bench/bench_json.h"
#include "apps/bench/machine.h"
#include "apps/command_line/values.h"
#include "apps/commands/commands.h"
#include "apps/console/exit_error.h"
#include "apps/console/progress_bar.h"
#include "apps/import/common/scene_files.h"
#include "apps/machine/instruction_set.h"
#include "apps/machine/thread_limit.h"
#include "apps/report/sweep_report.h"
#include "apps/session/files/collisions.h"
#include "apps/session/files/output_files.h"
#include "apps/session/files/partial_files.h"
#include "apps/session/interrupt.h"
#include "apps/session/isa_option.h"
#include "apps/sweep/reference.h"
#include "apps/sweep/run_cells.h"
#include "apps/sweep/sweep_files.h"
#include "core/diagnostics/nearest_name.h"
#include "core/files/content_hash.h"
#include "core/text.h"
#include "core/version.h"
#include "render/settings/names.h"

namespace kaustik::app {

namespace fs = std::filesystem;

namespace {

struct SweepOptions {
  std::string scene, folder;
  GridTexts grid;
  ReferenceChoice reference;
  std::optional<float> mask_bright;
  SettingOverrides overrides;
};

// Settings that differ from cell to cell.
constexpr std::string_view kVaried[] = {"method",  "direct", "caustics", "indirect",
                                        "photons", "radius", "spp"};

template <size_t Size>
bool among(const std::string_view (&names)[Size], std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

// The settings that all cells have in common: those that decide their pixels or that the command takes. The
// number of threads is stored separately.
Json common_settings(const Settings& settings) {
  Json out = Json::object();
  for (const Setting& setting : settings_table()) {
    const bool counts = setting.decides_sums || setting.commands.has(SettingsCommand::kSweep);
    const std::vector<std::string> texts = setting.show(settings);
    if (counts && !texts.empty() && !among(kVaried, setting.name) && setting.name != "threads")
      out[std::string(setting.name)] = fmt::format("{}", fmt::join(texts, " "));
  }
  return out;
}

std::string hash_of_file(const std::string& path) {
  std::string error;
  const auto bytes = pbrt::read_bytes(ReadableFile::trusted(path), uint64_t{1} << 36, error);
  if (!bytes) throw ExitError(kBadCommandLine, fmt::format("--reference: {}: {}", path, error));
  ContentHash hash;
  hash.add(*bytes);
  return hash.text();
}

// Extensions of picture formats that can hold any radiance.
constexpr std::string_view kFloatPictures[] = {".exr", ".hdr", ".pfm", ".tif", ".tiff"};

Json reference_mark(const SweepOptions& options, const Job& job) {
  if (!options.reference.file.empty()) return {{"file", hash_of_file(options.reference.file)}};
  const render::Method method = options.reference.method.value_or(reference_method(job.scene.needs));
  return {{"method", render::name_of(method)}, {"seconds", options.reference.seconds}};
}

// What all cells of a folder share. Cells that differ in any of it must not be mixed in one table.
Json common_of(const SweepOptions& options, const Job& job, int threads) {
  Json out;
  out["kaustik_sweep_of"] = 1;
  out["scene"] = job.content_hash;
  out["build"] = program_build();
  out["instruction_set"] = instruction_set();
  out["threads"] = threads;
  out["settings"] = common_settings(job.settings);
  out["mask_bright"] = options.mask_bright ? Json(*options.mask_bright) : Json(nullptr);
  out["reference"] = reference_mark(options, job);
  return out;
}

void warn_of_reference(const SweepOptions& options, const Job& job, const Console& console) {
  const std::string extension = lower_extension(options.reference.file);
  if (!extension.empty() && !among(kFloatPictures, extension))
    console.warning(
        fmt::format("the reference {} is in an integer format: it is read as if it had been written with "
                    "--exposure 0 --tonemap srgb; radiance above 1 is clipped, and rounding counts as error",
                    options.reference.file));
  if (options.reference.method == render::Method::kMc && job.scene.needs.specular)
    console.warning(
        "the reference `mc` never finds the light of point lights through glass or mirrors, and rarely that "
        "of "
        "small lights");
}

// Makes the reference, with a progress bar. Throws ExitError when interrupted.
Reference reference_of(const SweepOptions& options, Job& job, const SweepFolder& folder,
                       const InterruptGuard& interrupt, const Console& console) {
  ProgressBar bar(console);
  const auto progress = [&](uint64_t done, uint64_t total) {
    bar.update({"reference", done, std::max<uint64_t>(total, 1)});
    return !interrupt.requested();
  };
  std::optional<Reference> reference = make_reference(options.reference, job, folder, progress, console);
  bar.clear();
  if (!reference)
    throw ExitError(kInterrupted, "interrupted; run the same command again to continue the reference");
  const SweepReference& about = reference->about;
  console.note(fmt::format("reference: {}{}", about.source,
                           about.noise ? fmt::format(", noise {:.2g} in relMSE", *about.noise) : ""));
  return std::move(*reference);
}

std::vector<SweepCell> cells_of(const SweepJob& sweep, const std::vector<SweepPoint>& points,
                                const SweepFolder& folder, const InterruptGuard& interrupt,
                                const Console& console) {
  console.note(
      fmt::format("{}, each with {}", counted(points.size(), "point"), counted(sweep.grid.seeds, "seed")));
  ProgressBar bar(console);
  RunCells run = run_cells(
      sweep, points, folder,
      [&](uint64_t done, uint64_t total) {
        bar.update({"sweep", done, total});
        return !interrupt.requested();
      },
      console);
  bar.clear();
  if (run.reused > 0) console.note(fmt::format("reused {} of an earlier run", counted(run.reused, "point")));
  if (run.cancelled)
    throw ExitError(kInterrupted, fmt::format("interrupted with {} of {} points finished; run the same "
                                              "command again to continue",
                                              run.cells.size(), points.size()));
  return std::move(run.cells);
}

void write_result(const SweepResult& result, const SweepFolder& folder, const Console& console) {
  write_text_file(folder.path("sweep.json"), sweep_json(result).dump(2) + "\n");
  write_text_file(folder.path("sweep.csv"), sweep_csv(result));
  write_text_file(folder.path("report.html"), sweep_report(result, folder.path("")));
  for (const char* name : {"sweep.json", "sweep.csv", "report.html"})
    console.note("wrote " + folder.path(name));
  for (const Advice& advice : advice_of(result.cells)) console.out << advice.text << '\n';
}

void warn_of_noise(const SweepResult& result, const Console& console) {
  for (const SweepCell& cell : result.cells)
    if (result.reference.noise && cell.error.relmse < 4 * *result.reference.noise)
      return console.warning(
          "the reference's own noise is more than a quarter of a measured error: increase --reference-time");
}

// The reference of --reference may lie in the folder, as the picture of an earlier sweep.
void check_names(const SweepOptions& options, const Job& job) {
  std::vector<NamedFile> inputs = files_of(job), outputs;
  inputs.push_back({"--reference", options.reference.file});
  for (const char* name : {"reference.png", "sweep-of.json", "sweep.json", "sweep.csv", "report.html"})
    outputs.push_back({"-o", (fs::path(options.folder) / name).string()});
  check_collisions(outputs, inputs);
}

int run_sweep(const SweepOptions& options, const Console& console) {
  const SweepGrid grid = parse_grid(options.grid);
  const InterruptGuard interrupt;
  const int asked = options.overrides.alone().render.threads;
  const int threads = threads_to_run(asked, console);
  program_build();  // asks Embree for its version before it starts to work
  with_thread_limit(threads, [&] {
    Job job = load_job(options.scene, options.overrides, console);
    check_names(options, job);
    const auto points = points_of(grid, job.settings, options.overrides, job.scene.needs);
    const SweepFolder folder(options.folder, common_of(options, job, threads));
    warn_of_reference(options, job, console);
    const Reference reference = reference_of(options, job, folder, interrupt, console);
    SweepResult result{.scene = utf8(options.scene),
                       .version = std::string(version()),
                       .build = std::string(build_id()),
                       .machine = machine_json(),
                       .settings = common_settings(job.settings),
                       .width = picture_size(job).first,
                       .height = picture_size(job).second,
                       .threads = threads,
                       .seeds = grid.seeds,
                       .mask_bright = options.mask_bright,
                       .reference = reference.about,
                       .cells = {}};
    const SweepJob sweep{job, grid, options.overrides, reference, {.mask_bright = options.mask_bright}};
    result.cells = cells_of(sweep, points, folder, interrupt, console);
    warn_of_noise(result, console);
    write_result(result, folder, console);
  });
  return kDone;
}

double reference_time(const std::string& text) {
  const std::optional<double> seconds = parse_duration(text);
  if (seconds && *seconds > 0) return *seconds;
  throw OptionError("--reference-time",
                    fmt::format("`{}`: expected a time above 0 with its unit, like 90s, 10m or 1.5h", text));
}

render::Method method_named(const std::string& text) {
  if (const auto method = render::from_name<render::Method>(render::kMethodNames, text)) return *method;
  throw OptionError("--reference-method",
                    fmt::format("unknown method `{}`{}", text, name_hint(text, render::kMethodNames)));
}

void add_reference_options(Command& command, SweepOptions& options) {
  command.add_text("--reference", "FILE", options.reference.file,
                   "Reference picture, linear and of the rendered size. Default: a reference is rendered");
  command
      .add_parsed("--reference-time", "TIME",
                  "Time for rendering the reference, like 90s or 10m. Default: 60s",
                  [&options](const std::string& text) { options.reference.seconds = reference_time(text); })
      .excludes = {"--reference"};
  Option& method = command.add_parsed(
      "--reference-method", "NAME",
      "Method of the reference: mc, auto ... Default: mc for scenes without mirrors and glass, else "
      "auto",
      [&options](const std::string& text) { options.reference.method = method_named(text); });
  method.excludes = {"--reference"};
  method.choices = choices_of(render::kMethodNames);
  command.add_number(
      "--mask-bright", "L", options.mask_bright,
      "Ignore reference pixels brighter than L [W/(m^2 sr)] and 2 pixels around them, such as edges of "
      "lights. Default: ignore none");
}

void add_grid_options(Command& command, GridTexts& grid) {
  command.add_list("--photons", "COUNTS", grid.photons,
                   "Photon counts, separated by commas. Default: 100k,1M");
  command.add_list(
      "--radius", "RADII", grid.radii,
      "Gather radii, separated by commas: auto, multiples of it like 0.5x, or metres. Default: 0.5x,auto,2x");
  command
      .add_list("--methods", "NAMES", grid.methods,
                "Methods, separated by commas; see `render --method`. Default: the scene's")
      .choices = choices_of(render::kMethodNames);
  command.add_list("--spp", "COUNTS", grid.spp,
                   "Samples per pixel, separated by commas. Default: the scene's");
  command.add_text("--seeds", "COUNT", grid.seeds,
                   "Renders per point, with consecutive seeds from --seed on. Default: 5");
}

}  // namespace

Command make_sweep_command() {
  Command command("sweep", "Measure error against time over photons, radii and methods, with a report");
  const auto options = std::make_shared<SweepOptions>();
  command.add_argument("SCENE", options->scene, "Scene file");
  command
      .add_text("-o,--output", "FOLDER", options->folder,
                "Folder for the results, created if missing. An interrupted sweep in it is continued")
      .required = true;
  add_grid_options(command, options->grid);
  add_reference_options(command, *options);
  add_setting_options(command, options->overrides, SettingsCommand::kSweep);
  add_isa_option(command);
  command.add_quiet();
  command.run = [options](const Console& console) { return run_sweep(*options, console); };
  return command;
}

}  // namespace kaustik::app
