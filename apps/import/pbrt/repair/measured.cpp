// What stands in for measured BSDFs, whose files are not read: a material of the kind that the file's name
// says.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "apps/import/common/make_parameter.h"
#include "apps/import/pbrt/repair/repairs.h"
#include "core/text.h"

namespace kaustik::pbrt {
namespace {

using Type = ParameterType;

std::string lower_stem(std::string_view file) {
  return lower_case(file.substr(file.find_last_of("/\\") + 1));
}

bool has_any(std::string_view text, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view w) { return text.find(w) != std::string_view::npos; });
}

struct Metal {
  std::string_view word, name;
};
constexpr Metal kMetals[] = {{"copper", "Cu"}, {"gold", "Au"},   {"brass", "CuZn"}, {"silver", "Ag"},
                             {"alumin", "Al"}, {"chrome", "Al"}, {"steel", "Al"},   {"nickel", "Al"},
                             {"metal", "Al"},  {"bronze", "Cu"}, {"iron", "Al"},    {"platin", "Ag"}};

// The width in names such as roughglass_alpha_0.2.bsdf.
double width_in(std::string_view stem) {
  constexpr double kOtherwise = 0.2;
  const size_t at = stem.find("alpha_");
  if (at == stem.npos) return kOtherwise;
  double width = 0;
  const std::string_view digits = stem.substr(at + 6);
  const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), width);
  return status == std::errc() && width >= 0 && width <= 1 ? width : kOtherwise;
}

void become(Directive& d, std::string_view type, double width) {
  std::erase_if(d.parameters,
                [](const Parameter& p) { return p.name != "displacement" && p.name != "normalmap"; });
  d.type = type;
  const auto add = [&](Type t, std::string name, double v) {
    d.parameters.push_back(make_parameter(t, std::move(name), std::vector<double>{v}, d.type_location));
  };
  add(Type::kFloat, "roughness", width);
  add(Type::kBool, "remaproughness", 0);
}

}  // namespace

std::string replace_measured(Directive& d) {
  const Parameter* file = d.find("filename");
  if (d.type != "measured" || !file || file->strings.size() != 1) return "";
  const std::string stem = lower_stem(file->strings[0]);
  if (has_any(stem, {"glass", "water"})) {
    become(d, "dielectric", width_in(stem));
    return "\"dielectric\"";
  }
  const auto metal = std::find_if(std::begin(kMetals), std::end(kMetals),
                                  [&](const Metal& m) { return stem.find(m.word) != stem.npos; });
  if (metal != std::end(kMetals)) {
    become(d, "conductor", width_in(stem));
    for (const std::string index : {"eta", "k"})
      d.parameters.push_back(make_parameter(Type::kSpectrum, index,
                                            fmt::format("metal-{}-{}", metal->name, index), d.type_location));
    return fmt::format("\"conductor\" of {}", metal->name);
  }
  if (has_any(stem, {"paint", "ceramic", "plastic", "leather", "lacquer", "coated", "porcelain"})) {
    become(d, "coateddiffuse", width_in(stem));
    return "\"coateddiffuse\"";
  }
  return "";
}

}  // namespace kaustik::pbrt
