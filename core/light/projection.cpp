// Projected images: solid angles of their pixels, and sampling.

#include "core/light/projection.h"

#include <glm/gtc/constants.hpp>

namespace kaustik {
namespace {

constexpr int kFewestCells = 64;  // along the shorter side

// Signed solid angle, seen from the origin, of the rectangle between (0, 0) and (x, y) on the plane z = 1.
double corner_solid_angle(double x, double y) {
  return std::atan(x * y / std::sqrt(1 + x * x + y * y));
}

double solid_angle(double x0, double x1, double y0, double y1) {
  return corner_solid_angle(x1, y1) - corner_solid_angle(x0, y1) - corner_solid_angle(x1, y0) +
         corner_solid_angle(x0, y0);
}

// Coordinate of edge i of n equal cells on [-half, half].
double edge(int i, int n, double half) {
  return half * (2.0 * i / n - 1);
}

}  // namespace

ProjectedImage::ProjectedImage(std::shared_ptr<const LightImage> image, double fov)
    : image_(std::move(image)) {
  const int shorter = std::min(image_->width, image_->height);
  const double tangent = std::tan(glm::radians(fov) / 2);
  const glm::dvec2 half = tangent * glm::dvec2(image_->width, image_->height) / static_cast<double>(shorter);
  half_ = Point2(half);
  per_pixel_ = (kFewestCells + shorter - 1) / shorter;
  const int columns = per_pixel_ * image_->width, rows = per_pixel_ * image_->height;
  glm::dvec3 sum(0);
  cells_ = PiecewiseConstant2D(columns, rows, [&](int x, int y) {
    const Rgb& c = image_->at(x / per_pixel_, y / per_pixel_);
    const double angle = solid_angle(edge(x, columns, half.x), edge(x + 1, columns, half.x),
                                     edge(y, rows, half.y), edge(y + 1, rows, half.y));
    sum += angle * glm::dvec3(c);
    brightest_ = glm::max(brightest_, c);
    return angle * static_cast<double>(luminance(c));
  });
  integral_ = Rgb(sum);
}

Rgb ProjectedImage::value(const Vector3& w) const {
  if (!(w.z > 0)) return Rgb(0);
  const Point2 at(w.x / w.z / half_.x, -w.y / w.z / half_.y);
  if (!(std::abs(at.x) <= 1 && std::abs(at.y) <= 1)) return Rgb(0);
  const auto pixel = [](float s, int n) {
    return std::min(n - 1, static_cast<int>(0.5f * (s + 1) * static_cast<float>(n)));
  };
  return image_->at(pixel(at.x, image_->width), pixel(at.y, image_->height));
}

ProjectedImage::Sample ProjectedImage::sample(const Point2& u) const {
  const PiecewiseConstant2D::Sample s = cells_.sample(u);
  const auto on_plane = [](int cell, float in_cell, int n, float half) {
    return half * (2 * (static_cast<float>(cell) + in_cell) / static_cast<float>(n) - 1);
  };
  const Vector3 v(on_plane(s.x, s.in_cell.x, cells_.width(), half_.x),
                  -on_plane(s.y, s.in_cell.y, cells_.height(), half_.y), 1);
  const float length2 = length_squared(v), length = std::sqrt(length2);
  const float cell_area =
      4 * half_.x * half_.y / static_cast<float>(cells_.width()) / static_cast<float>(cells_.height());
  // The pdf uses dw = cos^3 dA on the plane z = 1.
  return {v / length, image_->at(s.x / per_pixel_, s.y / per_pixel_),
          s.probability / cell_area * (length * length2)};
}

float ProjectedImage::least_cosine() const {
  return 1 / std::sqrt(1 + glm::dot(half_, half_));
}

std::optional<LightSample> ProjectionLight::sample_Li(const Point3& ref, const Point2& /*u*/) const {
  return sample_point_light(position, ref, [&](const Vector3& w) { return intensity(w); });
}

std::optional<EmissionSample> ProjectionLight::sample_Le(const Point2& /*u_pos*/, const Point2& u_dir,
                                                         EmissionMode /*mode*/) const {
  const ProjectedImage::Sample s = image->sample(u_dir);
  if (is_black(s.value)) return std::nullopt;
  return EmissionSample{{position, to_world * s.w}, (scale / s.pdf) * s.value};
}

std::optional<LightBounds> ProjectionLight::bounds() const {
  LightBounds b = bounds_of_point(position, power());
  b.phi *= 0.5f * kInvPi;
  b.w = to_world[2];
  b.cos_o = image->least_cosine();
  b.cos_e = 1;
  return b;
}

}  // namespace kaustik
