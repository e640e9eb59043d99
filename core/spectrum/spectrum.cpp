// Spectra of light sources, and the conversion of spectra to colours.

#include "core/spectrum/spectrum.h"

#include "core/spectrum/cie_tables.h"
#include "core/spectrum/colour_space.h"

namespace kaustik {
namespace {

// Refines a table in steps of 5 nm to 1 nm, by the cubic through the four nearest rows (CIE 167:2005 compares
// such methods). Rows at the ends of the table are repeated beyond it.
double refined(std::span<const double, cie::kRows> rows, int nanometre) {
  const int i = (nanometre - cie::kFirst) / cie::kStep;
  const double t = double(nanometre - cie::kFirst - i * cie::kStep) / cie::kStep;
  const auto row = [&](int k) { return rows[static_cast<size_t>(std::clamp(k, 0, cie::kRows - 1))]; };
  return -row(i - 1) * t * (t - 1) * (t - 2) / 6 + row(i) * (t + 1) * (t - 1) * (t - 2) / 2 -
         row(i + 1) * (t + 1) * t * (t - 2) / 2 + row(i + 2) * (t + 1) * t * (t - 1) / 6;
}

using Observer = std::array<Spectrum, 3>;

const Observer& observer() {
  static const Observer functions = [] {
    Observer out;
    for (int f = 0; f < 3; ++f)
      out[static_cast<size_t>(f)] = Spectrum::from(
          [rows = cie::matching(f)](double nm) { return refined(rows, static_cast<int>(nm)); });
    return out;
  }();
  return functions;
}

double planck(double nanometres, double kelvin) {
  constexpr double kC = 299792458, kH = 6.62607015e-34, kBoltzmann = 1.380649e-23;  // SI, exact
  const double l = nanometres * 1e-9;
  return 2 * kH * kC * kC / (std::pow(l, 5) * std::expm1(kH * kC / (l * kBoltzmann * kelvin)));
}

const Spectrum& d65() {
  static const Spectrum s = daylight(6500);
  return s;
}

// Reflectance of a metal in air at normal incidence.
double normal_reflectance(double eta, double k) {
  return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
}

}  // namespace

Spectrum Spectrum::from(const std::function<double(double)>& value_at) {
  Spectrum s;
  for (size_t i = 0; i < s.values.size(); ++i)
    s.values[i] = value_at(kFirstNanometre + static_cast<double>(i));
  return s;
}

double Spectrum::at(double nanometres) const {
  const double x = std::clamp(nanometres - kFirstNanometre, 0.0, double(values.size() - 1));
  const auto i = std::min(static_cast<size_t>(x), values.size() - 2);
  const double t = x - double(i);
  return (1 - t) * values[i] + t * values[i + 1];
}

Spectrum sampled_spectrum(std::span<const double> wavelengths, std::span<const double> values) {
  return Spectrum::from([&](double nm) {
    if (wavelengths.empty() || nm < wavelengths.front() || nm > wavelengths.back()) return 0.0;
    const auto above = std::upper_bound(wavelengths.begin(), wavelengths.end(), nm);
    if (above == wavelengths.end()) return values.back();
    const auto i = static_cast<size_t>(above - wavelengths.begin());
    const double t = (nm - wavelengths[i - 1]) / (wavelengths[i] - wavelengths[i - 1]);
    return (1 - t) * values[i - 1] + t * values[i];
  });
}

Spectrum blackbody(double kelvin) {
  constexpr double kWien = 2.897771955e6;  // nm K
  const double peak = planck(kWien / kelvin, kelvin);
  return Spectrum::from([&](double nm) { return planck(nm, kelvin) / peak; });
}

Spectrum daylight(double kelvin) {
  const double t = kelvin * 1.4388 / 1.4380;
  if (t < 4000) return blackbody(t);
  const double x = t <= 7000 ? -4.6070e9 / (t * t * t) + 2.9678e6 / (t * t) + 0.09911e3 / t + 0.244063
                             : -2.0064e9 / (t * t * t) + 1.9018e6 / (t * t) + 0.24748e3 / t + 0.237040;
  const double y = -3 * x * x + 2.870 * x - 0.275;
  const double m = 0.0241 + 0.2562 * x - 0.7341 * y;
  const double m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / m;
  const double m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / m;
  std::array<double, cie::kRows> wavelengths, values;
  for (size_t i = 0; i < values.size(); ++i) {
    wavelengths[i] = cie::kFirst + cie::kStep * static_cast<double>(i);
    values[i] = cie::daylight(0)[i] + m1 * cie::daylight(1)[i] + m2 * cie::daylight(2)[i];
  }
  return sampled_spectrum(wavelengths, values);
}

Spectrum illuminant_a() {
  constexpr double kSecond = 1.435e7, kKelvin = 2848;  // constants of the illuminant's definition
  return Spectrum::from([&](double nm) {
    return 100 * std::pow(560 / nm, 5) * std::expm1(kSecond / (kKelvin * 560)) /
           std::expm1(kSecond / (kKelvin * nm));
  });
}

glm::dvec3 tristimulus(const Spectrum& s) {
  glm::dvec3 xyz(0);
  for (size_t i = 0; i < s.values.size(); ++i) {
    for (int f = 0; f < 3; ++f) xyz[f] += observer()[static_cast<size_t>(f)].values[i] * s.values[i];
  }
  return xyz;
}

glm::dvec3 emitted_colour(const Spectrum& s) {
  const glm::dvec3 xyz = tristimulus(s);
  return xyz_to_ours() * (xyz / xyz.y);
}

glm::dvec3 reflected_colour(const Spectrum& s) {
  Spectrum seen;
  for (size_t i = 0; i < seen.values.size(); ++i) seen.values[i] = s.values[i] * d65().values[i];
  return xyz_to_ours() * (tristimulus(seen) / tristimulus(d65()).y);
}

MetalColour metal_colour(const Spectrum& eta, const Spectrum& k) {
  Spectrum reflectance;
  for (size_t i = 0; i < reflectance.values.size(); ++i)
    reflectance.values[i] = normal_reflectance(eta.values[i], k.values[i]);
  const glm::dvec3 r = glm::clamp(reflected_colour(reflectance), 0.0, 0.9999);
  MetalColour out;
  out.eta = glm::max(reflected_colour(eta), 0.01);
  const glm::dvec3 k2 =
      (r * (out.eta + 1.0) * (out.eta + 1.0) - (out.eta - 1.0) * (out.eta - 1.0)) / (1.0 - r);
  out.k = glm::sqrt(glm::max(k2, 0.0));
  return out;
}

}  // namespace kaustik
