// kaustik shoot: shoots the photons of a render and keeps their maps.

#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "apps/console/exit_error.h"
#include "apps/console/progress_bar.h"
#include "apps/machine/thread_limit.h"
#include "apps/session/files/collisions.h"
#include "apps/session/files/output_files.h"
#include "apps/session/interrupt.h"
#include "apps/session/isa_option.h"
#include "apps/session/kept_maps.h"
#include "render/passes/passes.h"

namespace kaustik::app {

namespace {

struct ShootOptions {
  std::string scene, map;
  SettingOverrides overrides;
};

int shoot_maps(const KeptMaps& kept, const Job& job, const InterruptGuard& interrupt,
               const Console& console) {
  const accel::Bvh bvh(job.scene, job.settings.render.threads);
  render::EstimatorPlan plan = render::make_plan(job.settings.render, job.scene.needs);
  for (const std::string& note : plan.notes) console.note(note);
  render::choose_passes(job.scene, bvh, job.settings.render, &plan);  // throws if memory does not suffice
  std::shared_ptr<render::FirstPhotons> photons;
  {
    ProgressBar bar(console);
    make_photons(kept, job, bvh, {}, shown_in(bar, interrupt), &photons);
  }
  if (!photons->photons.radii()) {
    console.error("interrupted; nothing was written");
    return kInterrupted;
  }
  const render::RenderStatistics& s = photons->statistics;
  for (size_t k = 0; k < photon::kPhotonKinds; ++k)
    if (const uint64_t stored = s.photons.stored[k] + s.guided.stored[k]; stored > 0)
      console.note(fmt::format("  {}: {} stored", photon::kPhotonKindNames[k], grouped(stored)));
  console.note("wrote " + kept.save);
  return kDone;
}

int run_shoot(const ShootOptions& options, const Console& console) {
  if (options.map.empty()) throw ExitError(kBadCommandLine, "nothing to write: give -o room.kmap");
  check_map_output(options.map);
  check_collisions({{"-o", options.map}}, {{"the scene", options.scene}});
  const InterruptGuard interrupt;
  Job job;
  int code = kDone;
  with_thread_limit(options.overrides.alone().render.threads, console, [&] {
    job = load_job(options.scene, options.overrides, console, LoadFor::kPhotons);
    check_collisions({{"-o", options.map}}, files_of(job));
    const KeptMaps kept{options.map, {}};
    if (std::exchange(job.settings.render.passes, 1) > 1)
      console.note("all photons are shot in one pass, whatever the settings say of passes");
    settle_kept_maps(kept, console, &job);
    code = shoot_maps(kept, job, interrupt, console);
  });
  return code;
}

}  // namespace

Command make_shoot_command() {
  Command command("shoot", "Shoot photons and keep their maps, for `kaustik render --map`");
  const auto options = std::make_shared<ShootOptions>();
  command.add_argument("SCENE", options->scene, "Scene file: .pbrt, .gltf, .glb, .obj, .ply or .stl");
  command.add_text("-o,--output", "FILE", options->map, "File of photon maps (.kmap) to write");
  add_isa_option(command);
  command.add_quiet();
  add_setting_options(command, options->overrides, SettingsCommand::kShoot);
  command.examples =
      "  kaustik shoot room.pbrt -o room.kmap --photons 20M\n"
      "  kaustik render room.pbrt --map room.kmap -o room.exr --spp 64\n"
      "  kaustik shoot room.pbrt -o room.kmap --for-camera all     for renders of other cameras";
  command.run = [options](const Console& console) { return run_shoot(*options, console); };
  return command;
}

}  // namespace kaustik::app
