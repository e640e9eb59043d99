// Schema rows of participating media.

#include "core/scene/schema/parameter_spec.h"

namespace kaustik {
namespace {

using namespace spec;

ParameterSpec coefficient(std::string_view name, const glm::dvec3& value, std::string_view doc) {
  return of_type(ParameterType::kRgb, name, {value.x, value.y, value.z}, "1/m", kNotNegative, doc);
}

std::vector<TypeSpec> make_medium_types() {
  return {{"homogeneous",
           "The same everywhere. It absorbs light; what it scatters and emits is not rendered.",
           {coefficient("sigma_a", {0.0011, 0.0024, 0.014}, "absorption coefficient"),
            coefficient("sigma_s", {2.55, 3.21, 3.77}, "scattering coefficient: not rendered"),
            number("scale", 1, "", kNotNegative, "factor on both coefficients"),
            ignored("g", {ParameterType::kFloat}, "media do not scatter", 0),
            ignored("Le", {ParameterType::kRgb, ParameterType::kSpectrum, ParameterType::kBlackbody},
                    "media do not emit"),
            ignored("Lescale", {ParameterType::kFloat}, "media do not emit"),
            ignored("preset", {ParameterType::kString}, "coefficients must be given")}}};
}

}  // namespace

const std::vector<TypeSpec>& medium_types() {
  static const std::vector<TypeSpec> types = make_medium_types();
  return types;
}

}  // namespace kaustik
