#pragma once
// Builds directives and parameters in code: importers of other formats use it to express a scene as pbrt
// directives.

#include <string>
#include <vector>

#include "core/scene/description/description.h"

namespace kaustik {

inline Parameter make_parameter(ParameterType type, std::string name, std::vector<double> numbers,
                                const SourceLocation& where) {
  Parameter p;
  p.type = type;
  p.name = std::move(name);
  p.location = where;
  p.numbers = std::move(numbers);
  return p;
}

inline Parameter make_parameter(ParameterType type, std::string name, std::string text,
                                const SourceLocation& where) {
  Parameter p = make_parameter(type, std::move(name), std::vector<double>{}, where);
  p.strings.push_back(std::move(text));
  return p;
}

// Builds a directive by adding parameters one after the other. All get the same source location.
template <class D>
class DirectiveMaker {
 public:
  DirectiveMaker(std::string type, const SourceLocation& where) {
    directive_.type = std::move(type);
    directive_.location = directive_.type_location = where;
  }
  DirectiveMaker& number(std::string name, double v) {
    return add(ParameterType::kFloat, std::move(name), {v});
  }
  DirectiveMaker& integer(std::string name, double v) {
    return add(ParameterType::kInteger, std::move(name), {v});
  }
  DirectiveMaker& flag(std::string name, bool v) {
    return add(ParameterType::kBool, std::move(name), {v ? 1.0 : 0.0});
  }
  DirectiveMaker& rgb(std::string name, const glm::dvec3& c) {
    return add(ParameterType::kRgb, std::move(name), {c.x, c.y, c.z});
  }
  DirectiveMaker& text(std::string name, std::string v) {
    directive_.parameters.push_back(
        make_parameter(ParameterType::kString, std::move(name), std::move(v), directive_.location));
    return *this;
  }
  DirectiveMaker& add(ParameterType type, std::string name, std::vector<double> numbers) {
    directive_.parameters.push_back(
        make_parameter(type, std::move(name), std::move(numbers), directive_.location));
    return *this;
  }
  DirectiveMaker& add(Parameter p) {
    directive_.parameters.push_back(std::move(p));
    return *this;
  }
  D& operator*() { return directive_; }
  D* operator->() { return &directive_; }

 private:
  D directive_;
};

}  // namespace kaustik
