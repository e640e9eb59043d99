// FLIP in the steps of the paper's reference implementation: sections are those of Andersson et al. 2020.

#include "render/compare/flip.h"

#include <tbb/blocked_range.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/parallel/parallel.h"
#include "core/spectrum/colour_space.h"
#include "core/spectrum/srgb.h"
#include "render/compare/gaussian_filter.h"
#include "render/picture/colour_ramp.h"
#include "render/picture/tonemap.h"

namespace kaustik::render {

namespace {

using Pixels = std::vector<glm::vec3>;

const glm::dmat3& rgb_to_xyz() {
  static const glm::dmat3 matrix = find_colour_space("srgb")->to_xyz;
  return matrix;
}
// XYZ relative to the screen's white.
glm::vec3 relative_xyz(const glm::vec3& rgb) {
  static const glm::dvec3 white = rgb_to_xyz() * glm::dvec3(1);
  return glm::vec3(rgb_to_xyz() * glm::dvec3(rgb) / white);
}
glm::vec3 rgb_from_relative_xyz(const glm::vec3& xyz) {
  static const glm::dvec3 white = rgb_to_xyz() * glm::dvec3(1);
  static const glm::dmat3 inverse = glm::inverse(rgb_to_xyz());
  return glm::vec3(inverse * (glm::dvec3(xyz) * white));
}

// The opponent space YyCxCz, a linear L*a*b*.
glm::vec3 opponent(const glm::vec3& rgb) {
  const glm::vec3 xyz = relative_xyz(rgb);
  return {116 * xyz.y - 16, 500 * (xyz.x - xyz.y), 200 * (xyz.y - xyz.z)};
}
glm::vec3 rgb_from_opponent(const glm::vec3& c) {
  const float y = (c.x + 16) / 116;
  return rgb_from_relative_xyz({y + c.y / 500, y, y - c.z / 200});
}

// L*a*b*, with a* and b* scaled by L*: colours look less colourful where they are dark (Hunt).
glm::vec3 perceived(const glm::vec3& rgb) {
  constexpr float kBend = 6.0f / 29;
  const auto f = [](float t) {
    return t > kBend * kBend * kBend ? std::cbrt(t) : t / (3 * kBend * kBend) + 4.0f / 29;
  };
  const glm::vec3 xyz = relative_xyz(rgb);
  const float L = 116 * f(xyz.y) - 16;
  return {L, 0.01f * L * 500 * (f(xyz.x) - f(xyz.y)), 0.01f * L * 200 * (f(xyz.y) - f(xyz.z))};
}

// The HyAB distance, to the power of 0.7 (section 4.1.3).
float colour_distance(const glm::vec3& a, const glm::vec3& b) {
  const glm::vec3 d = a - b;
  return std::pow(std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z), 0.7f);
}

// The distance of the two most different colours, green and blue, becomes 1; 0.4 of it becomes 0.95.
float redistributed(float distance) {
  static const float largest = colour_distance(perceived({0, 1, 0}), perceived({0, 0, 1}));
  constexpr float kShare = 0.4f, kBecomes = 0.95f;
  const float knee = kShare * largest;
  if (distance < knee) return kBecomes / knee * distance;
  return std::min(1.0f, kBecomes + (distance - knee) / (largest - knee) * (1 - kBecomes));
}

// What the eye resolves of each channel: sums of Gaussians, a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees
// (table 1).
struct Sensitivity {
  double a, b;
};
constexpr std::array<std::array<Sensitivity, 2>, 3> kSensitivities = {
    {{{{1, 0.0047}, {0, 1e-5}}}, {{{1, 0.0053}, {0, 1e-5}}}, {{{34.1, 0.04}, {13.5, 0.025}}}}};
constexpr double kWidest = 0.04;

constexpr double kSquaredPi = std::numbers::pi * std::numbers::pi;

// Blurs as the eye does, then clamps to the colours of the screen and converts to perceived ones.
Pixels seen_colours(const Pixels& colours, int width, int height, double pixels_per_degree) {
  const int reach = int(std::ceil(3 * std::sqrt(kWidest / (2 * kSquaredPi)) * pixels_per_degree));
  Pixels seen(colours.size(), glm::vec3(0));
  for (int c = 0; c < 3; ++c) {
    // Each Gaussian is normalised, so its weight is its own sum in two dimensions.
    std::array<double, 2> weights{};
    std::array<std::vector<float>, 2> rows;
    for (size_t i = 0; i < 2; ++i) {
      const auto [a, b] = kSensitivities[size_t(c)][i];
      double sum = 0;
      rows[i] = gaussian(reach, pixels_per_degree * std::sqrt(b / (2 * kSquaredPi)), &sum);
      weights[i] = a * std::sqrt(std::numbers::pi / b) * sum * sum;
    }
    const double total = weights[0] + weights[1];
    for (size_t i = 0; i < 2; ++i)
      if (weights[i] > 0)
        add_filtered(colours, c, width, height, rows[i], rows[i], float(weights[i] / total), &seen);
  }
  parallel::for_index(size_t{0}, seen.size(), [&](size_t i) {
    seen[i] = perceived(glm::clamp(rgb_from_opponent(seen[i]), 0.0f, 1.0f));
  });
  return seen;
}

// How strong edges and points are: x and y hold the lengths of their gradients (section 4.2).
std::vector<glm::vec2> features_of(const Pixels& colours, int width, int height, double pixels_per_degree) {
  constexpr double kFeatureDegrees = 0.082;
  const double sigma = 0.5 * kFeatureDegrees * pixels_per_degree;
  const int reach = int(std::ceil(3 * sigma));
  const std::vector<float> smooth = gaussian(reach, sigma);
  std::array<std::vector<float>, 2> derivatives = {std::vector<float>(smooth.size()),
                                                   std::vector<float>(smooth.size())};
  for (int x = -reach; x <= reach; ++x) {
    const double g = std::exp(-0.5 * x * x / (sigma * sigma));
    derivatives[0][size_t(x + reach)] = float(-x * g);
    derivatives[1][size_t(x + reach)] = float((x * x / (sigma * sigma) - 1) * g);
  }
  Pixels luminance(colours.size());
  for (size_t i = 0; i < colours.size(); ++i) luminance[i].x = (colours[i].x + 16) / 116;
  std::vector<glm::vec2> features(colours.size());
  for (int kind = 0; kind < 2; ++kind) {
    normalise_signs(&derivatives[size_t(kind)]);
    Pixels along_x(colours.size(), glm::vec3(0)), along_y = along_x;
    add_filtered(luminance, 0, width, height, derivatives[size_t(kind)], smooth, 1, &along_x);
    add_filtered(luminance, 0, width, height, smooth, derivatives[size_t(kind)], 1, &along_y);
    for (size_t i = 0; i < features.size(); ++i) features[i][kind] = std::hypot(along_x[i].x, along_y[i].x);
  }
  return features;
}

// The pixels that compare, in the opponent space.
Pixels opponent_pixels(const Image& image, const std::vector<bool>& compares) {
  Pixels pixels(image.pixels.size());
  for (size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = opponent(compares[i] ? glm::clamp(image.pixels[i], 0.0f, 1.0f) : Rgb(0));
  return pixels;
}

std::vector<float> errors(const Image& reference, const Image& image, const std::vector<bool>& compares,
                          const FlipSettings& settings) {
  const int width = reference.width, height = reference.height;
  const double ppd = settings.pixels_per_degree;
  const Pixels r = opponent_pixels(reference, compares), t = opponent_pixels(image, compares);
  const Pixels seen_r = seen_colours(r, width, height, ppd), seen_t = seen_colours(t, width, height, ppd);
  const auto features_r = features_of(r, width, height, ppd), features_t = features_of(t, width, height, ppd);
  std::vector<float> error(r.size());
  for (size_t i = 0; i < error.size(); ++i) {
    const float colour = redistributed(colour_distance(seen_r[i], seen_t[i]));
    const glm::vec2 d = glm::abs(features_r[i] - features_t[i]);
    const float feature = std::sqrt(std::min(std::max(d.x, d.y) / std::sqrt(2.0f), 1.0f));
    error[i] = std::pow(colour, 1 - feature);
  }
  return error;
}

double mean_of(const std::vector<float>& error, const std::vector<bool>& compares) {
  double sum = 0, count = 0;
  for (size_t i = 0; i < error.size(); ++i)
    if (compares[i]) sum += double(error[i]), ++count;
  return count > 0 ? sum / count : 0;
}

// FLIP shows radiance by the filmic curve, with the exposure of 0.6 that the curve undoes.
constexpr double kFilmicExposure = 0.6;

Exposures exposures_of(const Image& reference, const std::vector<bool>& compares) {
  std::vector<double> luminances;
  for (size_t i = 0; i < compares.size(); ++i)
    if (compares[i]) luminances.push_back(std::max(0.0, double(luminance(reference.pixels[i]))));
  std::sort(luminances.begin(), luminances.end());
  if (luminances.empty() || !(luminances.back() > 0)) return {};
  const size_t half = luminances.size() / 2;
  const double median =
      luminances.size() % 2 ? luminances[half] : (luminances[half - 1] + luminances[half]) / 2;
  constexpr double kMostStops = 31;
  const double shown = before_filmic(0.85) / kFilmicExposure, start = std::log2(shown / luminances.back());
  const double stop = std::min(start + kMostStops, std::log2(shown / median));  // a black median: infinite
  return {start, stop, std::max(2, int(std::ceil(stop - start)))};
}

Image displayed(const Image& radiance, double exposure) {
  const ToneSettings tone{float(exposure + std::log2(kFilmicExposure)), Tonemap::kFilmic};
  Image out(radiance.width, radiance.height);
  std::transform(radiance.pixels.begin(), radiance.pixels.end(), out.pixels.begin(),
                 [&](const Rgb& p) { return tonemap(p, tone); });
  return out;
}

}  // namespace

Flip flip_of_display(const Image& reference, const Image& image, const FlipSettings& settings,
                     const CompareOptions& options) {
  const std::vector<bool> compares = compared_pixels(reference, image, options);
  Flip flip;
  flip.error = errors(reference, image, compares, settings);
  flip.mean = mean_of(flip.error, compares);
  return flip;
}

Flip flip_of_radiance(const Image& reference, const Image& image, const FlipSettings& settings,
                      const CompareOptions& options) {
  const std::vector<bool> compares = compared_pixels(reference, image, options);
  Flip flip;
  flip.exposures = exposures_of(reference, compares);
  flip.error.assign(reference.pixels.size(), 0);
  const auto& [start, stop, count] = *flip.exposures;
  for (int i = 0; i < count; ++i) {
    const double exposure = count > 1 ? start + (stop - start) * i / (count - 1) : start;
    const std::vector<float> error =
        errors(displayed(reference, exposure), displayed(image, exposure), compares, settings);
    for (size_t k = 0; k < error.size(); ++k) flip.error[k] = std::max(flip.error[k], error[k]);
  }
  flip.mean = mean_of(flip.error, compares);
  return flip;
}

Image flip_colours(const Flip& flip, int width, int height) {
  // Every 32nd of the 256 colours of matplotlib's magma, and the last, as 8-bit sRGB.
  constexpr std::array<std::array<float, 3>, 9> kMagma = {{{0, 0, 4},
                                                           {28, 16, 68},
                                                           {79, 18, 123},
                                                           {129, 37, 129},
                                                           {181, 54, 122},
                                                           {229, 80, 100},
                                                           {251, 135, 97},
                                                           {254, 194, 135},
                                                           {252, 253, 191}}};
  Image out(width, height);
  for (size_t i = 0; i < out.pixels.size(); ++i) {
    const Rgb encoded = colour_on_ramp(kMagma, flip.error[i]) / 255.0f;
    for (int c = 0; c < 3; ++c) out.pixels[i][c] = linear_from_srgb(encoded[c]);
  }
  return out;
}

}  // namespace kaustik::render
