#include "apps/import/pbrt/colours.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "apps/import/pbrt/parameter_parser.h"
#include "core/diagnostics/nearest_name.h"
#include "core/scene/build/dispersion.h"
#include "core/spectrum/named_spectra.h"
#include "core/spectrum/refractive_index.h"

namespace kaustik::pbrt {
namespace {

bool takes(const ParameterSpec& spec, ParameterType type) {
  return std::find(spec.types.begin(), spec.types.end(), type) != spec.types.end();
}

bool is_spectral(const Parameter& p) {
  return p.type == ParameterType::kSpectrum || p.type == ParameterType::kBlackbody;
}

const TypeSpec* type_of(std::string_view directive, std::string_view name) {
  for (const TypeSpec* type : category(directive).types) {
    if (type->name == name) return type;
  }
  return nullptr;
}

void set_rgb(Parameter& p, const glm::dvec3& c) {
  p.type = ParameterType::kRgb;
  p.strings.clear();
  p.numbers = {c.x, c.y, c.z};
  // Later checks report errors at the location of the first value.
  p.value_places.resize(std::min<size_t>(p.value_places.size(), 1));
}

// Cuts negative components and scales the rest so that the luminance stays the same.
glm::dvec3 cut_light(const glm::dvec3& c) {
  const glm::dvec3 cut = glm::max(c, 0.0);
  const auto y = [](const glm::dvec3& v) { return 0.2126 * v.x + 0.7152 * v.y + 0.0722 * v.z; };
  return cut == c || !(y(cut) > 0) ? cut : cut * (y(c) / y(cut));
}

// Clamps to the range that the schema allows, such as [0, 1] for a reflectance.
glm::dvec3 cut_surface(const glm::dvec3& c, const ParameterSpec& spec) {
  return glm::clamp(c, std::max(0.0, spec.range.low), spec.range.high);
}

void change_space(Parameter& p, const ParameterSpec& spec, const ColourSpace& space, bool light) {
  const glm::dmat3 m = light ? space.light_to_ours() : space.surface_to_ours();
  for (size_t i = 0; i + 2 < p.numbers.size(); i += 3) {
    const glm::dvec3 c = m * glm::dvec3(p.numbers[i], p.numbers[i + 1], p.numbers[i + 2]);
    const glm::dvec3 cut = light ? cut_light(c) : cut_surface(c, spec);
    for (int k = 0; k < 3; ++k) p.numbers[i + static_cast<size_t>(k)] = cut[k];
  }
}

// Replaces spectral `eta` and `k` of a metal by rgb values that together give the metal's colour.
void join_metal(const std::map<std::string, Spectrum>& spectra, Directive& directive) {
  for (Parameter& eta : directive.parameters) {
    if (!eta.name.ends_with("eta") || eta.type != ParameterType::kRgb) continue;
    const std::string k_name = eta.name.substr(0, eta.name.size() - 3) + "k";
    const auto k = std::find_if(directive.parameters.begin(), directive.parameters.end(),
                                [&](const Parameter& p) { return p.name == k_name; });
    const auto eta_spectrum = spectra.find(eta.name);
    const auto k_spectrum = spectra.find(k_name);
    if (k == directive.parameters.end() || eta_spectrum == spectra.end() || k_spectrum == spectra.end())
      continue;
    const MetalColour metal = metal_colour(eta_spectrum->second, k_spectrum->second);
    set_rgb(eta, metal.eta);
    set_rgb(*k, metal.k);
  }
}

// The samples of an index of refraction in steps of 5 nm, and the first and the last one, without the zeros
// beyond the ends of the spectrum's own samples.
std::vector<double> pairs_of_index(const Spectrum& s) {
  const auto given = [](double n) { return n > 0; };
  const auto first = std::find_if(s.values.begin(), s.values.end(), given);
  const auto last = std::find_if(s.values.rbegin(), s.values.rend(), given);
  if (first == s.values.end()) return {kHeliumLine, 0};
  std::vector<double> pairs;
  const auto end = static_cast<size_t>(s.values.rend() - last);
  for (auto i = static_cast<size_t>(first - s.values.begin()); i < end; ++i)
    if (i % 5 == 0 || pairs.empty() || i + 1 == end)
      pairs.insert(pairs.end(), {kFirstNanometre + double(i), s.values[i]});
  return pairs;
}

}  // namespace

void ColourReducer::reduce(std::string_view directive, const ColourSpace& space, Directive& out) {
  const TypeSpec* type = type_of(directive, out.type);
  if (!type) return;
  std::map<std::string, Spectrum> spectra;
  std::optional<Parameter> dispersion;
  std::erase_if(out.parameters, [&](Parameter& p) {
    const ParameterSpec* spec = type->find(p.name);
    if (!spec || spec->state != ParameterState::kUsed) return false;
    const bool light = spec->unit.starts_with("W/");  // of lights and of media
    if (p.type == ParameterType::kRgb && !space.is_ours()) change_space(p, *spec, space, light);
    if (!is_spectral(p)) return false;
    const bool index = takes(*spec, ParameterType::kFloat) && p.name.ends_with("eta");
    if (!takes(*spec, ParameterType::kRgb) && !index) return false;
    const auto s = spectrum_of(p);
    if (!s) return true;
    spectra.emplace(p.name, *s);
    if (takes(*spec, ParameterType::kRgb)) {
      reduce_colour(p, *spec, *s, light);
    } else {
      dispersion = reduce_index(p, *s, type->find("sellmeier"));
    }
    return false;
  });
  if (dispersion) add_dispersion(std::move(*dispersion), out);
  join_metal(spectra, out);
}

std::optional<Parameter> ColourReducer::reduce_index(Parameter& p, const Spectrum& s, bool disperses) {
  Parameter dispersion = p;
  const SellmeierCoefficients* glass = p.strings.empty() ? nullptr : glass_coefficients(p.strings[0]);
  dispersion.name = glass ? "sellmeier" : "indices";
  dispersion.type = p.type = ParameterType::kFloat;
  dispersion.numbers = glass ? std::vector<double>(glass->begin(), glass->end()) : pairs_of_index(s);
  dispersion.strings.clear();
  p.strings.clear();
  const Spectrum index = glass ? s : sampled_index(dispersion.numbers);
  p.numbers = {index.at(kHeliumLine)};
  for (Parameter* each : {&p, &dispersion})
    each->value_places.resize(std::min<size_t>(each->value_places.size(), 1));
  if (disperses && varies(index)) return dispersion;
  if (!disperses && !warned_of_dispersion_)
    diagnostics_.warning(p.location,
                         fmt::format("dispersion is rendered in \"dielectric\" only: `{}` is taken at {} nm, "
                                     "where it is {:.5g}",
                                     p.name, kHeliumLine, p.numbers[0]));
  warned_of_dispersion_ |= !disperses;
  return std::nullopt;
}

void ColourReducer::add_dispersion(Parameter dispersion, Directive& out) {
  for (const Parameter& other : out.parameters) {
    if (!tells_dispersion(other.name)) continue;
    diagnostics_.error(other.location,
                       fmt::format("`{}` cannot be given where `eta` is a spectrum", other.name));
    return;
  }
  out.parameters.push_back(std::move(dispersion));
}

void ColourReducer::reduce_colour(Parameter& p, const ParameterSpec& spec, const Spectrum& s, bool light) {
  // pbrt-v3's blackbody has two numbers: temperature and factor.
  const double factor = p.type == ParameterType::kBlackbody && p.numbers.size() == 2 ? p.numbers[1] : 1;
  if (!light) return set_rgb(p, cut_surface(factor * reflected_colour(s), spec));
  const glm::dvec3 c = emitted_colour(s);
  if (!std::isfinite(c.x + c.y + c.z)) {
    diagnostics_.error(p.value_location(0),
                       fmt::format("the light of `{}` is invisible: its spectrum is zero "
                                   "from 360 nm to 830 nm",
                                   p.name));
    return set_rgb(p, glm::dvec3(1));
  }
  set_rgb(p, factor * cut_light(c));
}

std::optional<Spectrum> ColourReducer::spectrum_of(const Parameter& p) {
  if (p.type == ParameterType::kSpectrum) return p.strings.empty() ? from_pairs(p) : from_name(p);
  constexpr double kLeast = 100, kMost = 1e7;
  const bool good = p.numbers.size() == 1 || p.numbers.size() == 2;
  if (good && p.numbers[0] >= kLeast && p.numbers[0] <= kMost && p.numbers.back() >= 0)
    return blackbody(p.numbers[0]);
  diagnostics_.error(good ? p.value_location(0) : p.location,
                     fmt::format("`{}` takes a temperature from {} to {:.0f} kelvin and an optional factor",
                                 p.name, kLeast, kMost));
  return std::nullopt;
}

std::optional<Spectrum> ColourReducer::from_pairs(const Parameter& p) {
  return from_samples(p.numbers, p.location, [&](size_t i) { return p.value_location(i); });
}

std::optional<Spectrum> ColourReducer::from_samples(const std::vector<double>& pairs,
                                                    const SourceLocation& where,
                                                    const std::function<SourceLocation(size_t)>& place) {
  if (pairs.size() < 2) {
    diagnostics_.error(where, fmt::format("a spectrum takes pairs of wavelength and value, not {} number{}",
                                          pairs.size(), pairs.size() == 1 ? "" : "s"));
    return std::nullopt;
  }
  if (pairs.size() % 2 != 0)
    diagnostics_.warning(where,
                         fmt::format("a spectrum takes pairs of wavelength and value: the last of {} numbers "
                                     "is ignored",
                                     pairs.size()));
  std::map<double, double> sorted;
  const char* wrong = nullptr;
  size_t first_wrong = 0;
  for (size_t i = 0; i + 1 < pairs.size(); i += 2) {
    const bool increases = sorted.empty() || pairs[i] > sorted.rbegin()->first, dark = !(pairs[i + 1] >= 0);
    if ((!increases || dark) && !wrong) {
      first_wrong = dark ? i + 1 : i;
      wrong = dark ? "a spectrum must not be negative: such values become zero"
                   : "wavelengths must increase: they are sorted, and the first value of each holds";
    }
    sorted.emplace(pairs[i], dark ? 0 : pairs[i + 1]);
  }
  if (wrong) diagnostics_.warning(place(first_wrong), wrong);
  std::vector<double> wavelengths, values;
  for (const auto& [wavelength, value] : sorted) {
    wavelengths.push_back(wavelength);
    values.push_back(value);
  }
  return sampled_spectrum(wavelengths, values);
}

std::optional<Spectrum> ColourReducer::from_name(const Parameter& p) {
  const std::string& name = p.strings[0];
  if (p.strings.size() > 1) {
    diagnostics_.error(p.value_location(1), fmt::format("`{}` takes the name of one spectrum", p.name));
    return std::nullopt;
  }
  if (auto s = named_spectrum(name)) return s;
  if (const auto nearest = nearest_to_missing_spectrum(name)) {
    if (!nearest->empty()) {
      diagnostics_.warning(
          p.value_location(0),
          fmt::format("pbrt's spectrum \"{}\" is not built in: \"{}\" stands in", name, *nearest));
      return named_spectrum(*nearest);
    }
    diagnostics_.error(p.value_location(0),
                       fmt::format("pbrt's spectrum \"{}\" is not built in: give a file of "
                                   "wavelengths and values",
                                   name));
    return std::nullopt;
  }
  const OpenedText opened = open_(name);
  if (opened.file) return from_file(p, *opened.file);
  const std::vector<std::string_view> names = spectrum_names();
  const std::string hint = name_hint(name, names);
  std::string message = fmt::format("no spectrum is named \"{}\"{} Read as a file name: {}", name,
                                    hint.empty() ? "." : hint, opened.error);
  // A name with a letter or two wrong is the author's error; pbrt goes on without files that are not there.
  const auto nearest = nearest_name(name, names);
  if (opened.refused || (nearest && edit_distance(name, *nearest) <= 2)) {
    diagnostics_.error(p.value_location(0), std::move(message));
  } else {
    diagnostics_.warning(p.value_location(0), fmt::format("{}; `{}` keeps its default", message, p.name));
  }
  return std::nullopt;
}

std::optional<Spectrum> ColourReducer::from_file(const Parameter& p, uint32_t file) {
  const auto numbers = read_numbers(file, p.value_location(0), diagnostics_);
  if (!numbers) return std::nullopt;
  std::vector<double> pairs;
  for (const PlacedNumber& number : *numbers) pairs.push_back(number.value);
  return from_samples(pairs, p.value_location(0), [&](size_t i) { return (*numbers)[i].where; });
}

}  // namespace kaustik::pbrt
