// The rows of lights: parameters, and how each is made from them.

#include <fmt/format.h>

#include "core/scene/parameter_spec.h"

namespace kaustik {
namespace {

using namespace spec;

ParameterSpec scale() {
  return number("scale", 1, "", kNotNegative, "multiplies the light");
}
ParameterSpec power_spec() {
  return without_default(number("power", 0, "W", kPositive,
                                "total power: the colour is scaled until the luminance of its power is this, "
                                "then by `scale`"),
                         "none");
}
ParameterSpec image() {
  return not_rendered("filename", {ParameterType::kString}, "images as lamps are not rendered");
}

// Scales `colour` so that `measure` (luminance of what colour gives) becomes the parameter's value, where
// given.
bool scale_to(const ParameterReader& p, std::string_view name, float measure, Rgb& colour,
              DiagnosticList& diagnostics) {
  if (!p.has(name)) return true;
  if (!(measure > 0)) {
    diagnostics.error(p.location(name), fmt::format("`{}` of a light that emits nothing", name));
    return false;
  }
  colour *= static_cast<float>(p.number(name)) / measure;
  return true;
}

std::optional<glm::dvec3> direction(const ParameterReader& p, const glm::dvec3& d, const glm::dmat4& m,
                                    DiagnosticList& diagnostics) {
  const glm::dvec3 world = glm::dmat3(m) * d;
  const double length = glm::length(world);
  if (length > 0 && std::isfinite(length)) return world / length;
  diagnostics.error(p.location("to"), "`from` and `to` must be two points");
  return std::nullopt;
}

std::optional<Light> make_point(const ParameterReader& p, const glm::dmat4& m, DiagnosticList& diagnostics) {
  PointLight light{Point3(m * glm::dvec4(p.vec3("from"), 1)), p.rgb("I")};
  if (!scale_to(p, "power", luminance(light.power()), light.I, diagnostics)) return std::nullopt;
  light.I *= static_cast<float>(p.number("scale"));
  return light;
}

std::optional<Light> make_spot(const ParameterReader& p, const glm::dmat4& m, DiagnosticList& diagnostics) {
  const auto axis = direction(p, p.vec3("to") - p.vec3("from"), m, diagnostics);
  if (!axis) return std::nullopt;
  const double cone = glm::radians(p.number("coneangle"));
  const double start = std::max(0.0, cone - glm::radians(p.number("conedeltaangle")));
  SpotLight light;
  light.position = Point3(m * glm::dvec4(p.vec3("from"), 1));
  light.frame = Frame::from_z(Vector3(*axis));
  light.I = p.rgb("I");
  light.cos_falloff_start = static_cast<float>(std::cos(start));
  light.cos_total_width = static_cast<float>(std::cos(cone));
  if (!scale_to(p, "power", luminance(light.power()), light.I, diagnostics)) return std::nullopt;
  light.I *= static_cast<float>(p.number("scale"));
  return light;
}

std::optional<Light> make_distant(const ParameterReader& p, const glm::dmat4& m,
                                  DiagnosticList& diagnostics) {
  const auto to_light = direction(p, p.vec3("from") - p.vec3("to"), m, diagnostics);
  if (!to_light) return std::nullopt;
  DistantLight light;
  light.to_light = Vector3(*to_light);
  light.L = p.rgb("L");
  if (!scale_to(p, "illuminance", luminance(light.L), light.L, diagnostics)) return std::nullopt;
  light.L *= static_cast<float>(p.number("scale"));
  return light;
}

std::optional<Light> make_infinite(const ParameterReader& p, const glm::dmat4&, DiagnosticList& diagnostics) {
  InfiniteLight light;
  light.L = p.rgb("L");
  if (!scale_to(p, "illuminance", kPi * luminance(light.L), light.L, diagnostics)) return std::nullopt;
  light.L *= static_cast<float>(p.number("scale"));
  return light;
}

ParameterSpec illuminance(std::string_view doc) {
  return without_default(number("illuminance", 0, "W/m^2", kPositive, doc), "none");
}

std::vector<LightRow> make_light_rows() {
  const ParameterSpec intensity = rgb("I", 1, "W/sr", kNotNegative, "radiant intensity");
  const ParameterSpec from = point("from", {0, 0, 0}, "where it stands");
  const ParameterSpec to = point("to", {0, 0, 1}, "where it points");
  return {
      {{"point", "Shines alike in all directions.", {intensity, scale(), power_spec(), from}}, make_point},
      {{"spot",
        "Shines in a cone; falls off smoothly over its last `conedeltaangle` degrees.",
        {intensity, scale(), power_spec(), from, to,
         number("coneangle", 30, "degrees", {0, 180, true, false}, "from the axis to the cone's edge"),
         number("conedeltaangle", 5, "degrees", {0, 180}, "width of the fall-off inside that edge")}},
       make_spot},
      {{"distant",
        "Parallel light from `from` towards `to`.",
        {rgb("L", 1, "W/m^2", kNotNegative, "irradiance on a plane that faces it"), scale(),
         illuminance("luminance of that irradiance: `L` is scaled to it, then by `scale`"), from, to}},
       make_distant},
      {{"infinite",
        "The same radiance from every direction.",
        {rgb("L", 1, "W/(m^2 sr)", kNotNegative, "radiance"), scale(),
         illuminance("luminance of the irradiance of a plane that sees half of it: `L` is scaled to it, then "
                     "by `scale`"),
         image(), ignored("portal", {ParameterType::kPoint3}, "a hint for sampling")}},
       make_infinite},
  };
}

std::vector<TypeSpec> make_area_light_types() {
  return {{"diffuse",
           "Makes the shapes that follow emit the same radiance in all directions, on their outside.",
           {rgb("L", 1, "W/(m^2 sr)", kNotNegative, "radiance"), scale(), power_spec(),
            flag("twosided", false, "emits on both sides"), image()}}};
}

}  // namespace

const std::vector<LightRow>& light_rows() {
  static const std::vector<LightRow> rows = make_light_rows();
  return rows;
}

const std::vector<TypeSpec>& area_light_types() {
  static const std::vector<TypeSpec> types = make_area_light_types();
  return types;
}

}  // namespace kaustik
