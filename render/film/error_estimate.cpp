// Standard errors and kernel bias of pixels from the sums of passes.

#include "render/film/error_estimate.h"

#include <algorithm>
#include <cmath>

#include "render/film/for_each_pixel.h"

namespace kaustik::render {

namespace {

// Statistics of one pixel, before bias is averaged over neighbours.
struct Measured {
  glm::dvec3 mean{0}, variance{kInfinity};  // of the mean over passes
  glm::dvec3 bias{0}, bias_variance{0};
};

// Variance of the mean of n values from their mean and the sum of their squares.
double variance_of_mean(double squares, double mean, double n) {
  return std::max(0.0, (squares - n * mean * mean) / ((n - 1) * n));
}

double sum_value(const PixelTotals& totals, const PixelUnits& units, Layer layer, int channel) {
  const size_t i = sum_of(layer) + size_t(channel);
  return totals.sums[i].value(units.sums[i]);
}

Measured measured(const PixelTotals& totals, const PixelUnits& units) {
  Measured out;
  if (totals.weight == 0) return out;
  const double n = static_cast<double>(totals.passes), weight = static_cast<double>(totals.weight);
  for (int c = 0; c < 3; ++c) {
    double sum = 0;
    for (const Layer layer : {Layer::kEmitted, Layer::kDirect, Layer::kCaustic, Layer::kIndirect})
      sum += sum_value(totals, units, layer, c);
    out.mean[c] = sum / weight;
    out.bias[c] = sum_value(totals, units, Layer::kBias, c) / n;
    if (totals.passes < 2) continue;
    out.variance[c] = variance_of_mean(totals.squares[size_t(c)].value(units.square), out.mean[c], n);
    out.bias_variance[c] =
        variance_of_mean(totals.bias_squares[size_t(c)].value(units.square), out.bias[c], n);
  }
  return out;
}

// Bias averaged over 3 x 3 pixels (cut at the border), with the part that noise explains subtracted.
// Neighbours share photons, so nine of them carry about as much information as three independent pixels.
glm::dvec3 bias_beyond_noise(const PixelWindow<Measured>& film, int x, int y) {
  constexpr double kApart = 3.0 / 9;
  glm::dvec3 bias{0}, variance{0};
  double pixels = 0;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, film.height() - 1); ++v) {
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, film.width() - 1); ++u) {
      bias += film.at(u, v).bias, variance += film.at(u, v).bias_variance;
      ++pixels;
    }
  }
  bias /= pixels, variance /= pixels * std::max(1.0, pixels * kApart);
  glm::dvec3 out{0};
  for (int c = 0; c < 3; ++c)
    out[c] = std::copysign(std::sqrt(std::max(0.0, bias[c] * bias[c] - variance[c])), bias[c]);
  return out;
}

// The smallest radiance that errors are divided by.
double least_radiance(const ErrorMap& errors) {
  double sum = 0;
  for (int y = 0; y < errors.height(); ++y)
    for (int x = 0; x < errors.width(); ++x)
      for (int c = 0; c < 3; ++c) sum += std::abs(double(errors.at(x, y).mean[c]));
  return sum / (3.0 * errors.width() * errors.height()) / 10;
}

}  // namespace

ErrorMap estimate_errors(const FilmTotals& totals) {
  const PixelUnits units(totals.units());
  auto raw = window_of<Measured>(totals.pixels());
  auto errors = window_of<PixelError>(totals.pixels());
  for_each_pixel(raw.width(), raw.height(),
                 [&](int x, int y) { raw.at(x, y) = measured(totals.pixels().at(x, y), units); });
  for_each_pixel(raw.width(), raw.height(), [&](int x, int y) {
    const Measured& m = raw.at(x, y);
    errors.at(x, y) = {Rgb(m.mean), Rgb(glm::sqrt(m.variance)), Rgb(bias_beyond_noise(raw, x, y))};
  });
  return errors;
}

void show_errors(const ErrorMap& errors, Film* film) {
  for (int y = 0; y < film->height(); ++y)
    for (int x = 0; x < film->width(); ++x) {
      film->at(x, y).error = errors.at(x, y).error;
      film->at(x, y).bias = errors.at(x, y).bias;
    }
}

double confidence_factor(uint64_t passes) {
  if (passes < 2) return kInfinity;
  if (passes == 2) return 6.313752;
  if (passes == 3) return 2.919986;
  // Abramowitz and Stegun 1964, 26.7.5, with x the quantile of the normal distribution.
  constexpr double x = 1.644853627, x3 = x * x * x, x5 = x3 * x * x, x7 = x5 * x * x;
  const double n = static_cast<double>(passes - 1);
  return x + (x3 + x) / (4 * n) + (5 * x5 + 16 * x3 + 3 * x) / (96 * n * n) +
         (3 * x7 + 19 * x5 + 17 * x3 - 15 * x) / (384 * n * n * n);
}

double relative_error(const ErrorMap& errors, uint64_t passes, std::optional<double> quantile) {
  const double factor = confidence_factor(passes), least = least_radiance(errors);
  std::vector<double> of_pixels;
  for (int y = 0; y < errors.height(); ++y) {
    for (int x = 0; x < errors.width(); ++x) {
      const PixelError& p = errors.at(x, y);
      if (!is_finite(p.error)) continue;
      double sum = 0;
      for (int c = 0; c < 3; ++c) {
        const double bound = factor * std::hypot(double(p.error[c]), double(p.bias[c]));
        // Estimators that subtract may give negative means, and means may be zero.
        if (bound > 0) sum += bound / std::max(std::abs(double(p.mean[c])), least);
      }
      of_pixels.push_back(sum / 3);
    }
  }
  if (of_pixels.empty()) return kInfinity;
  if (!quantile) {
    double sum = 0;
    for (const double p : of_pixels) sum += p;
    return sum / static_cast<double>(of_pixels.size());
  }
  const auto rank = static_cast<size_t>(std::ceil(*quantile * static_cast<double>(of_pixels.size())));
  const auto at = of_pixels.begin() + std::ptrdiff_t(std::max<size_t>(rank, 1) - 1);
  std::nth_element(of_pixels.begin(), at, of_pixels.end());
  return *at;
}

}  // namespace kaustik::render
