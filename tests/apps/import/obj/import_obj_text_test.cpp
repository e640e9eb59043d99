// Tests the text of OBJ files as other programs write it: numbers, lines, indices, polygons, groups, normals.

#include "tests/apps/import/obj/obj_support.h"

namespace kaustik::pbrt {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

using ImportObjText = ObjTest;

TEST_F(ImportObjText, NumbersAreReadInAllForms) {
  const std::pair<const char*, double> cases[] = {{".5", 0.5},
                                                  {"-.7", -0.7},
                                                  {"+2", 2},
                                                  {"2.", 2},
                                                  {".8e-001", 0.08},
                                                  {"0.8e-001", 0.08},
                                                  {"-.7e+02", -70},
                                                  {"+.25E1", 2.5},
                                                  {"1e-400", 0},
                                                  {"0,5", 0.5},
                                                  {"123456789.125", 123456789.125}};
  for (const auto& [text, value] : cases) {
    const auto s = describe("v " + std::string(text) + " 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    ASSERT_THAT(s.shapes, SizeIs(1)) << text;
    EXPECT_EQ(numbers(s.shapes[0], "P").at(0), value) << text;
  }
}

TEST_F(ImportObjText, LinesEndInAllWays) {
  const auto s = describe(
      "# made by hand \\\r\n  v\t0 0 0  # first\r\nv 1 0 0\r\nv 0 \\\r\n 1 0 \r\n\r\nf 1 \\\r\n2 3 # f\r\n");
  EXPECT_THAT(corners(s.shapes.at(0)), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
  EXPECT_THAT(describe("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3").shapes, SizeIs(1));
}

TEST_F(ImportObjText, IndicesCountFromEitherEnd) {
  const auto s =
      describe("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt .5 .25\nf -3/-1 -2/1 -1/-1\nv 2 2 2\nf 2// 3/ 5\n");
  EXPECT_THAT(corners(s.shapes.at(0)), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 2, 2, 2));
  EXPECT_THAT(corners(s.shapes.at(0), "uv", 2), ElementsAre(.5, .25, .5, .25, .5, .25, 0, 0, 0, 0, 0, 0));
}

TEST_F(ImportObjText, IndicesOutOfRangeAreNamed) {
  const std::string text = error("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 99\n");
  EXPECT_THAT(text, HasSubstr("scene.obj:5:7: error: vertex index 99 is out of range: expected 1 to 3"));
  EXPECT_THAT(
      error(std::string(kObjQuad) + "f 1 2 0\nf -9 1 2\n"),
      HasSubstr("5:7: error: vertex index 0 is out of range: expected 1 to 4, or -1 to -4 on this line; "
                "1 more errors follow"));
  EXPECT_THAT(error(std::string(kObjQuad) + "f 1 2 x\n"),
              HasSubstr("5:7: error: `x` is not a corner of a face"));
  EXPECT_THAT(error("v 0 zero 0\nf 1 1 1\n"), HasSubstr("1:5: error: `zero` is not a number"));
}

TEST_F(ImportObjText, FacesOfTwoCornersAreLeftOut) {
  EXPECT_THAT(describe(std::string(kObjQuad) + "f 1 2 3\nf 1 2\nf 3\n").shapes, SizeIs(1));
  EXPECT_THAT(
      said(),
      HasSubstr("scene.obj:6:6: warning: a face has fewer than three corners and is left out (2 times)"));
}

TEST_F(ImportObjText, GroupsWithoutAreaAreLeftOut) {
  const auto s = describe(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nv 5 5 5\nv 6 6 6\nusemtl a\nf 1 2 3\nusemtl b\nf 4 5 6\nf 1 2 "
      "2\n");
  ASSERT_THAT(s.shapes, SizeIs(1));
  EXPECT_EQ(s.shapes[0].material.name, "a");
  EXPECT_THAT(said(), HasSubstr("a triangle without area is left out (2 times)"));
}

TEST_F(ImportObjText, PositionsThatAreNotFiniteAreLeftOut) {
  EXPECT_THAT(describe(std::string(kObjQuad) + "v 1.#QNAN 0 0\nf 1 2 3\nf 1 2 5\n").shapes, SizeIs(1));
  EXPECT_THAT(said(), HasSubstr("a face with a position that is not finite is left out"));
}

// An L of six corners: the fan about its first corner would cover the notch. Its area is 3.
TEST_F(ImportObjText, ConcavePolygonsAreCutInside) {
  const auto s = describe("v 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nv 2 0 0\nf 1 2 3 4 5 6\n");
  const std::vector<double> p = corners(s.shapes.at(0));
  ASSERT_THAT(p, SizeIs(4 * 9));
  double area = 0;
  for (size_t i = 0; i < p.size(); i += 9) {
    const double twice =
        (p[i + 3] - p[i]) * (p[i + 7] - p[i + 1]) - (p[i + 6] - p[i]) * (p[i + 4] - p[i + 1]);
    EXPECT_GE(twice, 0);
    area += twice / 2;
  }
  EXPECT_EQ(area, 3);
}

// A part of the file that other parts name: the reader cuts files of more than 2 MiB.
TEST_F(ImportObjText, PartsOfLargeFilesFitTogether) {
  std::string text;
  constexpr int kStrips = 40'000;
  for (int i = 0; i < kStrips; ++i) {
    text += "v " + std::to_string(i) + " 0 0\nv " + std::to_string(i) + " 1 0\nvt 0." + std::to_string(i) +
            " 0\n";
    if (i > 0) text += "f -1/-1 -2/-1 \\\n -3/-2\nf " + std::to_string(2 * i + 1) + " -1 -4\n";
    if (i == kStrips / 2) text += "usemtl second\n";
  }
  ASSERT_GT(text.size(), size_t{1} << 21);
  const auto s = describe(text);
  ASSERT_THAT(s.shapes, SizeIs(2));
  const std::vector<double> first = corners(s.shapes[0]), second = corners(s.shapes[1]);
  EXPECT_EQ(first.size() + second.size(), size_t{kStrips - 1} * 18);
  EXPECT_THAT(std::vector(second.end() - 18, second.end()),
              ElementsAre(39999, 1, 0, 39999, 0, 0, 39998, 1, 0, 39999, 0, 0, 39999, 1, 0, 39998, 0, 0));
}

TEST_F(ImportObjText, GroupsAndMaterialsMakeMeshes) {
  const auto s =
      describe(std::string(kObjQuad) +
               "g one\nusemtl a\nf 1 2 3\ng two\nf 1 3 4\ng one\nusemtl b\nf 1 2 4\nusemtl a\nf 2 3 4\n");
  ASSERT_THAT(s.shapes, SizeIs(3));
  EXPECT_THAT(numbers(s.shapes[0], "indices"), SizeIs(6));
  EXPECT_EQ(s.shapes[0].material.name, s.shapes[1].material.name);
  EXPECT_EQ(s.shapes[1].location.line, 8u);
}

// Two triangles that meet at an angle of 45 degrees: their normals are (0, 0, 1) and (0, -1, 1) / sqrt(2),
// their areas 1/2 and 1/sqrt(2).
TEST_F(ImportObjText, SmoothingGroupsAreSmooth) {
  const std::string roof = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 -1\n";
  EXPECT_THAT(numbers(describe(roof + "s off\nf 1 2 3\nf 1 4 2\n").shapes.at(0), "N"), SizeIs(0));
  const auto s = describe(roof + "s 1\nf 1 2 3\nf 1 4 2\n");
  const std::vector<double> N = corners(s.shapes.at(0), "N");
  const double length = std::sqrt(0.25 + 1);
  for (size_t corner : {0, 1, 3, 5}) {
    EXPECT_NEAR(N[3 * corner + 1], -0.5 / length, 1e-7);
    EXPECT_NEAR(N[3 * corner + 2], 1 / length, 1e-7);
  }
  EXPECT_THAT(std::vector(N.begin() + 6, N.begin() + 9), ElementsAre(0, 0, 1));
}

// The edges of a cube stay sharp even in one smoothing group.
TEST_F(ImportObjText, RightAnglesStaySharp) {
  const auto s = describe("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\ns 1\nf 1 2 3\nf 1 4 2\n");
  const std::vector<double> N = corners(s.shapes.at(0), "N");
  EXPECT_THAT(N, ElementsAre(0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 0, 0, 1, 0));
}

TEST_F(ImportObjText, MissingNormalsAreThoseOfTheFace) {
  const auto s = describe(std::string(kObjQuad) + "vn 1 0 0\nvn nan 0 0\nf 1//1 2//2 3\n");
  EXPECT_THAT(corners(s.shapes.at(0), "N"), ElementsAre(1, 0, 0, 0, 0, 1, 0, 0, 1));
  EXPECT_THAT(said(), HasSubstr("a normal is zero or not finite"));
}

TEST_F(ImportObjText, OtherLinesAreCounted) {
  const std::string text = std::string(kObjQuad) + "f 1 2 3\nl 1 2\nl 2 3\np 1\ncstype bezier\n";
  describe(text);
  EXPECT_THAT(said(), HasSubstr("scene.obj:6:1: warning: lines `l` are left out (2 times)"));
  EXPECT_THAT(said(), HasSubstr("points `p` are left out\n"));
  EXPECT_THAT(said(), HasSubstr("a line `cstype` is left out"));
}

// sRGB 0.5 is 0.214 in linear light. The fourth of four numbers is a weight.
TEST_F(ImportObjText, ColoursOfVerticesAreRead) {
  const auto s = describe("v 0 0 0 1 0 0.5\nv 1 0 0 2 -1 0\nv 0 2 0 2\nf 1 2 3\n");
  const std::vector<double> Cd = numbers(s.shapes.at(0), "Cd");
  ASSERT_THAT(Cd, SizeIs(12));
  EXPECT_NEAR(Cd[2], 0.214041, 1e-6);
  EXPECT_THAT(std::vector(Cd.begin() + 3, Cd.end()), ElementsAre(1, 1, 0, 0, 1, 1, 1, 1, 1));
  EXPECT_THAT(corners(s.shapes[0]), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
  EXPECT_EQ(s.materials.at(0).find("reflectance")->type, ParameterType::kTexture);
  EXPECT_TRUE(load_scene(folder_ / "scene.obj", diagnostics_)) << said();
}

}  // namespace
}  // namespace kaustik::pbrt
