// Tests curves, which become tubes and ribbons.

#include <gmock/gmock.h>

#include <numbers>

#include "apps/import/pbrt/curves/tubes.h"
#include "tests/apps/import/import_support.h"

namespace kaustik::pbrt {
namespace {

class ImportCurves : public ImportTest {};

// A straight tube of width 1 and length 2 has the area 2 pi: its section has the round one's circumference.
TEST_F(ImportCurves, StraightTubesHaveTheAreaOfRoundOnes) {
  const Scene s = world(R"(Scale 2 2 2
    Shape "curve" "point3 P" [ 0 0 0  0 0 .3333333  0 0 .6666667  0 0 1 ] "float width" .5 "string type" "cylinder")");
  ASSERT_EQ(s.shapes.size(), 1u);
  EXPECT_NEAR(surface_area(s.shapes[0]), 2 * std::numbers::pi, 1e-5);
  const TriangleMesh& mesh = *s.shapes[0].mesh();
  EXPECT_EQ(mesh.indices.size(), 24u);  // twelve sides
  for (size_t i = 0; i < mesh.P.size(); ++i) {
    EXPECT_NEAR(mesh.N[i].z, 0, 1e-6f);
    EXPECT_GT(glm::dot(Vector3(mesh.P[i].x, mesh.P[i].y, 0), mesh.N[i]), 0);
  }
}

// Curves of one material are one mesh, wherever they are; a tip without width is a single point.
TEST_F(ImportCurves, CurvesOfOneMaterialAreOneMesh) {
  const std::string curve =
      "Shape \"curve\" \"point P\" [ 0 0 0 0 0 1 0 0 2 0 0 3 ] \"float width0\" .1 \"float width1\" 0\n";
  const Scene s =
      world(curve + "AttributeBegin Translate 5 0 0\n" + curve + "AttributeEnd\n" + curve +
            "Material \"hair\"\n" + curve + "ObjectBegin \"o\"" + curve + "ObjectEnd ObjectInstance \"o\"");
  ASSERT_EQ(s.shapes.size(), 3u);
  EXPECT_EQ(primitive_count(s.shapes[0]), 3u * 12);
  EXPECT_EQ(primitive_count(s.shapes[1]), 12u);
  EXPECT_NEAR(s.bounds.max.x, 5, 0.06f);
}

// The cubic B-spline of points on a line at 0, 1, 2, ... passes through 1 to n - 2; the quadratic one begins
// and ends half a step further out.
TEST_F(ImportCurves, SplinesAreConverted) {
  const auto extent = [&](const std::string& more) {
    const Scene s = world(
        "Shape \"curve\" \"point3 P\" [ 0 0 0 1 0 0 2 0 0 3 0 0 4 0 0 ] \"float width\" .001 "
        "\"string basis\" \"bspline\"" +
        more);
    return Point2(s.bounds.min.x, s.bounds.max.x);
  };
  EXPECT_NEAR(extent("").x, 1, 1e-5f);
  EXPECT_NEAR(extent("").y, 3, 1e-5f);
  EXPECT_NEAR(extent("\"integer degree\" 2").x, 0.5f, 1e-5f);
  EXPECT_NEAR(extent("\"integer degree\" 2").y, 3.5f, 1e-5f);
}

TEST_F(ImportCurves, RibbonsLieAcrossTheirNormals) {
  const Scene s = world(R"(Shape "curve" "string type" "ribbon" "float width" 1
    "point3 P" [ 0 0 0  0 0 1  0 0 2  0 0 3 ] "normal N" [ 0 1 0  0 1 0 ])");
  EXPECT_NEAR(surface_area(s.shapes[0]), 3, 1e-5);
  for (const Normal3& n : s.shapes[0].mesh()->N) EXPECT_EQ(n, Normal3(0, 1, 0));
  EXPECT_NEAR(s.bounds.max.x, 0.5f, 1e-6f);
  EXPECT_NEAR(s.bounds.max.y, 0, 1e-6f);
}

// A bent curve is followed to a tenth of its width: here a half circle of radius about one.
TEST_F(ImportCurves, BentCurvesAreFollowed) {
  CurveSegment s{{{1, 0, 0}, {1, 4.0 / 3, 0}, {-1, 4.0 / 3, 0}, {-1, 0, 0}}, 0.01, 0.01};
  const TubeDetail detail{4, 0.1, 64};
  const TubeMesh mesh = tubes_of({s}, detail);
  const size_t rings = mesh.P.size() / 3 / 4;
  EXPECT_GT(rings, 20u);
  // Neighbouring rings do not twist: the same corner of each looks nearly the same way.
  for (size_t i = 0; i + 1 < rings; ++i) {
    const double* a = &mesh.N[12 * i];
    EXPECT_GT(a[0] * a[12] + a[1] * a[13] + a[2] * a[14], 0.9);
  }
  CurveSegment next = s;
  next.continues = true;
  EXPECT_EQ(tubes_of({s, next}, detail).P.size(), 2 * mesh.P.size() - 12);  // one ring in common
}

TEST_F(ImportCurves, CurvesWithoutPointsAreLeftOut) {
  const std::string lines = first_lines(
      "Shape \"curve\" \"point3 P\" [ 0 0 0 1 1 1 ]\n"
      "Shape \"curve\" \"point3 P\" [ 0 0 0 1 nan 1 2 2 2 3 3 3 ]");
  EXPECT_EQ(lines,
            "2:1: warning: a curve takes 4 finite points or more: this one is left out (and 1 more)\n");
  EXPECT_TRUE(loaded_);
}

}  // namespace
}  // namespace kaustik::pbrt
