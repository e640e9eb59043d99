// Formulas of dispersion, and the table of glasses.

#include "core/spectrum/refractive_index.h"

#include <algorithm>
#include <cmath>

namespace kaustik {
namespace {

constexpr SellmeierCoefficients kSf5 = {1.52481889,  0.187085527,  1.42729015,
                                        0.011254756, 0.0588995392, 129.141675};
constexpr SellmeierCoefficients kSf10 = {1.62153902,   0.256287842,  1.64447552,
                                         0.0122241457, 0.0595736775, 147.468793};
constexpr SellmeierCoefficients kSf11 = {1.73759695,  0.313747346,  1.89878101,
                                         0.013188707, 0.0623068142, 155.23629};
// pbrt's names of Schott's flint glasses lack the S.
constexpr Glass kGlasses[] = {
    {"glass-BK7", {1.03961212, 0.231792344, 1.01046945, 0.00600069867, 0.0200179144, 103.560653}},
    {"glass-BAF10", {1.5851495, 0.143559385, 1.08521269, 0.00926681282, 0.0424489805, 105.613573}},
    {"glass-FK51A", {0.971247817, 0.216901417, 0.904651666, 0.00472301995, 0.0153575612, 168.68133}},
    {"glass-LASF9", {2.00029547, 0.298926886, 1.80691843, 0.0121426017, 0.0538736236, 156.530829}},
    {"glass-SF5", kSf5},
    {"glass-F5", kSf5},
    {"glass-SF10", kSf10},
    {"glass-F10", kSf10},
    {"glass-SF11", kSf11},
    {"glass-F11", kSf11},
};

double square_micrometres(double nanometres) {
  return nanometres * nanometres * 1e-6;
}

}  // namespace

Spectrum sellmeier_index(const SellmeierCoefficients& coefficients) {
  return Spectrum::from([&](double nm) {
    const double l2 = square_micrometres(nm);
    double n2 = 1;
    for (size_t i = 0; i < 3; ++i) n2 += coefficients[i] * l2 / (l2 - coefficients[i + 3]);
    return std::sqrt(n2);
  });
}

Spectrum cauchy_index(std::span<const double> coefficients) {
  return Spectrum::from([&](double nm) {
    double n = 0;
    for (size_t i = coefficients.size(); i-- > 0;) n = n / square_micrometres(nm) + coefficients[i];
    return n;
  });
}

Spectrum abbe_index(double eta, double abbe) {
  constexpr double kF = 486.13, kC = 656.28;
  const double b = (eta - 1) / (abbe * (1 / square_micrometres(kF) - 1 / square_micrometres(kC)));
  return cauchy_index(std::array{eta - b / square_micrometres(kHeliumLine), b});
}

Spectrum sampled_index(std::span<const double> pairs) {
  return Spectrum::from([&](double nm) {
    size_t above = 0;
    while (above + 1 < pairs.size() && pairs[above] <= nm) above += 2;
    if (above == 0) return pairs[1];
    if (above + 1 >= pairs.size()) return pairs[above - 1];
    const double t = (nm - pairs[above - 2]) / (pairs[above] - pairs[above - 2]);
    return (1 - t) * pairs[above - 1] + t * pairs[above + 1];
  });
}

bool valid_index(const Spectrum& index) {
  return std::all_of(index.values.begin(), index.values.end(),
                     [](double n) { return n >= 0.01 && n <= 100; });
}

bool varies(const Spectrum& index) {
  const auto [least, most] = std::minmax_element(index.values.begin(), index.values.end());
  return *most - *least > 1e-9;
}

std::span<const Glass> glasses() {
  return kGlasses;
}

const SellmeierCoefficients* glass_coefficients(std::string_view name) {
  for (const Glass& glass : kGlasses)
    if (glass.name == name) return &glass.coefficients;
  return nullptr;
}

}  // namespace kaustik
