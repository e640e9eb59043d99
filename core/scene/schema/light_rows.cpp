// Schema rows of lights: their parameters, and how each light is made from them.

#include <fmt/format.h>

#include <array>

#include "core/math/transform.h"
#include "core/scene/schema/light_images.h"
#include "core/scene/schema/parameter_spec.h"

namespace kaustik {
namespace {

using namespace spec;

ParameterSpec scale() {
  return number("scale", 1, "", kNotNegative, "factor on the emission");
}
ParameterSpec power_spec() {
  return without_default(
      number("power", 0, "W", kPositive,
             "total power of a white light; the luminance of a coloured light's power is this "
             "value times the luminance of its colour, as in pbrt. `scale` is a further factor"),
      "none");
}
ParameterSpec image(std::string_view doc) {
  return text("filename", "none", doc);
}

bool is_dark(const Rgb& emission) {
  return is_black(emission);
}
bool is_dark(float scale) {
  return scale == 0;
}

// Applies two parameters to `emission`, as pbrt does: if `name` is given, scales by its value over
// `of_white`, the luminance that an emission of one causes (so coloured lights are scaled like white ones);
// then scales by `scale`. Returns false, with an error, if there is nothing to scale.
template <class Emission>
bool scale_to(const LightInputs& in, std::string_view name, double of_white, Emission& emission) {
  const ParameterReader& p = in.parameters;
  if (p.has(name)) {
    if (!(of_white > 0) || is_dark(emission)) {
      in.diagnostics.error(p.location(name),
                           fmt::format("`{}` is given for a light that emits nothing", name));
      return false;
    }
    emission *= static_cast<float>(p.number(name)) / static_cast<float>(of_white);
  }
  emission *= static_cast<float>(p.number("scale"));
  return true;
}

// Luminance of the power of a light whose intensity I is one.
template <class L>
double white_power(L light) {
  light.I = Rgb(1);
  return double(luminance(light.power()));
}

bool has_image(const LightInputs& in) {
  if (in.parameters.has("filename")) return true;
  in.diagnostics.error(
      in.parameters.directive().location,
      fmt::format("light \"{}\" needs an image: \"string filename\"", in.parameters.directive().type));
  return false;
}

glm::dmat4 to_scene(const LightInputs& in) {
  return relative_to(in.origin, in.light_to_world);
}

// A place of the light's space in the scene. Nothing, with an error, if it is not finite there.
std::optional<Point3> position(const LightInputs& in, const glm::dvec3& place) {
  const Point3 p(to_scene(in) * glm::dvec4(place, 1));
  if (is_finite(p)) return p;
  in.diagnostics.error(in.parameters.directive().location,
                       "the transform takes this light beyond the range of floats");
  return std::nullopt;
}

std::optional<glm::dvec3> direction(const LightInputs& in, const glm::dvec3& d) {
  const glm::dvec3 world = glm::dmat3(in.light_to_world) * d;
  const double length = glm::length(world);
  if (length > 0 && std::isfinite(length)) return world / length;
  in.diagnostics.error(in.parameters.location("to"), "`from` and `to` must be two points");
  return std::nullopt;
}

// The orthogonal part of a map, with a warning unless it scales uniformly up to the rounding of numbers in a
// scene file.
std::optional<glm::mat3> rotation(const LightInputs& in) {
  constexpr double kTolerance = 1e-3;
  const glm::dmat3 m(in.light_to_world);
  const glm::dvec3 x = glm::normalize(m[0]), y = glm::normalize(m[1] - glm::dot(m[1], x) * x);
  const double side = glm::dot(glm::cross(x, y), m[2]) < 0 ? -1 : 1;
  const glm::dmat3 orthogonal(x, y, side * glm::cross(x, y));
  const double size = glm::length(m[0]);
  for (int c = 0; c < 3; ++c) {
    if (glm::length(m[c] - size * orthogonal[c]) <= kTolerance * size) continue;
    in.diagnostics.warning(
        in.parameters.directive().location,
        "the transform of this light scales non-uniformly or shears: only its rotation counts");
    break;
  }
  return glm::mat3(orthogonal);
}

std::optional<Light> make_point(const LightInputs& in) {
  const ParameterReader& p = in.parameters;
  const auto from = position(in, p.vec3("from"));
  if (!from) return std::nullopt;
  PointLight light{*from, p.rgb("I")};
  if (!scale_to(in, "power", white_power(light), light.I)) return std::nullopt;
  return light;
}

std::optional<Light> make_spot(const LightInputs& in) {
  const ParameterReader& p = in.parameters;
  const auto axis = direction(in, p.vec3("to") - p.vec3("from"));
  const auto from = position(in, p.vec3("from"));
  if (!axis || !from) return std::nullopt;
  const double cone = glm::radians(p.number("coneangle"));
  const double start = std::max(0.0, cone - glm::radians(p.number("conedeltaangle")));
  SpotLight light;
  light.position = *from;
  light.frame = Frame::from_z(Vector3(*axis));
  light.I = p.rgb("I");
  light.cos_falloff_start = static_cast<float>(std::cos(start));
  light.cos_total_width = static_cast<float>(std::cos(cone));
  if (!scale_to(in, "power", white_power(light), light.I)) return std::nullopt;
  return light;
}

std::optional<Light> make_goniometric(const LightInputs& in) {
  const ParameterReader& p = in.parameters;
  const auto map_to_world = rotation(in);
  const auto centre = position(in, {0, 0, 0});
  if (!has_image(in) || !map_to_world || !centre) return std::nullopt;
  GoniometricLight light;
  light.map = in.images.directions(p, "filename", LightImages::Around::kLight);
  if (!light.map) return std::nullopt;
  light.position = *centre;
  // As in pbrt, +z of the map is +y of the light.
  light.to_world = *map_to_world * glm::mat3(1, 0, 0, 0, 0, 1, 0, 1, 0);
  light.I = p.rgb("I");
  if (!scale_to(in, "power", white_power(light), light.I)) return std::nullopt;
  return light;
}

std::optional<Light> make_projection(const LightInputs& in) {
  const ParameterReader& p = in.parameters;
  const auto axes = rotation(in);
  const auto centre = position(in, {0, 0, 0});
  if (!has_image(in) || !axes || !centre) return std::nullopt;
  const auto image = in.images.get(p, "filename");
  if (!image) return std::nullopt;
  ProjectionLight light;
  light.position = *centre;
  light.to_world = *axes;
  light.image = std::make_shared<const ProjectedImage>(image, p.number("fov"));
  if (!scale_to(in, "power", luminance(light.power()), light.scale)) return std::nullopt;
  return light;
}

std::optional<Light> make_distant(const LightInputs& in) {
  const ParameterReader& p = in.parameters;
  const auto to_light = direction(in, p.vec3("from") - p.vec3("to"));
  if (!to_light) return std::nullopt;
  DistantLight light;
  light.to_light = Vector3(*to_light);
  light.L = p.rgb("L");
  if (!scale_to(in, "illuminance", 1, light.L)) return std::nullopt;
  return light;
}

// Whether the points are the corners of a rectangle, in order, with pbrt's tolerance.
bool is_rectangle(const std::array<glm::dvec3, 4>& p) {
  constexpr double kTolerance = 1e-3;
  const glm::dvec3 a = p[1] - p[0], b = p[3] - p[0], beyond = p[2] - (p[0] + a + b);
  const double la = glm::length(a), lb = glm::length(b);
  return la > 0 && lb > 0 && std::isfinite(la * lb) && glm::length(beyond) <= kTolerance * std::min(la, lb) &&
         std::abs(glm::dot(a, b)) <= kTolerance * la * lb;
}

// Whether the light shines through a portal. Where the points are no rectangle the whole sky shines, with a
// warning: a portal says only which part of it is seen.
bool has_portal(const LightInputs& in) {
  if (!in.parameters.has("portal")) return false;
  std::array<glm::dvec3, 4> corner;
  for (size_t i = 0; i < 4; ++i) corner[i] = in.parameters.vec3("portal", i);
  if (is_rectangle(corner)) return true;
  in.diagnostics.warning(in.parameters.location("portal"),
                         "`portal` must be the four corners of a rectangle, in order: it is ignored");
  return false;
}

// Makes an infinite light with a portal. As in pbrt, the corners are in world space whatever the light's
// transform, which only turns the sky. make_sky: makes the sky from the map that takes directions of the
// portal to those of the light. irradiance: the luminance of the whole sky's irradiance on a plane that faces
// the light's +z.
template <class MakeSky>
std::optional<Light> make_portal(const LightInputs& in, double irradiance, const MakeSky& make_sky) {
  const ParameterReader& p = in.parameters;
  std::array<glm::dvec3, 4> corner;
  for (size_t i = 0; i < 4; ++i) corner[i] = p.vec3("portal", i);
  const auto light_to_world = rotation(in);
  if (!light_to_world) return std::nullopt;
  PortalInfiniteLight light;
  light.corner = Point3(corner[0] - in.origin);
  light.along_x = Vector3(corner[3] - corner[0]);
  light.along_y = Vector3(corner[1] - corner[0]);
  const glm::dvec3 x = glm::normalize(corner[3] - corner[0]);
  const glm::dvec3 z = glm::normalize(glm::cross(x, corner[1] - corner[0]));
  light.to_world = glm::mat3(glm::dmat3(x, glm::cross(z, x), z));
  light.sky = make_sky(glm::transpose(*light_to_world) * light.to_world);
  if (!scale_to(in, "illuminance", irradiance, light.scale)) return std::nullopt;
  return light;
}

// As in pbrt-v3, `L` scales the image; the image takes its colour, so that the light needs no more than a
// number.
std::optional<Light> make_image_infinite(const LightInputs& in) {
  const ParameterReader& p = in.parameters;
  const auto map_to_world = rotation(in);
  ImageInfiniteLight light;
  light.map = in.images.directions(p, "filename", LightImages::Around::kSky, p.rgb("L"));
  if (!light.map || !map_to_world) return std::nullopt;
  if (has_portal(in)) {
    return make_portal(in, light.map->irradiance(), [&](const glm::mat3& to_map) {
      return std::make_shared<const PortalSky>(*light.map, to_map);
    });
  }
  light.to_world = *map_to_world;
  if (!scale_to(in, "illuminance", light.map->irradiance(), light.scale)) return std::nullopt;
  return light;
}

std::optional<Light> make_infinite(const LightInputs& in) {
  const ParameterReader& p = in.parameters;
  if (p.has("filename")) return make_image_infinite(in);
  InfiniteLight light;
  light.L = p.rgb("L");
  if (has_portal(in)) {
    return make_portal(in, double(kPi * luminance(light.L)),
                       [&](const glm::mat3&) { return std::make_shared<const PortalSky>(light.L); });
  }
  if (!scale_to(in, "illuminance", double(kPi), light.L)) return std::nullopt;
  return light;
}

ParameterSpec illuminance(std::string_view doc) {
  return without_default(number("illuminance", 0, "W/m^2", kPositive, doc), "none");
}

ParameterSpec portal() {
  ParameterSpec p = list(ParameterType::kPoint3, "portal", 4, "none", "m",
                         "corners, in world space, of a rectangle through which all light enters; the sky is "
                         "on the side of cross(p3 - p0, p1 - p0)");
  p.max_items = 4;
  return p;
}

std::vector<LightRow> make_light_rows() {
  const ParameterSpec intensity = rgb("I", 1, "W/sr", kNotNegative, "radiant intensity");
  const ParameterSpec from = point("from", {0, 0, 0}, "position");
  const ParameterSpec to = point("to", {0, 0, 1}, "point that the light is aimed at");
  return {
      {{"point", "Emits equally in all directions.", {intensity, scale(), power_spec(), from}}, make_point},
      {{"spot",
        "Emits into a cone, with a smooth falloff over the last `conedeltaangle` degrees.",
        {intensity, scale(), power_spec(), from, to,
         number("coneangle", 30, "degrees", {0, 180, true, false},
                "angle from the axis to the edge of the cone"),
         number("conedeltaangle", 5, "degrees", {0, 180}, "width of the falloff inside the edge")}},
       make_spot},
      {{"goniometric",
        "A point light whose intensity in each direction is given by an image; the image's +z is the light's "
        "+y.",
        {intensity, scale(), power_spec(),
         image("factor on `I`, the mean of R, G and B: a square equal-area map, or a 2:1 latitude-longitude "
               "map "
               "(not in pbrt-v4)")}},
       make_goniometric},
      {{"projection",
        "A projector: emits from a point along +z through an image whose upper edge is towards +y.",
        {scale(), power_spec(), image("radiant intensity, R G B"),
         number("fov", 90, "degrees", {0, 180, true, true}, "full angle of the image's shorter side")}},
       make_projection},
      {{"distant",
        "Parallel light from `from` towards `to`.",
        {rgb("L", 1, "W/m^2", kNotNegative, "irradiance on a plane facing the light"), scale(),
         illuminance("irradiance of a white light; `L` and `scale` are factors on it"), from, to}},
       make_distant},
      {{"infinite",
        "Radiance from every direction: constant, or given by an image.",
        {rgb("L", 1, "W/(m^2 sr)", kNotNegative, "radiance, or the factor on an image (in pbrt-v3 only)"),
         scale(),
         illuminance(
             "irradiance on a plane facing the light's +z: for a constant light that of white light, with "
             "`L` and `scale` as factors; for images and portals its luminance, with `scale` as a factor"),
         image("radiance: a square equal-area map as in pbrt-v4, or a 2:1 latitude-longitude map as in "
               "pbrt-v3, both around +z"),
         portal()}},
       make_infinite},
  };
}

std::vector<TypeSpec> make_area_light_types() {
  return {{"diffuse",
           "Makes the shapes that follow emit the same radiance in all directions on their outside. A "
           "shape whose `alpha` is 0 everywhere emits light, but rays do not hit it.",
           {rgb("L", 1, "W/(m^2 sr)", kNotNegative, "radiance, or the factor on an image (not in pbrt)"),
            scale(), power_spec(), flag("twosided", false, "emits on both sides"),
            text("filename", "none",
                 "radiance, times `L`: an image over the uv of the shape, (0, 0) its lower left corner; "
                 "interpolated bilinearly and clamped at the edges")}}};
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
