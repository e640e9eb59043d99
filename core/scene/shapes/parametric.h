#pragma once
// Shapes of pbrt that become triangles with the exact normals of their corners: surfaces of revolution
// without an analytic type, NURBS and height fields.

#include <functional>
#include <optional>

#include "core/geometry/shape.h"
#include "core/scene/schema/schema.h"

namespace kaustik {

// A point of a surface over (u, v). n need not be unit; zero where the surface has none.
struct ParametricPoint {
  glm::dvec3 p{0}, n{0};
  Point2 uv{0};
};

// A grid of columns x rows cells of two triangles each, with corners, normals and texture coordinates of
// surface(s, t) for s, t in [0, 1]. Triangles of a single line, as at the tip of a cone, are left out.
TriangleMesh grid_of(int columns, int rows, const std::function<ParametricPoint(double, double)>& surface);

// pbrt's cone, paraboloid and hyperboloid (Pharr 2016, section 3.5), 256 columns per full turn: 0.01 % of the
// radius too narrow at most. Rows follow curves only, so a cone has one. Nothing, with an error, if nothing
// of the shape is left.
std::optional<TriangleMesh> make_cone(const ParameterReader& p, DiagnosticList& diagnostics);
std::optional<TriangleMesh> make_paraboloid(const ParameterReader& p, DiagnosticList& diagnostics);
std::optional<TriangleMesh> make_hyperboloid(const ParameterReader& p, DiagnosticList& diagnostics);

// pbrt-v3's height field: nu x nv heights over the unit square. It is flat between them.
std::optional<TriangleMesh> make_heightfield(const ParameterReader& p, DiagnosticList& diagnostics);

// pbrt-v3's NURBS, eight cells to a knot span but at least 32 along each parameter. origin: subtracted from
// all points.
std::optional<TriangleMesh> make_nurbs(const ParameterReader& p, const glm::dvec3& origin,
                                       DiagnosticList& diagnostics);

}  // namespace kaustik
