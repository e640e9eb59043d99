// Variance and bias from the moments of several images, and the noise of a reference.

#include "render/compare/error_parts.h"

#include <cmath>
#include <stdexcept>

namespace kaustik::render {

ErrorPartsSum::ErrorPartsSum(const Image& reference, const CompareOptions& options)
    : reference_(reference),
      masked_(masked_pixels(reference, options)),
      finite_(reference.pixels.size()),
      moments_(reference.pixels.size()) {
  for (size_t i = 0; i < finite_.size(); ++i) finite_[i] = is_finite(reference.pixels[i]);
}

void ErrorPartsSum::add(const Image& image) {
  if (image.width != reference_.width || image.height != reference_.height)
    throw std::invalid_argument("the image's size differs from the reference's");
  ++images_;
  for (size_t i = 0; i < moments_.size(); ++i) {
    if (!is_finite(image.pixels[i])) finite_[i] = false;
    if (!finite_[i]) continue;
    const glm::dvec3 value(image.pixels[i]), off = value - moments_[i].mean;
    moments_[i].mean += off / double(images_);
    moments_[i].squares += off * (value - moments_[i].mean);
  }
}

ErrorParts ErrorPartsSum::parts() const {
  ErrorParts out;
  out.images = images_;
  const double n = double(images_);
  double within = 0, between = 0;  // mean squares of the images about their mean; (m - R)^2
  for (size_t i = 0; i < moments_.size(); ++i) {
    out.masked += masked_[i];
    out.not_finite += !finite_[i];
    if (masked_[i] || !finite_[i]) continue;
    ++out.compared;
    for (int c = 0; c < 3; ++c) {
      const double R = reference_.pixels[i][c];
      within += moments_[i].squares[c] / n / (R * R + 0.01);
      between += relative_squared(moments_[i].mean[c], R);
    }
  }
  if (out.compared == 0) return out;
  const double count = 3.0 * double(out.compared);
  out.relmse = (within + between) / count;
  if (images_ < 2) return out;
  out.variance = within * n / (n - 1) / count;
  out.bias2 = between / count - *out.variance / n;
  return out;
}

std::optional<double> relative_noise(const FilmTotals& totals) {
  const PixelWindow<PixelTotals>& pixels = totals.pixels();
  const Film mean = totals.mean();
  const double unit = std::ldexp(1.0, totals.units().square);
  double sum = 0;
  uint64_t counted = 0;
  for (int y = 0; y < pixels.height(); ++y)
    for (int x = 0; x < pixels.width(); ++x) {
      const PixelTotals& pixel = pixels.at(x, y);
      if (pixel.passes < 2) continue;
      const double passes = double(pixel.passes);
      const Rgb R = mean.at(x, y).radiance();
      for (int c = 0; c < 3; ++c) {
        const double square = pixel.squares[size_t(c)].value(unit) / passes, m = R[c];
        sum += std::max(0.0, square - m * m) / (passes - 1) / (m * m + 0.01);
      }
      counted += 3;
    }
  if (counted == 0) return std::nullopt;
  return sum / double(counted);
}

}  // namespace kaustik::render
