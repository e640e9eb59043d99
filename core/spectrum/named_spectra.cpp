// The table of named spectra: illuminants, metals and glasses.

#include "core/spectrum/named_spectra.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/spectrum/cie_tables.h"
#include "core/spectrum/metal_tables.h"
#include "core/spectrum/refractive_index.h"

namespace kaustik {
namespace {

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
    for (const Glass& glass : glasses())
      all.push_back({std::string(glass.name), [&glass] { return sellmeier_index(glass.coefficients); }});
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
