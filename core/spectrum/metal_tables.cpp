// Complex refractive indices of metals and of two oxides. Silver, gold and copper are from Hagemann, Gudat
// and Kunz (1974), aluminium from Smith, Shiles and Inokuti (in Palik 1985), magnesium oxide and titanium
// dioxide from Palik (1985, 1991). The numbers are those of the SOPRA database, which renderers have used
// since.

#include "core/spectrum/metal_tables.h"

#include <span>
#include <vector>

namespace kaustik {
namespace {

// Samples at photon energies from 3.45 eV to 1.40 eV in steps of 0.05 eV.
constexpr int kRows = 42;
struct Row {
  double eta[kRows], k[kRows];
};

constexpr Row kSilver = {
    {0.194813, 0.186, 0.192063, 0.2,   0.198063, 0.192, 0.182,    0.173, 0.172625, 0.173, 0.166688, 0.16,
     0.1585,   0.157, 0.151063, 0.144, 0.137313, 0.132, 0.13025,  0.13,  0.129938, 0.13,  0.130063, 0.129,
     0.124375, 0.12,  0.119313, 0.121, 0.1255,   0.131, 0.136125, 0.14,  0.140063, 0.14,  0.144313, 0.148,
     0.145875, 0.143, 0.142563, 0.145, 0.151938, 0.163},
    {1.53375,  1.61,     1.641875, 1.67,     1.735,   1.81,    1.87875, 1.95,     2.029375, 2.11,    2.18625,
     2.26,     2.329375, 2.4,      2.47875,  2.56,    2.64,    2.72,    2.798125, 2.88,     2.97375, 3.07,
     3.159375, 3.25,     3.348125, 3.45,     3.55375, 3.66,    3.76625, 3.88,     4.010625, 4.15,    4.293125,
     4.44,     4.58625,  4.74,     4.908125, 5.09,    5.28875, 5.5,     5.720624, 5.95}};
constexpr Row kAluminium = {
    {0.39575, 0.407,    0.419125, 0.432,    0.445688, 0.46,     0.474688, 0.49,    0.506188, 0.523, 0.540063,
     0.558,   0.577313, 0.598,    0.620313, 0.644,    0.668625, 0.695,    0.72375, 0.755,    0.789, 0.826,
     0.867,   0.912,    0.963,    1.02,     1.08,     1.15,     1.22,     1.3,     1.39,     1.49,  1.6,
     1.74,    1.91,     2.14,     2.41,     2.63,     2.8,      2.74,     2.58,    2.24},
    {4.365, 4.43, 4.49375, 4.56, 4.63375, 4.71, 4.784375, 4.86, 4.938125, 5.02, 5.10875, 5.2,  5.29, 5.38,
     5.48,  5.58, 5.69,    5.8,  5.915,   6.03, 6.15,     6.28, 6.42,     6.55, 6.7,     6.85, 7.0,  7.15,
     7.31,  7.48, 7.65,    7.82, 8.01,    8.21, 8.39,     8.57, 8.62,     8.6,  8.45,    8.31, 8.21, 8.21}};
constexpr Row kGold = {
    {1.727625, 1.716,    1.705875, 1.696,    1.68475,  1.674,    1.666,    1.658,    1.64725, 1.636,  1.628,
     1.616,    1.59625,  1.562,    1.502125, 1.426,    1.345875, 1.242,    1.08675,  0.916,   0.7545, 0.608,
     0.49175,  0.402,    0.3455,   0.306,    0.267625, 0.236,    0.212375, 0.194,    0.17775, 0.166,  0.161,
     0.16,     0.160875, 0.164,    0.1695,   0.176,    0.181375, 0.188,    0.198125, 0.21},
    {1.852375, 1.862, 1.883,    1.906, 1.9225,   1.936, 1.94775,  1.956, 1.959375, 1.958, 1.951375, 1.94,
     1.9245,   1.904, 1.875875, 1.846, 1.814625, 1.796, 1.797375, 1.84,  1.9565,   2.12,  2.32625,  2.54,
     2.730625, 2.88,  2.940625, 2.97,  3.015,    3.06,  3.07,     3.15,  3.445812, 3.8,   4.087687, 4.357,
     4.610188, 4.86,  5.125813, 5.39,  5.63125,  5.88}};
constexpr Row kCopper = {
    {1.281563, 1.27,  1.249062, 1.225, 1.2,      1.18,  1.174375, 1.175, 1.1775,   1.18,  1.178125, 1.175,
     1.172812, 1.17,  1.165312, 1.16,  1.155312, 1.15,  1.142812, 1.135, 1.131562, 1.12,  1.092437, 1.04,
     0.950375, 0.826, 0.645875, 0.468, 0.35125,  0.272, 0.230813, 0.214, 0.20925,  0.213, 0.21625,  0.223,
     0.2365,   0.25,  0.254188, 0.26,  0.28,     0.3},
    {1.931688, 1.95,  1.972438, 2.015, 2.121562, 2.21,  2.177188, 2.13,  2.160063, 2.21,  2.249938, 2.289,
     2.326,    2.362, 2.397625, 2.433, 2.469187, 2.504, 2.535875, 2.564, 2.589625, 2.605, 2.595562, 2.583,
     2.5765,   2.599, 2.678062, 2.809, 3.01075,  3.24,  3.458187, 3.67,  3.863125, 4.05,  4.239563, 4.43,
     4.619563, 4.817, 5.034125, 5.26,  5.485625, 5.717}};

struct Sample {
  double nanometres, eta;
};
constexpr Sample kMagnesiumOxide[] = {
    {351.119, 1.7768},  {355.549, 1.7755},  {360.932, 1.7732},  {364.969, 1.77186}, {382.065, 1.7668},
    {386.712, 1.7655},  {393.338, 1.7638},  {404.634, 1.76104}, {430.935, 1.7557},  {435.782, 1.75471},
    {457.829, 1.7512},  {477.949, 1.7483},  {486.005, 1.74711}, {487.918, 1.7469},  {499.919, 1.7454},
    {502.35, 1.7453},   {508.532, 1.74446}, {514.44, 1.7439},   {546.167, 1.74077}, {589.259, 1.73737},
    {632.874, 1.7346},  {643.718, 1.734},   {656.326, 1.73335}, {667.636, 1.73277}, {690.696, 1.73191},
    {706.439, 1.73101}, {767.678, 1.72872}};
// The k of this oxide is zero above 345 nm except for two stray samples of the table, which are omitted.
constexpr Sample kTitaniumDioxide[] = {
    {344.007, 4.36}, {359.988, 3.87}, {388.044, 3.49}, {399.935, 3.4},  {412.031, 3.24}, {419.986, 3.29},
    {439.957, 3.2},  {460.037, 3.13}, {479.985, 3.08}, {499.919, 3.03}, {520.05, 3.0},   {539.044, 2.95},
    {539.983, 2.97}, {559.982, 2.94}, {579.888, 2.92}, {600.097, 2.9},  {619.9, 2.88},   {640.062, 2.87},
    {659.819, 2.85}, {680.088, 2.84}, {700.056, 2.83}, {719.977, 2.82}, {740.179, 2.81}, {760.147, 2.81},
    {779.748, 2.8},  {799.871, 2.79}, {819.974, 2.79}, {839.973, 2.78}};

// Converts samples by photon energy to a spectrum by wavelength.
Spectrum by_energy(const double (&values)[kRows]) {
  constexpr double kNanometreElectronvolts = 1239.84198;  // h c
  std::vector<double> wavelengths;
  for (int i = 0; i < kRows; ++i) wavelengths.push_back(kNanometreElectronvolts / (3.45 - 0.05 * i));
  return sampled_spectrum(wavelengths, values);
}

// Beyond the samples the end values are repeated: an index of zero would not be a metal.
Spectrum by_wavelength(std::span<const Sample> samples) {
  std::vector<double> wavelengths{double(kFirstNanometre) - 30}, values{samples.front().eta};
  for (const Sample& s : samples) {
    wavelengths.push_back(s.nanometres);
    values.push_back(s.eta);
  }
  wavelengths.push_back(double(kLastNanometre) + 30);
  values.push_back(samples.back().eta);
  return sampled_spectrum(wavelengths, values);
}

MetalIndex metal(std::string_view name, const Row& row) {
  return {name, by_energy(row.eta), by_energy(row.k)};
}

}  // namespace

const std::array<MetalIndex, 6>& metals() {
  static const std::array<MetalIndex, 6> all = {
      metal("Ag", kSilver),
      metal("Al", kAluminium),
      metal("Au", kGold),
      metal("Cu", kCopper),
      MetalIndex{"MgO", by_wavelength(kMagnesiumOxide), Spectrum{}},
      MetalIndex{"TiO2", by_wavelength(kTitaniumDioxide), Spectrum{}}};
  return all;
}

}  // namespace kaustik
