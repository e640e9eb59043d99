// Schema rows of participating media.

#include "core/scene/schema/parameter_spec.h"

namespace kaustik {
namespace {

using namespace spec;

ParameterSpec coefficient(std::string_view name, const glm::dvec3& value, std::string_view doc) {
  return of_type(ParameterType::kRgb, name, {value.x, value.y, value.z}, "1/m", kNotNegative, doc);
}

ParameterSpec same_everywhere(std::string_view name) {
  return ignored(name, {ParameterType::kFloat}, "`Le` is the same everywhere in a medium");
}

// What media of all types have. sigma_a, sigma_s: the defaults. lescale: the factor on `Le`.
std::vector<ParameterSpec> with_coefficients(const glm::dvec3& sigma_a, const glm::dvec3& sigma_s,
                                             const ParameterSpec& lescale, std::vector<ParameterSpec> more) {
  std::vector<ParameterSpec> all = {
      coefficient("sigma_a", sigma_a, "absorption coefficient"),
      coefficient("sigma_s", sigma_s, "scattering coefficient"),
      number("scale", 1, "", kNotNegative, "factor on both coefficients"),
      text("preset", "none",
           "a measured medium whose coefficients, in 1/mm, are taken instead, with units of the scene for "
           "mm: Apple, Coke, Wholemilk and others that pbrt knows"),
      number("g", 0, "", {-1, 1}, "mean cosine of the angle by which light is deflected"),
      rgb("Le", 0, "W/(m^2 sr)", kNotNegative,
          "radiance that the medium emits where it is too deep to be seen through: each metre adds sigma_a "
          "Le"),
      lescale};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

// Number of points along an axis. A ray visits as many, which limits how long it may take.
ParameterSpec points(std::string_view name) {
  return integer(name, 1, "", {1, 4096}, "number of the grid's points along the axis");
}

ParameterSpec densities() {
  ParameterSpec p = list(ParameterType::kFloat, "density", 1, "required", "",
                         "factors on the coefficients at the points, x changing fastest");
  p.range = kNotNegative;
  return p;
}

std::vector<TypeSpec> make_medium_types() {
  return {
      {"homogeneous", "The same everywhere. It absorbs, scatters and emits light.",
       with_coefficients({0.0011, 0.0024, 0.014}, {2.55, 3.21, 3.77},
                         number("Lescale", 1, "", kNotNegative, "factor on `Le`"), {})},
      {"uniformgrid",
       "A density at each point of a grid, such as that of smoke, interpolated between them. The points are "
       "the centres of equal cells of a box, beyond which there is nothing; the directive's transform places "
       "it.",
       with_coefficients(
           {1, 1, 1}, {1, 1, 1}, same_everywhere("Lescale"),
           {densities(), points("nx"), points("ny"), points("nz"),
            point("p0", {0, 0, 0}, "a corner of the box"), point("p1", {1, 1, 1}, "the opposite corner"),
            same_everywhere("temperature"), same_everywhere("temperatureoffset"),
            same_everywhere("temperaturescale"), same_everywhere("temperaturecutoff")})}};
}

}  // namespace

const std::vector<TypeSpec>& medium_types() {
  static const std::vector<TypeSpec> types = make_medium_types();
  return types;
}

}  // namespace kaustik
