// Tests shapes that become triangles: their corners lie on the surface and have its normals.
#include "core/scene/shapes/parametric.h"

#include <gtest/gtest.h>

#include <numbers>

namespace kaustik {
namespace {

constexpr double kEpsilon = std::numeric_limits<float>::epsilon();

class ParametricShapes : public testing::Test {
 protected:
  void add(ParameterType type, std::string name, std::vector<double> values) {
    Parameter p;
    p.type = type;
    p.name = std::move(name);
    p.numbers = std::move(values);
    directive_.parameters.push_back(std::move(p));
  }
  void number(std::string name, double v) { add(ParameterType::kFloat, std::move(name), {v}); }
  void integer(std::string name, double v) { add(ParameterType::kInteger, std::move(name), {v}); }

  ParameterReader reader(std::string_view type) {
    directive_.type = type;
    for (const TypeSpec* t : category("Shape").types)
      if (t->name == type) return {directive_, *t};
    throw std::logic_error("no such shape");
  }
  static double area(const TriangleMesh& mesh) {
    double sum = 0;
    for (const auto& t : mesh.indices)
      sum += 0.5 * glm::length(glm::cross(glm::dvec3(mesh.P[t[1]] - mesh.P[t[0]]),
                                          glm::dvec3(mesh.P[t[2]] - mesh.P[t[0]])));
    return sum;
  }
  // Whether the normal at every corner is that of the gradient, and its triangles face it.
  static void expect_normals(const TriangleMesh& mesh,
                             const std::function<glm::dvec3(const glm::dvec3&)>& gradient) {
    for (size_t i = 0; i < mesh.P.size(); ++i) {
      const glm::dvec3 g = gradient(glm::dvec3(mesh.P[i]));
      if (g == glm::dvec3(0)) continue;  // a tip
      const glm::dvec3 n = glm::normalize(g);
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(double(mesh.N[i][k]), n[k], 16 * kEpsilon) << i;
    }
  }

  Directive directive_;
  DiagnosticList diagnostics_;
};

// A sector of 1/256 turn is too narrow by (pi / 256)^2 / 6 of its width, and as much too flat at most.
constexpr double kFlat = (std::numbers::pi / 256) * (std::numbers::pi / 256) / 2;

TEST_F(ParametricShapes, ConesHaveTheirArea) {
  number("radius", 2), number("height", 3);
  const auto mesh = make_cone(reader("cone"), diagnostics_);
  const double whole = std::numbers::pi * 2 * std::sqrt(13.0);
  EXPECT_NEAR(area(*mesh), whole, kFlat * whole);
  EXPECT_EQ(mesh->indices.size(), 256u);  // straight lines take no rows
  number("phimax", 90);
  const auto quarter = make_cone(reader("cone"), diagnostics_);
  EXPECT_NEAR(area(*quarter), whole / 4, kFlat * whole);
  // Constant along the lines to the tip, outwards and upwards.
  expect_normals(*quarter, [](const glm::dvec3& p) {
    const double r = std::hypot(p.x, p.y);
    return r > 0 ? glm::dvec3(3 * p.x / r, 3 * p.y / r, 2) : glm::dvec3(0);
  });
}

TEST_F(ParametricShapes, ParaboloidsHaveTheirEquation) {
  number("radius", 2), number("zmin", 0.5), number("zmax", 3);
  const auto mesh = make_paraboloid(reader("paraboloid"), diagnostics_);
  for (const Point3& p : mesh->P) {
    EXPECT_NEAR(double(p.z), 3 * (double(p.x) * p.x + double(p.y) * p.y) / 4, 16 * kEpsilon * 3);
    EXPECT_TRUE(p.z >= 0.5f - 16 * kEpsilon && p.z <= 3 + 16 * kEpsilon);
  }
  expect_normals(*mesh, [](const glm::dvec3& p) { return glm::dvec3(1.5 * p.x, 1.5 * p.y, -1); });
  number("zmin", 4);
  directive_.parameters.erase(directive_.parameters.begin() + 1);
  directive_.parameters.back().numbers = {-1};
  EXPECT_FALSE(make_paraboloid(reader("paraboloid"), diagnostics_));
}

// The line x = 1, y = z sweeps x^2 + y^2 = 1 + z^2.
TEST_F(ParametricShapes, HyperboloidsHaveTheirEquation) {
  add(ParameterType::kPoint3, "p1", {1, -1, -1}), add(ParameterType::kPoint3, "p2", {1, 1, 1});
  const auto mesh = make_hyperboloid(reader("hyperboloid"), diagnostics_);
  for (const Point3& p : mesh->P)
    EXPECT_NEAR(double(p.x) * p.x + double(p.y) * p.y, 1 + double(p.z) * p.z, 16 * kEpsilon * 2);
  expect_normals(*mesh, [](const glm::dvec3& p) { return glm::dvec3(p.x, p.y, -p.z); });
}

// A line that meets the axis when it is prolonged sweeps a cone, cut off at the height of 3 of 4 metres.
TEST_F(ParametricShapes, HyperboloidsMayBeCones) {
  add(ParameterType::kPoint3, "p1", {2, 0, 0}), add(ParameterType::kPoint3, "p2", {0.5, 0, 3});
  const auto mesh = make_hyperboloid(reader("hyperboloid"), diagnostics_);
  EXPECT_EQ(mesh->indices.size(), 512u);
  const double whole = std::numbers::pi * 2 * std::hypot(2.0, 4.0);
  EXPECT_NEAR(area(*mesh), whole * 15 / 16, kFlat * whole);
  expect_normals(*mesh, [](const glm::dvec3& p) {
    const double r = std::hypot(p.x, p.y);
    return glm::dvec3(2 * p.x / r, 2 * p.y / r, 1);
  });
}

// A rational quadratic arc of weights 1, 1/sqrt(2), 1 is a quarter of a circle.
TEST_F(ParametricShapes, NurbsHoldCylinders) {
  const double w = std::sqrt(0.5);
  integer("nu", 3), integer("uorder", 3), integer("nv", 2), integer("vorder", 2);
  add(ParameterType::kFloat, "uknots", {0, 0, 0, 1, 1, 1});
  add(ParameterType::kFloat, "vknots", {0, 0, 1, 1});
  add(ParameterType::kFloat, "Pw",
      {1, 0, 0, 1, w, w, 0, w, 0, 1, 0, 1, 1, 0, 2, 1, w, w, 2 * w, w, 0, 1, 2, 1});
  const auto mesh = make_nurbs(reader("nurbs"), glm::dvec3(0), diagnostics_);
  ASSERT_TRUE(mesh);
  expect_normals(*mesh, [](const glm::dvec3& p) { return glm::dvec3(p.x, p.y, 0); });
  for (const Point3& p : mesh->P) EXPECT_NEAR(std::hypot(p.x, p.y), 1, 4 * kEpsilon);
  EXPECT_NEAR(area(*mesh), std::numbers::pi, 1e-3);  // 32 cells: 1 - (pi / 64)^2 / 6 of it
  // Far from the origin, relative to it.
  const auto moved = make_nurbs(reader("nurbs"), {1, 2, 3}, diagnostics_);
  EXPECT_NEAR(double(moved->P[0].x), 0, 4 * kEpsilon);
  directive_.find("uknots")->numbers.pop_back();
  EXPECT_FALSE(make_nurbs(reader("nurbs"), glm::dvec3(0), diagnostics_));
  EXPECT_EQ(diagnostics_.error_count(), 1u);
}

// Cubic B-splines of control points on a plane with even knots: the plane, at their own coordinates.
TEST_F(ParametricShapes, NurbsOfHigherOrderKeepPlanes) {
  std::vector<double> P, knots;
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 6; ++x) P.insert(P.end(), {double(x), double(y), 2.0 * x + y});
  for (int i = 0; i < 10; ++i) knots.push_back(i);
  integer("nu", 6), integer("uorder", 4), integer("nv", 6), integer("vorder", 4);
  add(ParameterType::kFloat, "uknots", knots), add(ParameterType::kFloat, "vknots", knots);
  add(ParameterType::kPoint3, "P", P);
  const auto mesh = make_nurbs(reader("nurbs"), glm::dvec3(0), diagnostics_);
  ASSERT_TRUE(mesh);
  for (size_t i = 0; i < mesh->P.size(); ++i) {
    const Point3& p = mesh->P[i];
    EXPECT_NEAR(double(p.z), 2 * double(p.x) + double(p.y), 32 * kEpsilon * 15);
    EXPECT_NEAR(double(p.x), double(mesh->uv[i].x) - 2, 32 * kEpsilon * 7);  // Greville's abscissae: i + 2
  }
}

TEST_F(ParametricShapes, HeightFieldsStandOnTheUnitSquare) {
  integer("nu", 3), integer("nv", 2);
  add(ParameterType::kFloat, "Pz", {0, 1, 2, 0, 1, 2});
  const auto mesh = make_heightfield(reader("heightfield"), diagnostics_);
  EXPECT_EQ(mesh->indices.size(), 4u);
  EXPECT_EQ(mesh->P[4], Point3(0.5f, 1, 1));
  EXPECT_NEAR(area(*mesh), std::sqrt(5.0), 4 * kEpsilon);
  directive_.find("Pz")->numbers.pop_back();
  EXPECT_FALSE(make_heightfield(reader("heightfield"), diagnostics_));
}

}  // namespace
}  // namespace kaustik
