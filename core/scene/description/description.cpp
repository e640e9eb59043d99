// Names of parameter types, and look-up of parameters.

#include "core/scene/description/description.h"

#include <utility>

namespace kaustik {

std::string_view parameter_type_name(ParameterType type) {
  switch (type) {
    case ParameterType::kFloat:
      return "float";
    case ParameterType::kInteger:
      return "integer";
    case ParameterType::kBool:
      return "bool";
    case ParameterType::kString:
      return "string";
    case ParameterType::kPoint2:
      return "point2";
    case ParameterType::kVector2:
      return "vector2";
    case ParameterType::kPoint3:
      return "point3";
    case ParameterType::kVector3:
      return "vector3";
    case ParameterType::kNormal:
      return "normal";
    case ParameterType::kRgb:
      return "rgb";
    case ParameterType::kSpectrum:
      return "spectrum";
    case ParameterType::kBlackbody:
      return "blackbody";
    case ParameterType::kTexture:
      return "texture";
  }
  return "";
}

bool Parameter::may_have_holes() const {
  return (type == ParameterType::kPoint3 && name == "P") || (type == ParameterType::kNormal && name == "N");
}

SourceLocation Parameter::value_location(size_t i) const {
  if (i >= value_places.size()) return location;
  return {location.file, value_places[i].line, value_places[i].column};
}

const Parameter* Directive::find(std::string_view parameter_name) const {
  for (const Parameter& p : parameters) {
    if (p.name == parameter_name) return &p;
  }
  return nullptr;
}

Parameter* Directive::find(std::string_view parameter_name) {
  return const_cast<Parameter*>(std::as_const(*this).find(parameter_name));
}

}  // namespace kaustik
