#include "core/scene/build/dispersion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/spectrum/refractive_index.h"

namespace kaustik {
namespace {

using Formula = Spectrum (*)(const ParameterReader&);

struct Form {
  std::string_view parameter;
  Formula index;
};

constexpr Form kForms[] = {
    {"sellmeier",
     [](const ParameterReader& p) {
       SellmeierCoefficients coefficients;
       std::copy_n(p.numbers("sellmeier").begin(), coefficients.size(), coefficients.begin());
       return sellmeier_index(coefficients);
     }},
    {"cauchy", [](const ParameterReader& p) { return cauchy_index(p.numbers("cauchy")); }},
    {"indices", [](const ParameterReader& p) { return sampled_index(p.numbers("indices")); }},
    {"abbe", [](const ParameterReader& p) { return abbe_index(p.number("eta"), p.number("abbe")); }},
};

// Wavelengths and indices alternate, and the wavelengths increase.
bool are_pairs(const std::vector<double>& numbers) {
  for (size_t i = 2; i < numbers.size(); i += 2)
    if (!(numbers[i] > numbers[i - 2])) return false;
  return numbers.size() % 2 == 0;
}

bool check(const ParameterReader& p, const Form& form, DiagnosticList& diagnostics) {
  const Parameter* eta = p.directive().find("eta");
  if (eta && eta->type == ParameterType::kTexture) {
    diagnostics.error(eta->location,
                      fmt::format("`eta` cannot be a texture where `{}` is given", form.parameter));
    return false;
  }
  if (form.parameter != "indices" || are_pairs(p.numbers("indices"))) return true;
  diagnostics.error(p.location("indices"),
                    "`indices` takes pairs of wavelength and index of refraction, "
                    "and the wavelengths increase");
  return false;
}

// The form that is given; null if there is none, or more than one, which is an error.
const Form* given_form(const ParameterReader& p, DiagnosticList& diagnostics) {
  const Form* given = nullptr;
  for (const Form& form : kForms) {
    if (!p.has(form.parameter)) continue;
    if (given) {
      diagnostics.error(p.directive().find(form.parameter)->location,
                        fmt::format("`{}` and `{}` both tell how the index of refraction depends on the "
                                    "wavelength: give one of them",
                                    given->parameter, form.parameter));
      return nullptr;
    }
    given = &form;
  }
  return given;
}

}  // namespace

bool tells_dispersion(std::string_view parameter) {
  return std::any_of(std::begin(kForms), std::end(kForms),
                     [&](const Form& form) { return form.parameter == parameter; });
}

std::shared_ptr<const Spectrum> dispersion_of(const ParameterReader& p, DiagnosticList& diagnostics) {
  if (!p.spec().find(kForms[0].parameter)) return nullptr;
  const Form* form = given_form(p, diagnostics);
  if (!form || !check(p, *form, diagnostics)) return nullptr;
  Spectrum index = form->index(p);
  if (!valid_index(index)) {
    diagnostics.error(
        p.location(form->parameter),
        fmt::format("`{}` leads to indices of refraction that are not between 0.01 and 100, from "
                    "{} nm to {} nm",
                    form->parameter, kFirstNanometre, kLastNanometre));
    return nullptr;
  }
  return std::make_shared<const Spectrum>(std::move(index));
}

}  // namespace kaustik
