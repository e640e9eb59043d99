#include "apps/import/pbrt/curves/tubes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace kaustik::pbrt {
namespace {

glm::dvec3 point_of(const CurveSegment& s, double t) {
  const double r = 1 - t;
  return r * r * r * s.P[0] + 3 * r * r * t * s.P[1] + 3 * r * t * t * s.P[2] + t * t * t * s.P[3];
}

// The direction of the curve; that of its chord where control points coincide.
glm::dvec3 direction_of(const CurveSegment& s, double t) {
  const double r = 1 - t;
  const glm::dvec3 d = r * r * (s.P[1] - s.P[0]) + 2 * r * t * (s.P[2] - s.P[1]) + t * t * (s.P[3] - s.P[2]);
  const glm::dvec3 along = glm::length(d) > 0 ? d : s.P[3] - s.P[0];
  return glm::length(along) > 0 ? glm::normalize(along) : glm::dvec3(0, 0, 1);
}

// Wang's bound: as many steps keep chords of a cubic within the tolerance.
int steps_of(const CurveSegment& s, const TubeDetail& detail) {
  const double bend =
      std::max(glm::length(s.P[0] - 2.0 * s.P[1] + s.P[2]), glm::length(s.P[1] - 2.0 * s.P[2] + s.P[3]));
  const double tolerance = detail.tolerance * std::max(s.width0, s.width1);
  if (!(tolerance > 0)) return 1;
  return int(std::clamp(std::ceil(std::sqrt(0.75 * bend / tolerance)), 1.0, double(detail.most_steps)));
}

glm::dvec3 across(const glm::dvec3& v, const glm::dvec3& d) {
  const glm::dvec3 part = v - glm::dot(v, d) * d;
  const double length = glm::length(part);
  if (length > 1e-6) return part / length;
  const glm::dvec3 other = std::abs(d.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(d, other));
}

class TubeMaker {
 public:
  explicit TubeMaker(const TubeDetail& detail)
      : detail_(detail),
        sides_(detail.sides),
        wider_(std::numbers::pi / (detail.sides * std::sin(std::numbers::pi / detail.sides))) {}

  void add(const CurveSegment& s) {
    const int steps = steps_of(s, detail_);
    if (!s.continues) has_ring_ = false;
    for (int i = has_ring_ ? 1 : 0; i <= steps; ++i) {
      const double t = i / double(steps), width = std::lerp(s.width0, s.width1, t);
      const glm::dvec3 p = point_of(s, t), d = direction_of(s, t);
      const bool ribbon = s.n0 != glm::vec3(0) || s.n1 != glm::vec3(0);
      const Ring ring = ribbon ? ribbon_ring(p, d, glm::mix(glm::dvec3(s.n0), glm::dvec3(s.n1), t), width)
                               : tube_ring(p, d, width);
      if (has_ring_) join(last_, ring);
      last_ = ring;
      has_ring_ = true;
    }
  }
  TubeMesh take() { return std::move(mesh_); }

 private:
  // Corners around the curve, or the two edges of a ribbon.
  struct Ring {
    size_t first = 0;
    int count = 0;
    bool closed = false, point = false;
  };

  void corner(const glm::dvec3& p, const glm::dvec3& n) {
    mesh_.P.insert(mesh_.P.end(), {p.x, p.y, p.z});
    mesh_.N.insert(mesh_.N.end(), {n.x, n.y, n.z});
  }

  // The section turns as little as possible from one ring to the next.
  Ring tube_ring(const glm::dvec3& p, const glm::dvec3& d, double width) {
    const Ring ring{mesh_.P.size() / 3, sides_, true, !(width > 0)};
    x_ = across(has_ring_ ? x_ : glm::dvec3(0), d);
    const glm::dvec3 y = glm::cross(d, x_);
    for (int k = 0; k < sides_; ++k) {
      const double phi = 2 * std::numbers::pi * k / sides_;
      const glm::dvec3 n = std::cos(phi) * x_ + std::sin(phi) * y;
      corner(p + 0.5 * width * wider_ * n, n);
    }
    return ring;
  }

  Ring ribbon_ring(const glm::dvec3& p, const glm::dvec3& d, const glm::dvec3& normal, double width) {
    const Ring ring{mesh_.P.size() / 3, 2, false, !(width > 0)};
    const glm::dvec3 n = across(normal, d), side = glm::cross(n, d);
    corner(p - 0.5 * width * side, n);
    corner(p + 0.5 * width * side, n);
    return ring;
  }

  void triangle(size_t a, size_t b, size_t c) {
    mesh_.indices.insert(mesh_.indices.end(), {double(a), double(b), double(c)});
  }

  // A ring without width is one point: only the triangles that meet there are left.
  void join(const Ring& from, const Ring& to) {
    const int pairs = from.closed ? from.count : from.count - 1;
    for (int k = 0; k < pairs; ++k) {
      const auto a = static_cast<size_t>(k), b = static_cast<size_t>((k + 1) % from.count);
      if (!from.point) triangle(from.first + a, from.first + b, to.first + b);
      if (!to.point) triangle(from.first + a, to.first + b, to.first + a);
    }
  }

  TubeDetail detail_;
  int sides_;
  double wider_;  // the circumscribed circle's radius over the round tube's
  TubeMesh mesh_;
  Ring last_;
  bool has_ring_ = false;
  glm::dvec3 x_{0};
};

}  // namespace

TubeMesh tubes_of(const std::vector<CurveSegment>& segments, const TubeDetail& detail) {
  TubeMaker maker(detail);
  for (const CurveSegment& s : segments) maker.add(s);
  return maker.take();
}

}  // namespace kaustik::pbrt
