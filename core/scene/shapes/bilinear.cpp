// Divides bilinear patches into triangles, as finely as their twist requires.

#include "core/scene/shapes/bilinear.h"

#include "core/math/error_bounds.h"

namespace kaustik {
namespace {

constexpr double kChordTolerance = 1.0 / 1024;  // relative to the largest distance between two corners

struct Corners {
  glm::dvec3 p00, p10, p01, p11;

  glm::dvec3 twist() const { return p00 - p10 - p01 + p11; }
  glm::dvec3 at(double u, double v) const {
    return (1 - u) * (1 - v) * p00 + u * (1 - v) * p10 + (1 - u) * v * p01 + u * v * p11;
  }
  glm::dvec3 normal(double u, double v) const {
    return glm::cross(glm::mix(p10 - p00, p11 - p01, v), glm::mix(p01 - p00, p11 - p10, u));
  }
};

// Whether all four corner normals point the same way, so that the two triangles do not overlap, and the
// corners lie in one plane.
bool is_flat_and_convex(const Corners& c) {
  const glm::dvec3 diagonals = glm::cross(c.p11 - c.p00, c.p01 - c.p10);
  const glm::dvec3 n[4] = {c.normal(0, 0), c.normal(1, 0), c.normal(1, 1), c.normal(0, 1)};
  for (const glm::dvec3& corner : n) {
    if (glm::dot(corner, diagonals) < 0) return false;
  }
  // Compare the distance of the corners from the mean plane with the rounding of their coordinates.
  const double length = glm::length(diagonals);
  if (!(length > 0)) return true;
  const double size = std::max(std::max(glm::length(c.p00), glm::length(c.p11)),
                               std::max(glm::length(c.p10), glm::length(c.p01)));
  return std::abs(glm::dot(c.twist(), diagonals / length)) <= 4 * gamma_bound(4) * size;
}

// The result is at most 23, since the twist is twice the distance between the diagonals' midpoints and thus
// at most twice the extent.
int cells_per_side(const Corners& c) {
  const glm::dvec3 pairs[6] = {c.p00 - c.p10, c.p00 - c.p01, c.p00 - c.p11,
                               c.p10 - c.p01, c.p10 - c.p11, c.p01 - c.p11};
  double extent = 0;
  for (const glm::dvec3& d : pairs) extent = std::max(extent, glm::length(d));
  if (!(extent > 0)) return 1;
  const double cells = std::sqrt(glm::length(c.twist()) / (4 * kChordTolerance * extent));
  return std::max(1, static_cast<int>(std::ceil(cells)));
}

Corners corners_of(const PatchMesh& mesh, const PatchIndices& i) {
  return {glm::dvec3(mesh.P[i[0]]), glm::dvec3(mesh.P[i[1]]), glm::dvec3(mesh.P[i[2]]),
          glm::dvec3(mesh.P[i[3]])};
}

glm::dvec3 unit(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : v;
}

template <class V>
V bilinear(const std::vector<V>& values, const PatchIndices& i, float u, float v) {
  return (1 - u) * (1 - v) * values[i[0]] + u * (1 - v) * values[i[1]] + (1 - u) * v * values[i[2]] +
         u * v * values[i[3]];
}

// Appends the vertices of an (n + 1) x (n + 1) grid and its triangles.
void append_grid(const PatchMesh& mesh, const PatchIndices& i, int n, bool with_normals, TriangleMesh& out) {
  const Corners c = corners_of(mesh, i);
  const auto first = static_cast<uint32_t>(out.P.size());
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) {
      const double u = static_cast<double>(x) / n;
      const double v = static_cast<double>(y) / n;
      out.P.push_back(Point3(c.at(u, v)));
      const auto fu = static_cast<float>(u);
      const auto fv = static_cast<float>(v);
      if (with_normals) {
        out.N.push_back(mesh.N.empty() ? Normal3(unit(c.normal(u, v))) : bilinear(mesh.N, i, fu, fv));
      }
      out.uv.push_back(mesh.uv.empty() ? Point2(fu, fv) : bilinear(mesh.uv, i, fu, fv));
    }
  }
  const auto row = static_cast<uint32_t>(n + 1);
  for (uint32_t y = 0; y + 1 < row; ++y) {
    for (uint32_t x = 0; x + 1 < row; ++x) {
      const uint32_t a = first + y * row + x;
      out.indices.push_back({a, a + 1, a + row + 1});
      out.indices.push_back({a, a + row + 1, a + row});
    }
  }
}

// The (u, v) of each patch at its corners. Empty if patches share corners.
std::vector<Point2> own_parameters(const PatchMesh& mesh) {
  std::vector<Point2> uv(mesh.P.size());
  std::vector<bool> taken(mesh.P.size());
  for (const PatchIndices& i : mesh.patches) {
    for (size_t corner = 0; corner < i.size(); ++corner) {
      if (taken[i[corner]]) return {};
      taken[i[corner]] = true;
      uv[i[corner]] = Point2(float(corner % 2), float(corner / 2));
    }
  }
  return uv;
}

}  // namespace

TriangleMesh triangulate_patches(const PatchMesh& mesh) {
  std::vector<int> cells;
  bool curved = false;
  for (const PatchIndices& i : mesh.patches) {
    const Corners c = corners_of(mesh, i);
    const bool flat = is_flat_and_convex(c);
    curved = curved || !flat;
    cells.push_back(flat ? 1 : cells_per_side(c));
  }
  TriangleMesh out;
  if (curved) {
    for (size_t k = 0; k < cells.size(); ++k) append_grid(mesh, mesh.patches[k], cells[k], true, out);
    return out;
  }
  out.P = mesh.P;
  out.N = mesh.N;
  out.uv = mesh.uv.empty() ? own_parameters(mesh) : mesh.uv;
  for (const PatchIndices& i : mesh.patches) {
    out.indices.push_back({i[0], i[1], i[3]});
    out.indices.push_back({i[0], i[3], i[2]});
  }
  return out;
}

}  // namespace kaustik
