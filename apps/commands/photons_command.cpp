// kaustik photons: writes the photons as a point cloud and as a picture.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/commands/commands.h"
#include "apps/console/exit_error.h"
#include "apps/console/progress_bar.h"
#include "apps/machine/thread_limit.h"
#include "apps/session/files/file_writer.h"
#include "apps/session/files/output_files.h"
#include "apps/session/files/scene_loading.h"
#include "apps/session/interrupt.h"
#include "apps/session/isa_option.h"
#include "core/diagnostics/nearest_name.h"
#include "photon/record/ply_export.h"
#include "photon/shoot/memory_estimate.h"
#include "photon/shoot/shoot.h"
#include "render/picture/image_io.h"
#include "render/picture/photon_view.h"
#include "render/settings/names.h"

namespace kaustik::app {

namespace {

using photon::PhotonKind;

struct PhotonsOptions {
  std::string scene, cloud, image;
  std::vector<std::string> kinds;
  render::PhotonColours colours = render::PhotonColours::kLight;
  SettingOverrides overrides;
};

photon::KindMask mask_of(const std::vector<std::string>& kinds) {
  if (kinds.empty()) return {true, true, true, true, true, true};
  photon::KindMask mask;
  for (const std::string& name : kinds) {
    const auto& names = photon::kPhotonKindNames;
    const auto kind = render::from_name<PhotonKind>(names, name);
    if (!kind)
      throw ExitError(kBadCommandLine,
                      fmt::format("--kinds: unknown kind of photon `{}`{}", name, name_hint(name, names)));
    mask[*kind] = true;
  }
  return mask;
}

render::PhotonColours colours_named(const std::string& name) {
  const auto& names = render::kPhotonColoursNames;
  const auto colours = render::from_name<render::PhotonColours>(names, name);
  if (!colours)
    throw OptionError("--colours", fmt::format("`{}`: expected one of {}", name, fmt::join(names, ", ")));
  return *colours;
}

void check_outputs(const PhotonsOptions& options) {
  if (options.cloud.empty() && options.image.empty()) {
    throw ExitError(kBadCommandLine, "nothing to write: give -o map.ply, --image view.png, or both");
  }
  if (!options.cloud.empty()) {
    if (!options.cloud.ends_with(".ply")) {
      throw ExitError(kBadCommandLine, fmt::format("{}: the point cloud must end in .ply", options.cloud));
    }
    check_writable(options.cloud);
  }
  if (!options.image.empty()) check_image_output(options.image);
}

void check_names(const PhotonsOptions& options, const std::vector<NamedFile>& inputs) {
  check_collisions({{"-o", options.cloud}, {"--image", options.image}}, inputs);
}

std::vector<photon::PlyPhotons> wanted_photons(const photon::ShootResult& shot,
                                               const photon::KindMask& mask) {
  std::vector<photon::PlyPhotons> photons;
  for (int k = 0; k < photon::kPhotonKinds; ++k) {
    const auto kind = static_cast<PhotonKind>(k);
    if (mask[kind]) photons.push_back({kind, &shot.buffers[static_cast<size_t>(k)]});
  }
  return photons;
}

int shoot_and_write(const PhotonsOptions& options, const photon::KindMask& mask, const Job& job,
                    const InterruptGuard& interrupt, const Console& console) {
  const accel::Bvh bvh(job.scene, job.settings.render.threads);
  const render::RenderSettings& settings = job.settings.render;
  const photon::TraceSettings trace{.seed = settings.seed,
                                    .photons = settings.photons,
                                    .max_bounces = settings.max_bounces,
                                    .emission = settings.emission,
                                    .kinds = mask};
  photon::check_memory(job.scene, bvh, trace, photon::PhotonUse::kRecords, settings.photon_memory);
  photon::ShootResult shot;
  {
    ProgressBar bar(console);
    const render::ProgressCallback progress = shown_in(bar, interrupt);
    shot = photon::shoot(job.scene, bvh, trace, [&](uint64_t done, uint64_t total) {
      return progress({"photons", done, total});
    });
  }
  if (interrupt.requested()) {
    console.error("interrupted; nothing was written");
    return kInterrupted;
  }
  const std::vector<photon::PlyPhotons> photons = wanted_photons(shot, mask);
  console.note(fmt::format("photons: {} emitted", grouped(shot.counters.emitted)));
  for (const photon::PlyPhotons& kind : photons) {
    console.note(fmt::format("  {}: {} stored", photon::kPhotonKindNames[static_cast<size_t>(kind.kind)],
                             grouped(kind.buffer->records.size())));
  }
  FileWriter writer(console);
  if (!options.cloud.empty())
    writer.write(options.cloud, [&] { photon::write_photons_ply(options.cloud, photons, job.scene.origin); });
  if (!options.image.empty())
    writer.write(options.image, [&] {
      render::write_image(options.image, render::draw_photons(bvh, photons, options.colours));
    });
  return writer.report() ? kDone : kFailed;
}

int run_photons(const PhotonsOptions& options, const Console& console) {
  const photon::KindMask mask = mask_of(options.kinds);
  check_outputs(options);
  check_names(options, {{"the scene", options.scene}});
  const InterruptGuard interrupt;
  Job job;
  with_thread_limit(options.overrides.alone().render.threads, console,
                    [&] { job = load_job(options.scene, options.overrides, console, LoadFor::kPhotons); });
  check_names(options, files_of(job));
  int code = kDone;
  with_thread_limit(job.settings.render.threads, console,
                    [&] { code = shoot_and_write(options, mask, job, interrupt, console); });
  return code;
}

}  // namespace

Command make_photons_command() {
  Command command("photons", "Shoot photons and write them as coloured points");
  const auto options = std::make_shared<PhotonsOptions>();
  command.add_argument("SCENE", options->scene, "Scene file");
  command.add_text("-o,--output", "FILE", options->cloud, "Point cloud to write, a binary .ply");
  command.add_text("--image", "FILE", options->image,
                   "Picture to write: the same points seen by the scene's camera, with a legend");
  command
      .add_parsed("--colours", "NAME",
                  "Colours of the picture. light: those of the photons' light, and blue for shadow photons. "
                  "kind: one for each kind of photon. Default: light",
                  [options](const std::string& name) { options->colours = colours_named(name); })
      .choices = choices_of(render::kPhotonColoursNames);
  command
      .add_list("--kinds", "NAMES", options->kinds,
                "Kinds of photons, separated by commas: direct, shadow, caustic, indirect, "
                "medium-caustic, medium-indirect. Default: all")
      .choices = choices_of(photon::kPhotonKindNames);
  add_isa_option(command);
  command.add_quiet();
  add_setting_options(command, options->overrides, SettingsCommand::kPhotons);
  command.run = [options](const Console& console) { return run_photons(*options, console); };
  return command;
}

}  // namespace kaustik::app
