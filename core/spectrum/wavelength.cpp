#include "core/spectrum/wavelength.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/spectrum/colour_space.h"
#include "core/spectrum/spectrum.h"

namespace kaustik {
namespace {

constexpr size_t kNanometres = kLastNanometre - kFirstNanometre + 1;

// The spectra of red and blue from 380 nm to 780 nm in steps of 10 nm, constant beyond and linear between;
// that of green is what is missing to one. Of all that fulfil the conditions they have the least sum of
// squared differences between neighbours: the solution of a quadratic program, rounded.
constexpr double kRed[] = {
    0.0266, 0.0266, 0.0266, 0.0263, 0.0254, 0.0231, 0.0195, 0.0188, 0.0305, 0.0124, 0, 0, 0, 0,
    0,      0,      0,      0,      0,      0.0187, 0.2085, 0.4769, 0.7365, 0.9218, 1, 1, 1, 1,
    1,      1,      1,      1,      1,      1,      1,      1,      1,      1,      1, 1, 1};
constexpr double kBlue[] = {0.9734, 0.9734, 0.9734, 0.9737, 0.9746, 0.9769, 0.9805, 0.9812, 0.9695,
                            0.8753, 0.7024, 0.4914, 0.2853, 0.1151, 0.0116, 0,      0,      0,
                            0,      0.0462, 0.0516, 0.0345, 0.0128, 0,      0,      0,      0,
                            0,      0,      0,      0,      0,      0,      0,      0,      0,
                            0,      0,      0,      0,      0};
constexpr double kFirstOfTable = 380, kStepOfTable = 10;

double interpolated(std::span<const double> table, double nm) {
  const double x = std::clamp((nm - kFirstOfTable) / kStepOfTable, 0.0, double(table.size() - 1));
  const size_t i = std::min(static_cast<size_t>(x), table.size() - 2);
  const double t = x - double(i);
  return (1 - t) * table[i] + t * table[i + 1];
}

// One bin of a nanometre.
struct Bin {
  Rgb rho;       // the spectra of red, green and blue
  Rgb colour;    // of white's light in the bin, over the bin's probability
  double up_to;  // probability of this bin and those before
};

glm::dvec3 spectra_at(double nm) {
  const double red = interpolated(kRed, nm), blue = interpolated(kBlue, nm);
  return {red, std::max(1 - red - blue, 0.0), blue};
}

// The colour of the part of D65's light that lies in each bin; the sum is white.
std::vector<glm::dvec3> colours_of_white() {
  const Spectrum white = daylight(6500);
  const double luminance = tristimulus(white).y;
  std::vector<glm::dvec3> colours(kNanometres);
  for (size_t i = 0; i < kNanometres; ++i) {
    Spectrum part;
    part.values[i] = white.values[i];
    colours[i] = xyz_to_ours() * (tristimulus(part) / luminance);
  }
  return colours;
}

std::vector<Bin> make_bins() {
  std::vector<glm::dvec3> colours = colours_of_white();
  // The rounding of the tables changes colours by some 1e-5; this undoes it.
  glm::dmat3 seen(0);  // columns: what the observer sees of red, green and blue
  for (size_t i = 0; i < kNanometres; ++i)
    seen += glm::outerProduct(colours[i], spectra_at(kFirstNanometre + double(i)));
  const glm::dmat3 exact = glm::inverse(seen);
  double sum = 0;
  for (glm::dvec3& c : colours) sum += glm::length(c = exact * c);
  std::vector<Bin> bins(kNanometres);
  double before = 0;
  for (size_t i = 0; i < kNanometres; ++i) {
    const double p = glm::length(colours[i]) / sum;
    bins[i] = {Rgb(spectra_at(kFirstNanometre + double(i))), Rgb(colours[i] / p), before + p};
    before += p;
  }
  return bins;
}

const std::vector<Bin>& bins() {
  static const std::vector<Bin> all = make_bins();
  return all;
}

// The bin that holds a number, found from one near it (Chen and Asau 1974).
class BinSearch {
 public:
  BinSearch() {
    for (const Bin& bin : bins()) up_to_.push_back(bin.up_to);
    up_to_.back() = 1;
    for (size_t i = 0; i < first_.size(); ++i) {
      const auto found = std::upper_bound(up_to_.begin(), up_to_.end(), double(i) / double(first_.size()));
      first_[i] = static_cast<uint32_t>(found - up_to_.begin());
    }
  }
  // u: in [0, 1).
  size_t bin_of(double u) const {
    size_t bin = first_[static_cast<size_t>(u * double(first_.size()))];
    while (!(u < up_to_[bin])) ++bin;
    return bin;
  }

 private:
  std::vector<double> up_to_;
  std::array<uint32_t, 1024> first_{};  // the bins of the multiples of 1/1024
};

const BinSearch& bin_search() {
  static const BinSearch search;
  return search;
}

}  // namespace

float sample_wavelength(float u) {
  const std::vector<Bin>& all = bins();
  const size_t bin = bin_search().bin_of(double(u));
  const double before = bin == 0 ? 0 : all[bin - 1].up_to;
  // Rounding must not lead into the next bin.
  const double t = std::clamp((double(u) - before) / (all[bin].up_to - before), 0.001, 0.999);
  return static_cast<float>(kFirstNanometre + double(bin) - 0.5 + t);
}

Rgb at_wavelength(const Rgb& c, float wavelength) {
  const auto i = static_cast<size_t>(std::lround(wavelength - float(kFirstNanometre)));
  const Bin& bin = bins()[std::min(i, kNanometres - 1)];
  return glm::dot(bin.rho, c) * bin.colour;
}

}  // namespace kaustik
