// The table of named spectra: illuminants, metals and glasses.

#include "core/spectrum/named_spectra.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/spectrum/cie_tables.h"
#include "core/spectrum/metal_tables.h"

namespace kaustik {
namespace {

// Sellmeier's equation, n^2 = 1 + sum B l^2 / (l^2 - C) with l in micrometres. The coefficients are from
// Schott's data sheets.
struct Glass {
  std::string_view name;
  double b[3], c[3];

  double index(double nanometres) const {
    const double l2 = nanometres * nanometres * 1e-6;
    double n2 = 1;
    for (int i = 0; i < 3; ++i) n2 += b[i] * l2 / (l2 - c[i]);
    return std::sqrt(n2);
  }
};

constexpr Glass kGlasses[] = {
    {"BK7", {1.03961212, 0.231792344, 1.01046945}, {0.00600069867, 0.0200179144, 103.560653}},
    {"BAF10", {1.5851495, 0.143559385, 1.08521269}, {0.00926681282, 0.0424489805, 105.613573}},
    {"FK51A", {0.971247817, 0.216901417, 0.904651666}, {0.00472301995, 0.0153575612, 168.68133}},
    {"LASF9", {2.00029547, 0.298926886, 1.80691843}, {0.0121426017, 0.0538736236, 156.530829}},
    {"SF5", {1.52481889, 0.187085527, 1.42729015}, {0.011254756, 0.0588995392, 129.141675}},
    {"SF10", {1.62153902, 0.256287842, 1.64447552}, {0.0122241457, 0.0595736775, 147.468793}},
    {"SF11", {1.73759695, 0.313747346, 1.89878101}, {0.013188707, 0.0623068142, 155.23629}},
};

Spectrum fluorescent(int light) {
  std::vector<double> wavelengths;
  for (int i = 0; i < cie::kFluorescentRows; ++i)
    wavelengths.push_back(cie::kFluorescentFirst + cie::kStep * i);
  return sampled_spectrum(wavelengths, cie::fluorescent(light));
}

struct Named {
  std::string name;
  std::function<Spectrum()> make;
};

void add_illuminants(std::vector<Named>& all) {
  all.push_back({"stdillum-A", illuminant_a});
  for (const int t : {50, 55, 60, 65})
    all.push_back({fmt::format("stdillum-D{}", t), [t] { return daylight(100 * t); }});
  for (int light = 1; light <= 12; ++light)
    all.push_back({fmt::format("stdillum-F{}", light), [light] { return fluorescent(light); }});
  all.push_back({"illum-acesD60", [] { return daylight(6000); }});
}

const std::vector<Named>& all_named() {
  static const std::vector<Named> table = [] {
    std::vector<Named> all;
    add_illuminants(all);
    for (const MetalIndex& m : metals()) {
      all.push_back({fmt::format("metal-{}-eta", m.name), [&m] { return m.eta; }});
      all.push_back({fmt::format("metal-{}-k", m.name), [&m] { return m.k; }});
    }
    for (const Glass& g : kGlasses) {
      const auto make = [&g] { return Spectrum::from([&g](double nm) { return g.index(nm); }); };
      all.push_back({fmt::format("glass-{}", g.name), make});
      // pbrt's names of Schott's flint glasses lack the S.
      if (g.name.starts_with("SF")) all.push_back({fmt::format("glass-{}", g.name.substr(1)), make});
    }
    return all;
  }();
  return table;
}

}  // namespace

std::optional<Spectrum> named_spectrum(std::string_view name) {
  for (const Named& s : all_named()) {
    if (s.name == name) return s.make();
  }
  return std::nullopt;
}

std::vector<std::string_view> spectrum_names() {
  std::vector<std::string_view> names;
  for (const Named& s : all_named()) names.push_back(s.name);
  return names;
}

std::optional<std::string_view> nearest_to_missing_spectrum(std::string_view name) {
  if (name == "metal-CuZn-eta") return "metal-Cu-eta";
  if (name == "metal-CuZn-k") return "metal-Cu-k";
  const bool camera = name.starts_with("canon_eos_") || name.starts_with("hasselblad_") ||
                      name.starts_with("nikon_d") || name.starts_with("sony_ilce_");
  if (camera && (name.ends_with("_r") || name.ends_with("_g") || name.ends_with("_b"))) return "";
  return std::nullopt;
}

}  // namespace kaustik
