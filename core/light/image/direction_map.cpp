// Pixel layouts of direction maps, and their sampling.

#include "core/light/image/direction_map.h"

#include "core/sampling/equal_area.h"
#include "core/sampling/warp.h"

namespace kaustik {
namespace {

constexpr double kFourPi = 4 * std::numbers::pi;

// z at the upper edge of row y of a latitude-longitude map.
double z_of_row(int y, int height) {
  return y == 0 ? 1 : y == height ? -1 : std::cos(std::numbers::pi * y / height);
}

}  // namespace

DirectionMap::DirectionMap(std::shared_ptr<const LightImage> image, Layout layout, Excess excess)
    : image_(std::move(image)), layout_(layout) {
  glm::dvec3 sum(0);
  pixels_ = PiecewiseConstant2D(image_->width, image_->height, [&](int x, int y) {
    const Rgb& c = image_->at(x, y);
    sum += solid_angle(y) * glm::dvec3(c);
    brightest_ = glm::max(brightest_, c);
    return solid_angle(y) * static_cast<double>(luminance(c));
  });
  mean_ = Rgb(sum / kFourPi);
  if (excess == Excess::kSampled) make_excess();
}

void DirectionMap::make_excess() {
  const auto mean = static_cast<double>(luminance(mean_));
  double sum = 0;
  const auto above_mean = [&](int x, int y) {
    return solid_angle(y) * std::max(0.0, static_cast<double>(luminance(image_->at(x, y))) - mean);
  };
  for (int y = 0; y < image_->height; ++y)
    for (int x = 0; x < image_->width; ++x) sum += above_mean(x, y);
  constexpr double kRounding = 1e-5;  // rounding errors of luminances and their mean
  const double share = mean > 0 ? sum / (kFourPi * mean) : 0;
  if (share < kRounding) return;
  even_share_ = static_cast<float>(1 - share);
  excess_ = PiecewiseConstant2D(image_->width, image_->height, above_mean);
}

double DirectionMap::solid_angle(int y) const {
  if (layout_ == Layout::kEqualArea) return kFourPi / image_->width / image_->height;
  const int height = image_->height;
  return 2 * std::numbers::pi / image_->width * (z_of_row(y, height) - z_of_row(y + 1, height));
}

DirectionMap::Pixel DirectionMap::pixel_of(const Vector3& w) const {
  if (layout_ == Layout::kEqualArea) {
    const Point2 p = equal_area_sphere_to_square(w);
    return {cell_of(p.x, image_->width), cell_of(p.y, image_->height)};
  }
  const float turns = 0.5f * kInvPi * std::atan2(w.y, w.x);
  return {cell_of(turns < 0 ? turns + 1 : turns, image_->width),
          cell_of(std::atan2(std::hypot(w.x, w.y), w.z) * kInvPi, image_->height)};
}

Vector3 DirectionMap::direction(const Pixel& pixel, const Point2& in_pixel) const {
  const float x = (static_cast<float>(pixel.x) + in_pixel.x) / static_cast<float>(image_->width);
  if (layout_ == Layout::kEqualArea)
    return equal_area_square_to_sphere(
        {x, (static_cast<float>(pixel.y) + in_pixel.y) / static_cast<float>(image_->height)});
  // Uniform in z, in double to keep precision at the poles.
  const double top = z_of_row(pixel.y, image_->height), bottom = z_of_row(pixel.y + 1, image_->height);
  const double z = top + static_cast<double>(in_pixel.y) * (bottom - top);
  const double r = std::sqrt(std::max(0.0, (1 - z) * (1 + z)));
  const Point2 cs = cos_sin_turns(x);
  return {static_cast<float>(r) * cs.x, static_cast<float>(r) * cs.y, static_cast<float>(z)};
}

Rgb DirectionMap::value(const Vector3& w) const {
  const Pixel p = pixel_of(w);
  return image_->at(p.x, p.y);
}

DirectionMap::Sample DirectionMap::sample(const Point2& u) const {
  const PiecewiseConstant2D::Sample s = pixels_.sample(u);
  const float pdf = s.probability / static_cast<float>(solid_angle(s.y));
  return {direction({s.x, s.y}, s.in_cell), image_->at(s.x, s.y), pdf};
}

float DirectionMap::pdf(const Vector3& w) const {
  const Pixel p = pixel_of(w);
  return pixels_.probability(p.x, p.y) / static_cast<float>(solid_angle(p.y));
}

Vector3 DirectionMap::sample_excess(const Point2& u) const {
  const PiecewiseConstant2D::Sample s = excess_.sample(u);
  return direction({s.x, s.y}, s.in_cell);
}

float DirectionMap::excess_pdf(const Vector3& w) const {
  const Pixel p = pixel_of(w);
  return excess_.probability(p.x, p.y) / static_cast<float>(solid_angle(p.y));
}

double DirectionMap::irradiance() const {
  // Sums the cosine at the middle of each part of a pixel; pixels are divided so that maps of few pixels are
  // accurate.
  constexpr int kFewest = 64;
  const int parts = (kFewest + image_->height - 1) / image_->height;
  double sum = 0;
  for (int y = 0; y < image_->height; ++y) {
    for (int x = 0; x < image_->width; ++x) {
      const double L = static_cast<double>(luminance(image_->at(x, y))) * solid_angle(y) / (parts * parts);
      for (int part = 0; part < parts * parts; ++part) {
        const Point2 at = (Point2(part % parts, part / parts) + 0.5f) / static_cast<float>(parts);
        sum += L * std::max(0.0, static_cast<double>(direction({x, y}, at).z));
      }
    }
  }
  return sum;
}

}  // namespace kaustik
