// NURBS (Piegl and Tiller 1997) and height fields as triangles.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/scene/shapes/parametric.h"

namespace kaustik {
namespace {

constexpr int kMostCells = 512, kFewestCells = 32, kCellsPerSpan = 8;

// One of the two parameters of a NURBS.
struct NurbsAxis {
  size_t count = 0;  // of control points
  int degree = 0;
  std::vector<double> knots;
  double first = 0, last = 1;  // range of the parameter

  int cells() const {
    const int spans = static_cast<int>(std::min<size_t>(count, kMostCells)) - degree;
    return std::clamp(kCellsPerSpan * spans, kFewestCells, kMostCells);
  }
};

// The basis functions that are not zero at one value of the parameter, and their derivatives.
struct NurbsBasis {
  size_t begin = 0;
  std::vector<double> value, slope;
};

double share(double x, double low, double high) {
  return high > low ? (x - low) / (high - low) : 0;
}

// The functions of one degree, by the recursion of Cox and de Boor; out[i] belongs to control point begin +
// i.
std::vector<double> basis_functions(const NurbsAxis& axis, size_t span, int degree, double t) {
  std::vector<double> N = {1};
  const std::vector<double>& u = axis.knots;
  for (int d = 1; d <= degree; ++d) {
    std::vector<double> next(N.size() + 1, 0.0);
    for (size_t k = 0; k < N.size(); ++k) {
      const size_t i = span + 1 - N.size() + k;  // the function of degree d - 1 that starts at knot i
      const double rise = share(t, u[i], u[i + size_t(d)]);
      next[k + 1] += rise * N[k];
      next[k] += (1 - rise) * N[k];
    }
    N = std::move(next);
  }
  return N;
}

NurbsBasis basis_at(const NurbsAxis& axis, double t) {
  const std::vector<double>& u = axis.knots;
  const auto p = static_cast<size_t>(axis.degree);
  size_t span = p;
  while (span + 1 < axis.count && u[span + 1] <= t) ++span;
  while (span > p && u[span] == u[span + 1]) --span;
  NurbsBasis basis{span - p, basis_functions(axis, span, axis.degree, t), std::vector<double>(p + 1, 0.0)};
  if (p == 0) return basis;
  const std::vector<double> lower = basis_functions(axis, span, axis.degree - 1, t);
  for (size_t k = 0; k < lower.size(); ++k) {
    const size_t i = span + 1 - lower.size() + k;
    const double width = u[i + p] - u[i];
    const double change = width > 0 ? axis.degree * lower[k] / width : 0;
    basis.slope[k + 1] += change;
    basis.slope[k] -= change;
  }
  return basis;
}

// `letter`: 'u' or 'v', with which the names of the axis' parameters begin.
std::optional<NurbsAxis> axis_of(const ParameterReader& p, char letter, DiagnosticList& diagnostics) {
  const auto name = [&](std::string_view format) { return fmt::format(fmt::runtime(format), letter); };
  NurbsAxis axis;
  axis.count = static_cast<size_t>(p.number(name("n{}")));
  axis.degree = static_cast<int>(p.number(name("{}order"))) - 1;
  axis.knots = p.numbers(name("{}knots"));
  const size_t expected = axis.count + static_cast<size_t>(axis.degree) + 1;
  if (axis.count <= static_cast<size_t>(axis.degree) || axis.knots.size() != expected ||
      !std::is_sorted(axis.knots.begin(), axis.knots.end())) {
    diagnostics.error(
        p.location(name("{}knots")),
        fmt::format("a NURBS needs as many `n{0}` as `{0}order` at least, and n{0} + {0}order `{0}knots` "
                    "that do not decrease",
                    letter));
    return std::nullopt;
  }
  axis.first = p.has(name("{}0")) ? p.number(name("{}0")) : axis.knots[size_t(axis.degree)];
  axis.last = p.has(name("{}1")) ? p.number(name("{}1")) : axis.knots[axis.count];
  return axis;
}

// Control points in homogeneous coordinates.
std::vector<glm::dvec4> control_points(const ParameterReader& p, const glm::dvec3& origin) {
  const bool weighted = p.has("Pw");
  const std::vector<double>& n = p.numbers(weighted ? "Pw" : "P");
  const size_t size = weighted ? 4 : 3;
  std::vector<glm::dvec4> out(n.size() / size);
  for (size_t i = 0; i < out.size(); ++i) {
    const double w = weighted ? n[size * i + 3] : 1;
    out[i] = {glm::dvec3(n[size * i], n[size * i + 1], n[size * i + 2]) - w * origin, w};
  }
  return out;
}

ParametricPoint nurbs_point(const std::vector<glm::dvec4>& P, size_t row, const NurbsBasis& u,
                            const NurbsBasis& v) {
  glm::dvec4 at(0), du(0), dv(0);
  for (size_t j = 0; j < v.value.size(); ++j) {
    for (size_t i = 0; i < u.value.size(); ++i) {
      const glm::dvec4& p = P[(v.begin + j) * row + u.begin + i];
      at += v.value[j] * u.value[i] * p;
      du += v.value[j] * u.slope[i] * p;
      dv += v.slope[j] * u.value[i] * p;
    }
  }
  const glm::dvec3 p = glm::dvec3(at) / at.w;
  return {p, glm::cross(glm::dvec3(du) - du.w * p, glm::dvec3(dv) - dv.w * p), {}};
}

}  // namespace

std::optional<TriangleMesh> make_nurbs(const ParameterReader& p, const glm::dvec3& origin,
                                       DiagnosticList& diagnostics) {
  const auto u = axis_of(p, 'u', diagnostics), v = axis_of(p, 'v', diagnostics);
  if (!u || !v) return std::nullopt;
  const std::vector<glm::dvec4> P = control_points(p, origin);
  if (P.size() != u->count * v->count) {
    diagnostics.error(p.location(p.has("Pw") ? "Pw" : "P"),
                      fmt::format("a NURBS of {} x {} control points has {}", u->count, v->count, P.size()));
    return std::nullopt;
  }
  return grid_of(u->cells(), v->cells(), [&](double s, double t) {
    const double x = std::lerp(u->first, u->last, s), y = std::lerp(v->first, v->last, t);
    ParametricPoint at = nurbs_point(P, u->count, basis_at(*u, x), basis_at(*v, y));
    at.uv = {static_cast<float>(x), static_cast<float>(y)};
    return at;
  });
}

std::optional<TriangleMesh> make_heightfield(const ParameterReader& p, DiagnosticList& diagnostics) {
  const auto nu = static_cast<size_t>(p.number("nu")), nv = static_cast<size_t>(p.number("nv"));
  const std::vector<double>& heights = p.numbers("Pz");
  if (heights.size() != nu * nv) {
    diagnostics.error(p.location("Pz"),
                      fmt::format("a height field of {} x {} has {} heights", nu, nv, heights.size()));
    return std::nullopt;
  }
  TriangleMesh mesh;
  for (size_t y = 0; y < nv; ++y) {
    for (size_t x = 0; x < nu; ++x) {
      const Point2 uv(double(x) / double(nu - 1), double(y) / double(nv - 1));
      mesh.P.push_back({uv.x, uv.y, static_cast<float>(heights[y * nu + x])});
      mesh.uv.push_back(uv);
    }
  }
  for (size_t y = 0; y + 1 < nv; ++y) {
    for (size_t x = 0; x + 1 < nu; ++x) {
      const auto a = static_cast<uint32_t>(y * nu + x), b = static_cast<uint32_t>(a + nu);
      mesh.indices.push_back({a, a + 1, b + 1});
      mesh.indices.push_back({a, b + 1, b});
    }
  }
  return mesh;
}

}  // namespace kaustik
