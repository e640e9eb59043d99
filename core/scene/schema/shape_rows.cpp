// The rows of shapes: parameters, and how analytic shapes are made from them.

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/schema/parameter_spec.h"

namespace kaustik {
namespace {

using namespace spec;
using Type = ParameterType;

float turn_of(const ShapeInputs& in) {
  return static_cast<float>(glm::radians(in.parameters.number("phimax")));
}

// As in pbrt, either of the two limits may be the larger one; the caller has sorted them.
bool check_extent(const ShapeInputs& in, double z_min, double z_max) {
  if (z_min < z_max) return true;
  in.diagnostics.error(in.parameters.location(in.parameters.directive().find("zmin") ? "zmin" : "zmax"),
                       fmt::format("no part of the {} lies between `zmin` = {} and `zmax` = {}",
                                   in.parameters.directive().type, z_min, z_max));
  return false;
}

std::optional<ShapeSource> make_sphere(const ShapeInputs& in) {
  const double radius = in.parameters.number("radius");
  const auto limit = [&](std::string_view name, double whole) {
    return in.parameters.has(name) ? std::clamp(in.parameters.number(name), -radius, radius) : whole;
  };
  const auto [z_min, z_max] = std::minmax({limit("zmin", -radius), limit("zmax", radius)});
  if (!check_extent(in, z_min, z_max)) return std::nullopt;
  const glm::dmat4 local = glm::scale(glm::dmat4(1), glm::dvec3(radius));
  if (z_min == -radius && z_max == radius && in.parameters.number("phimax") == 360)
    return ShapeSource{Sphere{}, local};
  Quadric q;
  q.z_min = static_cast<float>(z_min / radius);
  q.z_max = static_cast<float>(z_max / radius);
  q.phi_max = turn_of(in);
  return ShapeSource{q, local};
}

std::optional<ShapeSource> make_cylinder(const ShapeInputs& in) {
  const double radius = in.parameters.number("radius");
  const auto [z_min, z_max] = std::minmax({in.parameters.number("zmin"), in.parameters.number("zmax")});
  if (!check_extent(in, z_min, z_max)) return std::nullopt;
  Quadric q;
  q.kind = QuadricKind::kCylinder;
  q.z_min = static_cast<float>(z_min / radius);
  q.z_max = static_cast<float>(z_max / radius);
  q.phi_max = turn_of(in);
  return ShapeSource{q, glm::scale(glm::dmat4(1), glm::dvec3(radius))};
}

std::optional<ShapeSource> make_disk(const ShapeInputs& in) {
  const double radius = in.parameters.number("radius");
  const double inner = in.parameters.number("innerradius");
  if (!(inner < radius)) {
    in.diagnostics.error(
        in.parameters.location("innerradius"),
        fmt::format("`innerradius` = {} leaves nothing of a disk of radius {}", inner, radius));
    return std::nullopt;
  }
  const glm::dmat4 local = glm::scale(
      glm::translate(glm::dmat4(1), glm::dvec3(0, 0, in.parameters.number("height"))), glm::dvec3(radius));
  if (in.parameters.number("phimax") == 360)
    return ShapeSource{Disk{{}, static_cast<float>(inner / radius)}, local};
  Quadric q;
  q.kind = QuadricKind::kDisk;
  q.inner = static_cast<float>(inner / radius);
  q.phi_max = turn_of(in);
  return ShapeSource{q, local};
}

// Adds the parameters that all shapes have.
std::vector<ParameterSpec> shape(std::vector<ParameterSpec> own) {
  own.push_back(text("surfacegroup", "found from shared edges",
                     "name of the surface that the shape is part of: photons are shared among all shapes of "
                     "that name, and with no others. Not in pbrt"));
  own.push_back(
      textured(number("alpha", 1, "", kUnit, "opacity: the probability that a ray hits the surface")));
  return own;
}

// pbrt's shapes that become triangles here (core/scene/shapes/parametric.h).
std::vector<ShapeRow> triangulated_rows(const ParameterSpec& phimax) {
  const auto required = [](ParameterSpec p) { return without_default(std::move(p), "required"); };
  std::vector<ParameterSpec> nurbs;
  for (const std::string_view name : {"nu", "nv"})
    nurbs.push_back(required(integer(name, 2, "", {1, 1 << 16}, "control points along u (or v)")));
  for (const std::string_view name : {"uorder", "vorder"})
    nurbs.push_back(required(integer(name, 2, "", {1, 32}, "degree along u (or v), plus one")));
  for (const std::string_view name : {"uknots", "vknots"})
    nurbs.push_back(
        list(Type::kFloat, name, 2, "required", "", "knots, as many as control points and the order"));
  for (const std::string_view name : {"u0", "v0", "u1", "v1"})
    nurbs.push_back(
        without_default(number(name, 0, "", kAnyNumber, "end of the part that is shown"), "whole surface"));
  nurbs.push_back(list(Type::kPoint3, "P", 1, "required, or Pw", "m", "control points, u the fastest"));
  nurbs.push_back(list(Type::kFloat, "Pw", 4, "none", "", "control points as w x, w y, w z, w"));
  const Range side{2, 1 << 14};
  return {
      {{"cone", "A cone about the z axis with its tip at z = height, without a base, as triangles.",
        shape({number("radius", 1, "m", kPositive, "radius at z = 0"),
               number("height", 1, "m", kPositive, "height of the tip"), phimax})}},
      {{"paraboloid",
        "z = zmax (x^2 + y^2) / radius^2 from `zmin` to `zmax`, as triangles; the outside is below.",
        shape({number("radius", 1, "m", kPositive, "radius at zmax"),
               number("zmin", 0, "m", kAnyNumber, "lower limit"),
               number("zmax", 1, "m", kAnyNumber, "upper limit"), phimax})}},
      {{"hyperboloid", "The line from `p1` to `p2`, turned about the z axis, as triangles.",
        shape({point("p1", {0, 0, 0}, "one end of the line"), point("p2", {1, 1, 1}, "the other end"),
               phimax})}},
      {{"heightfield", "Heights over the unit square, as triangles (pbrt-v3).",
        shape({required(integer("nu", 2, "", side, "heights along x")),
               required(integer("nv", 2, "", side, "heights along y")),
               list(Type::kFloat, "Pz", 4, "required", "m", "nu times nv heights, x the fastest")})}},
      {{"nurbs", "A non-uniform rational B-spline surface, as triangles with its normals (pbrt-v3).",
        shape(std::move(nurbs))}},
  };
}

std::vector<ShapeRow> make_shape_rows() {
  const ParameterSpec P = list(Type::kPoint3, "P", 3, "required", "m", "vertices");
  const ParameterSpec N =
      list(Type::kNormal, "N", 1, "none", "", "normals, one per vertex; they also choose the outside");
  const ParameterSpec uv = list(Type::kPoint2, "uv", 1, "none", "", "texture coordinates, one per vertex");
  const ParameterSpec colours = list(Type::kFloat, "Cd", 4, "none", "",
                                     "colours for `vertexcolor` textures: linear red, green, blue and alpha "
                                     "of each vertex. Not in pbrt");
  const ParameterSpec face_indices =
      ignored("faceIndices", {Type::kInteger}, "numbers of the original faces");
  const Range turn{0, 360, true, false};
  const ParameterSpec phimax = number("phimax", 360, "degrees", turn, "extent about the axis, from +x");
  std::vector<ShapeRow> rows = {
      {{"trianglemesh", "Triangles. Without `N`, the outside is the side of cross(p1 - p0, p2 - p0).",
        shape({P,
               list(Type::kInteger, "indices", 3, "0 1 2 when there are three vertices", "",
                    "three vertex indices per triangle, counted from zero"),
               N, uv, colours, ignored("S", {Type::kVector3}, "tangents"), face_indices})}},
      {{"plymesh",
        "Triangles, quads and polygons of a PLY file (ascii or binary), with normals, uv and colours.",
        shape({text("filename", "required", "path, relative to the scene file"),
               ignored("displacement", {Type::kTexture, Type::kFloat}, "displacement is not supported", 0),
               ignored("edgelength", {Type::kFloat}, "displacement is not supported")})}},
      {{"sphere",
        "A sphere about the origin, exact; under a transform that scales non-uniformly, an ellipsoid.",
        shape({number("radius", 1, "m", kPositive, "radius"),
               without_default(number("zmin", 0, "m", kAnyNumber, "lower limit, where the sphere is cut off"),
                               "-radius"),
               without_default(number("zmax", 0, "m", kAnyNumber, "upper limit, where the sphere is cut off"),
                               "radius"),
               phimax})},
       make_sphere},
      {{"cylinder", "A cylinder about the z axis, without caps; the outside is away from the axis.",
        shape({number("radius", 1, "m", kPositive, "radius"),
               number("zmin", -1, "m", kAnyNumber, "lower end"),
               number("zmax", 1, "m", kAnyNumber, "upper end"), phimax})},
       make_cylinder},
      {{"disk", "A disk in the plane z = height; the outside is the side of +z.",
        shape({number("radius", 1, "m", kPositive, "outer radius"),
               number("innerradius", 0, "m", kNotNegative, "radius of the hole"),
               number("height", 0, "m", kAnyNumber, "position along z"), phimax})},
       make_disk},
      {{"bilinearmesh",
        "Patches of four corners p00 p10 p01 p11. Flat convex ones become two triangles, others a grid.",
        shape({list(Type::kPoint3, "P", 4, "required", "m", "corners"),
               list(Type::kInteger, "indices", 4, "0 1 2 3 when there are four corners", "",
                    "four corner indices per patch, counted from zero"),
               N, uv, face_indices,
               ignored("emissionfilename", {Type::kString}, "an area light is sampled by its own image")})}},
      {{"loopsubdiv", "The limit surface of Loop's subdivision (Loop 1987), as triangles with its normals.",
        shape({P,
               list(Type::kInteger, "indices", 3, "required", "",
                    "three vertex indices per triangle, counted from zero"),
               integer("levels", 3, "", {0, 12}, "how many times each triangle is divided into four"),
               ignored("scheme", {Type::kString}, "there is only one scheme")})}},
  };
  for (ShapeRow& row : triangulated_rows(phimax)) rows.push_back(std::move(row));
  return rows;
}

}  // namespace

const std::vector<ShapeRow>& shape_rows() {
  static const std::vector<ShapeRow> rows = make_shape_rows();
  return rows;
}

}  // namespace kaustik
