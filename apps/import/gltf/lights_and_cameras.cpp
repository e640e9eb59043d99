#include "apps/import/gltf/lights_and_cameras.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "apps/import/common/make_parameter.h"
#include "core/scene/schema/schema.h"

namespace kaustik::gltf {
namespace {

constexpr double kHeight = 720;  // pixels

bool renders_camera(std::string_view type) {
  const auto& types = category("Camera").types;
  return std::any_of(types.begin(), types.end(), [&](const TypeSpec* t) { return t->name == type; });
}

void add_film(double aspect, const SourceLocation& where, SceneDescription& scene) {
  DirectiveMaker<Directive> film("rgb", where);
  const double width = std::clamp(std::round(kHeight * aspect), 1.0, 65535.0);
  scene.film = *film.integer("xresolution", width).integer("yresolution", kHeight);
}

void add_perspective(const View& camera, DirectiveMaker<CameraDescription>& out, const SourceLocation& where,
                     SceneDescription& scene) {
  const View perspective = camera["perspective"];
  const double yfov = perspective["yfov"].number();
  if (!(yfov > 0 && yfov < std::numbers::pi))
    perspective["yfov"].fail(fmt::format("is {}: it must lie between 0 and pi", yfov));
  const double aspect = perspective["aspectRatio"].number(16.0 / 9);
  if (!(aspect > 0)) perspective["aspectRatio"].fail("must be above 0");
  // pbrt's `fov` is the angle of the image's shorter side.
  const double fov = aspect >= 1 ? yfov : 2 * std::atan(aspect * std::tan(yfov / 2));
  out.number("fov", glm::degrees(fov));
  add_film(aspect, where, scene);
}

void add_orthographic(const View& camera, DirectiveMaker<CameraDescription>& out, const SourceLocation& where,
                      SceneDescription& scene) {
  const View o = camera["orthographic"];
  const double x = o["xmag"].number(), y = o["ymag"].number();
  if (!(x > 0 && y > 0)) o.fail("has no size");
  out.add(ParameterType::kFloat, "screenwindow", {-x, x, -y, y});
  add_film(x / y, where, scene);
}

// Watts per steradian, or per square metre for directional lights, of a light's `intensity`.
double radiant(double intensity, bool distant, LightUnit unit) {
  constexpr double kLumenPerWatt = 683;  // of light of 555 nm, as Blender and others count all light
  if (unit == LightUnit::kPhotometric) return intensity / kLumenPerWatt;
  return distant ? intensity : intensity / (4 * std::numbers::pi);
}

void note_unit(LightUnit unit, SceneDescription& scene) {
  if (!scene.lights.empty()) return;
  scene.notes.emplace_back(unit == LightUnit::kPhotometric
                               ? "the file's lights are read as candela and lux, 683 lm to the watt "
                                 "(--light-unit watt reads watts)"
                               : "the file's lights are read as watts (--light-unit watt)");
}

struct Aim {
  double inner, outer;  // degrees from the axis
};

Aim aim_of(const View& spot) {
  const double outer =
      std::clamp(spot["outerConeAngle"].number(std::numbers::pi / 4), 1e-4, std::numbers::pi / 2);
  const double inner = std::clamp(spot["innerConeAngle"].number(0), 0.0, outer);
  return {glm::degrees(inner), glm::degrees(outer)};
}

}  // namespace

void add_camera(const View& camera, const glm::dmat4& to_world, FileWarnings& warnings,
                SceneDescription& scene) {
  const std::string type = camera["type"].text();
  if (type != "perspective" && type != "orthographic") camera["type"].fail("is not a camera type of glTF");
  if (!renders_camera(type)) {
    warnings.say(fmt::format("cameras of type {} are ignored", type));
    return;
  }
  DirectiveMaker<CameraDescription> out(type, warnings.where());
  if (type == "perspective") {
    add_perspective(camera, out, warnings.where(), scene);
  } else {
    add_orthographic(camera, out, warnings.where(), scene);
  }
  glm::dmat4 turned(1);
  turned[2][2] = -1;
  out->camera_to_world = to_world * turned;
  scene.camera = std::move(*out);
}

void add_light(const Document& document, const View& node, const glm::dmat4& to_world, LightUnit unit,
               FileWarnings& warnings, SceneDescription& scene) {
  const View lights = document.root()["extensions"]["KHR_lights_punctual"]["lights"];
  const auto index = node["extensions"]["KHR_lights_punctual"]["light"].index(lights.size());
  if (!index) return;
  const View light = lights.at(*index);
  const std::string type = light["type"].text();
  const std::vector<double> c = light["color"].numbers(3, {1, 1, 1});
  const double intensity = light["intensity"].number(1);
  if (!(intensity >= 0)) light["intensity"].fail("is negative");
  if (light.has("range"))
    warnings.say("the `range` of lights is ignored: light falls off with the square of the distance");
  const bool distant = type == "directional";
  if (!distant && type != "point" && type != "spot")
    light["type"].fail("is not a light type of KHR_lights_punctual");
  note_unit(unit, scene);
  const glm::dvec3 colour = radiant(intensity, distant, unit) * glm::max(glm::dvec3(c[0], c[1], c[2]), 0.0);
  DirectiveMaker<LightDescription> out(distant ? "distant" : type, warnings.where());
  out.rgb(distant ? "L" : "I", colour);
  if (type != "point")
    out.add(ParameterType::kPoint3, "from", {0, 0, 0}).add(ParameterType::kPoint3, "to", {0, 0, -1});
  if (type == "spot") {
    const Aim aim = aim_of(light["spot"]);
    out.number("coneangle", aim.outer).number("conedeltaangle", aim.outer - aim.inner);
  }
  out->light_to_world = to_world;
  scene.lights.push_back(std::move(*out));
}

}  // namespace kaustik::gltf
