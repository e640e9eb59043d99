// kaustik info: shows the contents of a scene file.

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "apps/commands/commands.h"
#include "apps/machine/thread_limit.h"
#include "apps/session/files/scene_loading.h"
#include "render/renderer.h"
#include "render/settings/names.h"
#include "render/statistics_json.h"

namespace kaustik::app {

namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
  std::string scene;
  SettingOverrides overrides;
  bool json = false;
};

Json triple(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

glm::dvec3 in_world(const Scene& scene, const Point3& p) {
  return scene.origin + glm::dvec3(p);
}

std::string_view type_name(const Material& material) {
  return material.mixed() ? "mix" : name_of(material.typical());
}

// How many shapes use each material or surface group, by index.
template <class Field>
std::vector<uint64_t> uses_of(const Scene& scene, size_t size, Field Shape::*field) {
  std::vector<uint64_t> uses(size, 0);
  for (const Shape& shape : scene.shapes) {
    if (shape.*field < size) ++uses[shape.*field];
  }
  return uses;
}

Json shapes_json(const Scene& scene) {
  std::map<std::string, std::pair<uint64_t, uint64_t>> counts;  // shapes and primitives by type
  for (const Shape& shape : scene.shapes) {
    auto& [shapes, primitives] = counts[std::string(name_of(shape))];
    ++shapes;
    primitives += primitive_count(shape);
  }
  Json out = Json::array();
  for (const auto& [type, count] : counts) {
    out.push_back({{"type", type}, {"shapes", count.first}, {"primitives", count.second}});
  }
  return out;
}

Json materials_json(const Scene& scene) {
  const std::vector<uint64_t> uses = uses_of(scene, scene.materials.size(), &Shape::material);
  Json out = Json::array();
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const std::string name = i < scene.material_names.size() ? scene.material_names[i] : std::string();
    const Material& material = scene.materials[i];
    out.push_back(
        {{"name", name},
         {"type", type_name(material)},
         {"albedo", material.has_textured_bsdf() ? Json(nullptr) : triple(albedo(material.typical()))},
         {"disperses", material.is_dispersive()},
         {"shapes", uses[i]}});
  }
  return out;
}

Json lights_json(const Scene& scene) {
  Json out = Json::array();
  for (const Light& light : scene.lights)
    out.push_back({{"type", name_of(light)}, {"power", triple(power(light))}});
  return out;
}

std::string density_text(const DensityGrid& grid) {
  const glm::ivec3& points = grid.points();
  return fmt::format(", times densities up to {:.3g} on a grid of {} x {} x {} points", grid.largest(),
                     points.x, points.y, points.z);
}

// The vacuum is left out.
Json media_json(const Scene& scene) {
  Json out = Json::array();
  for (size_t i = 1; i < scene.media.size(); ++i) {
    const Medium& medium = scene.media[i];
    Json& of_medium = out.emplace_back(Json{{"name", scene.medium_names[i]},
                                            {"sigma_a", triple(medium.sigma_a)},
                                            {"sigma_s", triple(medium.sigma_s)},
                                            {"g", medium.g},
                                            {"Le", triple(medium.Le)}});
    if (!medium.density) continue;
    const glm::ivec3& points = medium.density->points();
    of_medium["grid"] = {points.x, points.y, points.z};
    of_medium["largest_density"] = medium.density->largest();
  }
  return out;
}

Json groups_json(const Scene& scene) {
  const std::vector<uint64_t> uses = uses_of(scene, scene.surface_group_names.size(), &Shape::surface_group);
  Json out = Json::array();
  for (size_t i = 0; i < uses.size(); ++i)
    out.push_back({{"name", scene.surface_group_names[i]}, {"shapes", uses[i]}});
  return out;
}

Json info_json(const std::string& path, const Job& job) {
  const Scene& scene = job.scene;
  const render::EstimatorPlan plan = render::make_plan(job.settings.render, scene.needs);
  Json out;
  out["scene"] = path;
  out["image"] = {
      {"width", scene.camera.width}, {"height", scene.camera.height}, {"spp", job.settings.render.spp}};
  out["shapes"] = shapes_json(scene);
  out["bounds"] = {{"min", triple(in_world(scene, scene.bounds.min))},
                   {"max", triple(in_world(scene, scene.bounds.max))}};
  out["origin"] = triple(scene.origin);
  out["materials"] = materials_json(scene);
  out["lights"] = lights_json(scene);
  out["media"] = media_json(scene);
  out["interfaces"] = scene.interfaces ? scene.interfaces->shapes.size() : 0;
  out["surface_groups"] = groups_json(scene);
  out["needs"] = render::needs_json(scene.needs);
  out["plan"] = {{"direct", render::name_of(plan.direct)},
                 {"caustics", render::name_of(plan.caustics)},
                 {"indirect", render::name_of(plan.indirect)},
                 {"notes", plan.notes}};
  return out;
}

std::string triple_text(const glm::dvec3& v, int digits = 5) {
  return fmt::format("({:.{}g}, {:.{}g}, {:.{}g})", v.x, digits, v.y, digits, v.z, digits);
}

std::string emission_text(const Medium& medium) {
  return medium.emits() ? fmt::format(", emits {} W/(m^2 sr)", triple_text(medium.Le)) : "";
}

std::string albedo_text(const Material& material) {
  if (material.has_textured_bsdf()) return "with textures";
  return "albedo " + triple_text(albedo(material.typical()));
}

std::string bounds_text(const Scene& scene) {
  const bool far = scene.origin != glm::dvec3(0);
  const int digits = far ? 12 : 5;
  std::string text =
      fmt::format("bounds     {} to {} m\n", triple_text(in_world(scene, scene.bounds.min), digits),
                  triple_text(in_world(scene, scene.bounds.max), digits));
  if (far)
    text += fmt::format(
        "origin     {} m: the scene is far from the world's origin and is rendered relative to this point\n",
        triple_text(scene.origin, digits));
  return text;
}

std::string info_text(const std::string& path, const Job& job) {
  const Scene& scene = job.scene;
  std::string text =
      fmt::format("{}: {}\nimage      {} x {}, {} samples per pixel\n", path, scene_summary(scene),
                  scene.camera.width, scene.camera.height, job.settings.render.spp);
  for (const Json& s : shapes_json(scene)) {
    text += fmt::format("shape      {} x {}, {}\n", s["shapes"].get<uint64_t>(), s["type"].get<std::string>(),
                        counted(s["primitives"].get<uint64_t>(), "primitive"));
  }
  text += bounds_text(scene);
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const std::string name = i < scene.material_names.size() ? scene.material_names[i] : std::string();
    text += fmt::format("material   {}: {}, {}{}\n", name.empty() ? fmt::format("#{}", i) : name,
                        type_name(scene.materials[i]), albedo_text(scene.materials[i]),
                        scene.materials[i].is_dispersive() ? ", disperses" : "");
  }
  for (const Light& light : scene.lights) {
    text += fmt::format("light      {}, power {} W\n", name_of(light), triple_text(power(light)));
  }
  for (size_t i = 1; i < scene.media.size(); ++i) {
    const Medium& medium = scene.media[i];
    text += fmt::format("medium     {}: absorbs {}, scatters {} 1/m, g {:.3g}{}{}\n", scene.medium_names[i],
                        triple_text(medium.sigma_a), triple_text(medium.sigma_s), medium.g,
                        emission_text(medium), medium.density ? density_text(*medium.density) : "");
  }
  if (scene.interfaces)
    text += fmt::format("interface  {}, which only separate media\n",
                        counted(scene.interfaces->shapes.size(), "shape"));
  for (const Json& g : groups_json(scene)) {
    const uint64_t shapes = g["shapes"].get<uint64_t>();
    text += fmt::format("surface    {}: {}{}\n", g["name"].get<std::string>(), counted(shapes, "shape"),
                        shapes > 1 ? " that share their photons" : "");
  }
  for (const std::string& line : scene.needs.left_out()) text += fmt::format("left out   {}\n", line);
  for (const std::string& note : render::make_plan(job.settings.render, scene.needs).notes) {
    text += fmt::format("plan       {}\n", note);
  }
  return text;
}

int run_info(const InfoOptions& options, const Console& console) {
  Console quiet = console;
  quiet.quiet = true;  // the report contains what the log would say
  Job job;
  with_thread_limit(0, console,
                    [&] { job = load_job(options.scene, options.overrides, quiet, LoadFor::kDescription); });
  if (options.json) {
    console.out << info_json(options.scene, job).dump(2) << '\n';
  } else {
    console.out << info_text(options.scene, job);
  }
  return kDone;
}

}  // namespace

Command make_info_command() {
  Command command("info", "Show the contents of a scene and which estimators it needs");
  const auto options = std::make_shared<InfoOptions>();
  command.add_argument("SCENE", options->scene, "Scene file");
  command.add_flag("--json", options->json, "Print JSON");
  add_setting_options(command, options->overrides, SettingsCommand::kInfo);
  command.run = [options](const Console& console) { return run_info(*options, console); };
  return command;
}

}  // namespace kaustik::app
