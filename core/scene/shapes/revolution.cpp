// Cones, paraboloids and hyperboloids as triangles.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/scene/shapes/parametric.h"

namespace kaustik {
namespace {

constexpr int kColumnsPerTurn = 256, kRows = 64;

// The point at azimuth phi of the profile's point (x, y, z), whose normal at azimuth 0 is n.
ParametricPoint turned(const glm::dvec3& p, const glm::dvec3& n, double phi, const Point2& uv) {
  const double c = std::cos(phi), s = std::sin(phi);
  const auto turn = [&](const glm::dvec3& v) {
    return glm::dvec3(c * v.x - s * v.y, s * v.x + c * v.y, v.z);
  };
  return {turn(p), turn(n), uv};
}

// profile(t): the point and normal at azimuth 0, and v as uv.y. A full turn closes exactly.
TriangleMesh revolve(const ParameterReader& p, int rows,
                     const std::function<ParametricPoint(double)>& profile) {
  const double turn = glm::radians(p.number("phimax"));
  const bool full = p.number("phimax") == 360;
  const int columns = std::max(1, int(std::ceil(kColumnsPerTurn * p.number("phimax") / 360)));
  return grid_of(columns, rows, [&](double s, double t) {
    const ParametricPoint at = profile(t);
    return turned(at.p, at.n, full && s == 1 ? 0 : s * turn, {static_cast<float>(s), at.uv.y});
  });
}

}  // namespace

TriangleMesh grid_of(int columns, int rows, const std::function<ParametricPoint(double, double)>& surface) {
  TriangleMesh mesh;
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j <= columns; ++j) {
      const ParametricPoint at = surface(j / double(columns), i / double(rows));
      const double length = glm::length(at.n);
      mesh.P.push_back(Point3(at.p));
      mesh.N.push_back(length > 0 ? Normal3(at.n / length) : Normal3(0));
      mesh.uv.push_back(at.uv);
    }
  }
  const auto corner = [&](int i, int j) { return static_cast<uint32_t>(i * (columns + 1) + j); };
  const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
    const glm::dvec3 e1(mesh.P[b] - mesh.P[a]), e2(mesh.P[c] - mesh.P[a]);
    if (glm::cross(e1, e2) != glm::dvec3(0)) mesh.indices.push_back({a, b, c});
  };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      add(corner(i, j), corner(i, j + 1), corner(i + 1, j + 1));
      add(corner(i, j), corner(i + 1, j + 1), corner(i + 1, j));
    }
  }
  return mesh;
}

std::optional<TriangleMesh> make_cone(const ParameterReader& p, DiagnosticList& /*diagnostics*/) {
  const double radius = p.number("radius"), height = p.number("height");
  return revolve(p, 1, [&](double v) {
    return ParametricPoint{
        {(1 - v) * radius, 0, v * height}, {height, 0, radius}, {0, static_cast<float>(v)}};
  });
}

std::optional<TriangleMesh> make_paraboloid(const ParameterReader& p, DiagnosticList& diagnostics) {
  const double radius = p.number("radius");
  const double low = std::min(p.number("zmin"), p.number("zmax")),
               top = std::max(p.number("zmin"), p.number("zmax"));
  if (!(low >= 0 && low < top)) {
    diagnostics.error(p.location("zmin"),
                      fmt::format("no part of the paraboloid lies between `zmin` = {} and `zmax` = {}: "
                                  "expected 0 <= zmin < zmax",
                                  p.number("zmin"), p.number("zmax")));
    return std::nullopt;
  }
  // Rows are even in the distance from the axis, which is radius at the top.
  const double inner = radius * std::sqrt(low / top), slope = radius * radius / (2 * top);
  return revolve(p, kRows, [&](double t) {
    const double r = std::lerp(inner, radius, t), z = top * r * r / (radius * radius);
    return ParametricPoint{{r, 0, z}, {r, 0, -slope}, {0, static_cast<float>((z - low) / (top - low))}};
  });
}

std::optional<TriangleMesh> make_hyperboloid(const ParameterReader& p, DiagnosticList& diagnostics) {
  const glm::dvec3 from = p.vec3("p1"), along = p.vec3("p2") - from;
  const bool on_axis = std::max(glm::length(glm::dvec2(from)), glm::length(glm::dvec2(p.vec3("p2")))) == 0;
  if (along == glm::dvec3(0) || on_axis) {
    diagnostics.error(p.location("p1"), "the line from `p1` to `p2` sweeps no surface about the z axis");
    return std::nullopt;
  }
  // Its lines are straight: rows are as many as there are columns from one end of a line to the other.
  const glm::dvec2 a(from), b(p.vec3("p2"));
  const double twist = std::abs(std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b)));
  const int rows = std::clamp(int(std::ceil(kColumnsPerTurn * twist / (2 * std::numbers::pi))), 1, kRows);
  return revolve(p, rows, [&](double v) {
    const glm::dvec3 at = from + v * along;
    return ParametricPoint{at, glm::cross(glm::dvec3(-at.y, at.x, 0), along), {0, static_cast<float>(v)}};
  });
}

}  // namespace kaustik
