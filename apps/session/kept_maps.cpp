#include "apps/session/kept_maps.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <limits>

#include "apps/console/exit_error.h"
#include "apps/machine/instruction_set.h"
#include "apps/session/files/partial_files.h"
#include "core/files/content_hash.h"
#include "render/maps/photon_shoots.h"
#include "render/passes/pass_trials.h"
#include "render/plan/pass_share.h"
#include "render/settings/names.h"

namespace kaustik::app {

namespace {

render::SettingTexts texts_of(const Settings& settings, MapPart part) {
  return setting_texts(settings, [&](const Setting& s) { return s.map_part == part; });
}

// Those of the file's settings that decide this part of its maps.
render::SettingTexts texts_of(const render::MapManifest& manifest, MapPart part) {
  render::SettingTexts out;
  for (const auto& entry : manifest.settings) {
    const Setting* setting = find_setting(entry.first);
    if (setting && setting->map_part == part) out.push_back(entry);
  }
  return out;
}

photon::TraceSettings traced(const Job& job) {
  const render::RenderSettings& settings = job.settings.render;
  return render::trace_settings(settings, render::make_plan(settings, job.scene.needs),
                                render::pass_share(0, 1, settings.photons, settings.spp));
}

std::string names_of(const photon::KindMask& kinds) {
  std::vector<std::string_view> names;
  for (size_t k = 0; k < photon::kPhotonKinds; ++k)
    if (kinds[static_cast<photon::PhotonKind>(k)]) names.push_back(photon::kPhotonKindNames[k]);
  return names.empty() ? "no" : fmt::format("{}", fmt::join(names, ", "));
}

// Every setting on which photons depend must be that of the file.
void check_settings(const render::MapFile& file, const Job& job) {
  const render::SettingTexts there = texts_of(file.manifest(), MapPart::kPhotons);
  const render::SettingTexts here = texts_of(job.settings, MapPart::kPhotons);
  const auto shown = [](const render::SettingTexts& settings, const std::string& name) -> std::string {
    for (const auto& [n, texts] : settings)
      if (n == name) return fmt::format("{}", fmt::join(texts, " "));
    return "unset";
  };
  for (const render::SettingTexts* settings : {&there, &here})
    for (const auto& [name, texts] : *settings)
      if (shown(there, name) != shown(here, name))
        refuse(fmt::format("{}: its photons were shot with --{} {}, not {}", file.path(), name,
                           shown(there, name), shown(here, name)));
}

// The estimators must read the kinds of photons that the file has.
void check_kinds(const render::MapFile& file, const Job& job) {
  const render::MapManifest& manifest = file.manifest();
  const photon::TraceSettings here = traced(job);
  if (names_of(here.kinds) != names_of(manifest.kinds))
    refuse(fmt::format("{}: it holds {} photons, but the estimators read {} photons", file.path(),
                       names_of(manifest.kinds), names_of(here.kinds)));
  if (here.under_glossy != manifest.under_glossy ||
      here.shadow_behind_specular != manifest.shadow_behind_specular)
    refuse(fmt::format("{}: its photons were shot for other estimators", file.path()));
}

// The estimators on which r0 depends.
std::string estimators_of(const Job& job) {
  const render::EstimatorPlan plan = render::make_plan(job.settings.render, job.scene.needs);
  return fmt::format("{} {}", render::name_of(plan.direct), render::name_of(plan.indirect));
}

// r0 that was chosen from the photons holds for the same requests only.
bool radii_are_known(const render::MapFile& file, const Job& job) {
  return file.manifest().estimators == estimators_of(job) &&
         texts_of(file.manifest(), MapPart::kRadii) == texts_of(job.settings, MapPart::kRadii);
}

// Tells cameras apart by some of their rays.
std::string hash_of(const Job& job, std::span<const Camera> views) {
  if (job.settings.render.for_camera == render::ForCamera::kAll) return "all";
  if (views.empty()) views = {&job.scene.camera, 1};
  ContentHash hash;
  for (const Camera& camera : views) {
    for (const glm::vec2 at : {glm::vec2(0, 0), glm::vec2(0.5f, 0.5f), glm::vec2(1, 0.25f)}) {
      const Ray ray = camera.generate_ray({at.x * float(camera.width), at.y * float(camera.height)});
      hash.add(&ray.o, sizeof ray.o);
      hash.add(&ray.d, sizeof ray.d);
    }
    for (const int side : {camera.width, camera.height}) hash.add(&side, sizeof side);
  }
  return hash.text();
}

void check_file(const render::MapFile& file, const Console& console, const Job& job) {
  if (job.content_hash != file.manifest().scene_hash)
    refuse(fmt::format("{}: its photons were shot in {}, whose contents are not those of {}", file.path(),
                       file.manifest().scene_path, job.path));
  check_settings(file, job);
  check_kinds(file, job);
  console.note(fmt::format("{}: {}", file.path(), counted(file.photons(), "photon")));
}

render::MapManifest manifest_of(const Job& job, std::span<const Camera> views) {
  render::MapManifest manifest;
  manifest.build = program_build();
  manifest.isa = instruction_set();
  manifest.scene_path = absolute_path(job.path);
  manifest.scene_hash = job.content_hash;
  manifest.settings =
      setting_texts(job.settings, [](const Setting& s) { return s.map_part != MapPart::kNone; });
  manifest.cameras = hash_of(job, views);
  manifest.estimators = estimators_of(job);
  const photon::TraceSettings trace = traced(job);
  manifest.kinds = trace.kinds;
  manifest.under_glossy = trace.under_glossy;
  manifest.shadow_behind_specular = trace.shadow_behind_specular;
  return manifest;
}

}  // namespace

render::MapFile open_map_file(const std::string& path) {
  try {
    render::MapFile file(path);
    check_program(file.manifest().build, file.manifest().isa, path, "their photons would differ");
    return file;
  } catch (const render::MapFileError& error) {
    refuse(error.what());
  }
}

SettingOverrides with_settings_of(const render::MapFile& file, const SettingOverrides& given) {
  const bool own_estimators = std::ranges::any_of(settings_table(), [&](const Setting& s) {
    return s.map_part == MapPart::kEstimators && given.sets(s.name);
  });
  SettingOverrides overrides = overrides_from(texts_of(file.manifest(), MapPart::kPhotons), file.path());
  if (!own_estimators)
    overrides.append(overrides_from(texts_of(file.manifest(), MapPart::kEstimators), file.path()));
  overrides.append(given);
  return overrides;
}

void check_stop_rules(const KeptMaps& kept, const StopSettings& stop) {
  if (kept.any() && stop.any())
    refuse(
        "--time and --target-error shoot further photons in each pass, but kept photon maps hold one pass");
}

void settle_kept_maps(const KeptMaps& kept, const Console& console, Job* job) {
  if (!kept.any()) return;
  render::RenderSettings& settings = job->settings.render;
  if (settings.passes > 1)
    refuse(fmt::format("kept photon maps hold one pass, but the settings ask for {}", settings.passes));
  if (!render::needs_photons(settings, job->scene.needs))
    refuse(fmt::format("there are no photons to keep: {}",
                       render::make_plan(settings, job->scene.needs).notes.front()));
  settings.passes = 1;
  if (!kept.save.empty()) check_utf8({job->path});
  if (!kept.from) return;
  settings.photon_memory = std::numeric_limits<uint64_t>::max();  // the photons stay in the file
  check_file(*kept.from, console, *job);
}

void note_cameras(const KeptMaps& kept, const Job& job, std::span<const Camera> views, bool writes_sums,
                  const Console& console) {
  if (!kept.from || kept.photons || kept.from->manifest().cameras == hash_of(job, views)) return;
  const std::string& path = kept.from->path();
  if (writes_sums)
    refuse(
        fmt::format("{} was shot for other cameras: partial results would not belong to those of other "
                    "passes",
                    path));
  console.note(
      fmt::format("{} was shot for another camera, which decided where photons are dense{}; "
                  "--for-camera all shoots for any camera",
                  path, radii_are_known(*kept.from, job) ? " and how far they are gathered" : ""));
}

void make_photons(const KeptMaps& kept, const Job& job, const accel::Bvh& bvh, std::span<const Camera> views,
                  const render::ProgressCallback& progress, std::shared_ptr<render::FirstPhotons>* photons) {
  const render::RenderSettings& settings = job.settings.render;
  const render::EstimatorPlan plan = render::make_plan(settings, job.scene.needs);
  const render::RenderInput input{job.scene, bvh, settings, plan, views};
  const auto explored = kept.explored ? kept.explored : std::make_shared<render::ExploredScene>();
  *photons =
      std::make_shared<render::FirstPhotons>(render::PassPhotons(explored), render::RenderStatistics());
  render::FirstPhotons& first = **photons;
  if (kept.photons)
    first.photons.adopt(input, render::KeptPhotons(*kept.photons), true, &first.statistics);
  else if (kept.from)
    first.photons.adopt(input, kept.from->open(), radii_are_known(*kept.from, job), &first.statistics);
  else
    first = render::shoot_first(input, progress, explored);
  if (kept.save.empty() || kept.photons || !first.photons.radii()) return;
  render::write_map_file(kept.save, manifest_of(job, views), first.photons.keep(first.statistics));
}

struct MapCheck::Work {
  const render::MapFile& file;
  tbb::task_group group{};
};

MapCheck::MapCheck(const render::MapFile& file) : work_(new Work{file}) {
  work_->group.run([work = work_.get()] { work->file.check_columns(); });
}

MapCheck::~MapCheck() {
  work_->group.cancel();
  try {
    work_->group.wait();
  } catch (const std::exception&) {  // nobody asked for the result
  }
}

void MapCheck::finish() {
  work_->group.wait();
}

}  // namespace kaustik::app
