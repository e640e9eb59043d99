// Schema rows of participating media.

#include "core/scene/schema/parameter_spec.h"

namespace kaustik {
namespace {

using namespace spec;

ParameterSpec coefficient(std::string_view name, const glm::dvec3& value, std::string_view doc) {
  return of_type(ParameterType::kRgb, name, {value.x, value.y, value.z}, "1/m", kNotNegative, doc);
}

std::vector<TypeSpec> make_medium_types() {
  return {
      {"homogeneous",
       "The same everywhere. It absorbs and scatters light; what it emits is not rendered.",
       {coefficient("sigma_a", {0.0011, 0.0024, 0.014}, "absorption coefficient"),
        coefficient("sigma_s", {2.55, 3.21, 3.77}, "scattering coefficient"),
        number("scale", 1, "", kNotNegative, "factor on both coefficients"),
        text("preset", "none",
             "a measured medium whose coefficients, in 1/mm, are taken instead, with units of the scene for "
             "mm: Apple, Coke, Wholemilk and others that pbrt knows"),
        number("g", 0, "", {-1, 1}, "mean cosine of the angle by which light is deflected"),
        ignored("Le", {ParameterType::kRgb, ParameterType::kSpectrum, ParameterType::kBlackbody},
                "media do not emit"),
        ignored("Lescale", {ParameterType::kFloat}, "media do not emit")}}};
}

}  // namespace

const std::vector<TypeSpec>& medium_types() {
  static const std::vector<TypeSpec> types = make_medium_types();
  return types;
}

}  // namespace kaustik
