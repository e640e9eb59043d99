// Tests textures against values worked out by hand.

#include "core/texture/texture.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "core/texture/noise.h"

namespace kaustik {
namespace {

TexturePoint at_uv(float u, float v) {
  TexturePoint x;
  x.uv = {u, v};
  return x;
}
TexturePoint at(const Point3& p) {
  TexturePoint x;
  x.p = p;
  return x;
}

Point2 mapped(const TextureMapping& mapping, const Point3& p, const glm::dmat4& to_world = glm::dmat4(1)) {
  return map_to_texture(mapping, Transform::from_matrix(to_world), at(p)).st;
}

void expect_near(const Point2& a, const Point2& b) {
  EXPECT_NEAR(a.x, b.x, 1e-6f);
  EXPECT_NEAR(a.y, b.y, 1e-6f);
}

TEST(TextureMapping, Uv) {
  const UvMapping mapping{{2, 3}, {0.5f, -1}};
  TexturePoint x = at_uv(0.25f, 0.5f);
  x.duvdx = {1, 0};
  x.duvdy = {0.5f, 0.25f};
  const TextureCoordinates c = map_to_texture(mapping, Transform(), x);
  EXPECT_EQ(c.st, Point2(1, 0.5f));
  EXPECT_EQ(c.dstdx, Vector2(2, 0));
  EXPECT_EQ(c.dstdy, Vector2(1, 0.75f));
}

TEST(TextureMapping, UvWithShear) {
  const UvMapping mapping{{0, 0}, {0.5f, -1}, {2, 3}};
  TexturePoint x = at_uv(0.25f, 0.5f);
  x.duvdx = {1, 0.5f};
  const TextureCoordinates c = map_to_texture(mapping, Transform(), x);
  EXPECT_EQ(c.st, Point2(1.5f, -0.25f));
  EXPECT_EQ(c.dstdx, Vector2(1, 3));
}

// pbrt-v4's formula: s = theta / pi, t = phi / (2 pi).
TEST(TextureMapping, Spherical) {
  expect_near(mapped(SphereMapping{}, {0, 0, 5}), {0, 0});
  expect_near(mapped(SphereMapping{}, {2, 0, 0}), {0.5f, 0});
  expect_near(mapped(SphereMapping{}, {0, 3, 0}), {0.5f, 0.25f});
  expect_near(mapped(SphereMapping{}, {0, -1, 1}), {0.25f, 0.75f});
}

// pbrt-v4's formula: s = (pi + phi) / (2 pi) with phi in (-pi, pi], t = z.
TEST(TextureMapping, Cylindrical) {
  expect_near(mapped(CylinderMapping{}, {1, 0, 7}), {0.5f, 7});
  expect_near(mapped(CylinderMapping{}, {0, 2, -1}), {0.75f, -1});
  expect_near(mapped(CylinderMapping{}, {0, -2, 0}), {0.25f, 0});
}

// Coordinates are in texture space, which the transform leads from.
TEST(TextureMapping, PlanarInTextureSpace) {
  const PlanarMapping mapping{{2, 0, 0}, {0, 0, 1}, {0.5f, 0.25f}};
  expect_near(mapped(mapping, {1, 9, 3}), {2.5f, 3.25f});
  const glm::dmat4 to_world = glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(1, 0, 0)), glm::dvec3(2));
  expect_near(mapped(mapping, {3, 0, 4}, to_world), {2.5f, 2.25f});  // texture space (1, 0, 2)
}

// Compares derivatives with differences over a step of 1e-3; second derivatives are of order one here.
TEST(TextureMapping, DerivativesAreDifferences) {
  const glm::dmat4 m = glm::rotate(glm::dmat4(1), 0.7, glm::dvec3(1, 1, 0));
  const TextureMapping mappings[] = {SphereMapping{}, CylinderMapping{}, PlanarMapping{{1, 2, 0}, {0, 1, 3}}};
  for (const TextureMapping& mapping : mappings) {
    constexpr float kStep = 1e-3f;
    TexturePoint x = at({0.3f, 0.5f, 0.6f});
    x.dpdx = {1, 0.5f, 0};
    x.dpdy = {0, -0.5f, 1};
    const TextureCoordinates c = map_to_texture(mapping, Transform::from_matrix(m), x);
    const Vector2 dx = (mapped(mapping, x.p + kStep * x.dpdx, m) - c.st) / kStep;
    const Vector2 dy = (mapped(mapping, x.p + kStep * x.dpdy, m) - c.st) / kStep;
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(c.dstdx[k], dx[k], 5e-3f);
      EXPECT_NEAR(c.dstdy[k], dy[k], 5e-3f);
    }
  }
}

Rgb value(Texture texture, const TexturePoint& x) {
  TextureSet set;
  return set.evaluate(set.add(std::move(texture), Transform()), x);
}

TEST(Texture, MixScaleAndBilerp) {
  TextureSet set;
  const uint32_t half = set.add(ConstantTexture{{Rgb(0.5f)}}, Transform());
  const uint32_t mix = set.add(MixTexture{{Rgb(1, 2, 3)}, {Rgb(5)}, {Rgb(0), half}}, Transform());
  EXPECT_EQ(set.evaluate(mix, {}), Rgb(3, 3.5f, 4));
  const uint32_t scale = set.add(ScaleTexture{{Rgb(0), mix}, {Rgb(0), half}}, Transform());
  EXPECT_EQ(set.evaluate(scale, {}), Rgb(1.5f, 1.75f, 2));
  const BilerpTexture corners{UvMapping{}, Rgb(0), Rgb(1), Rgb(2), Rgb(3)};
  EXPECT_EQ(value(corners, at_uv(1, 0)), Rgb(2));
  EXPECT_EQ(value(corners, at_uv(0, 1)), Rgb(1));
  EXPECT_EQ(value(corners, at_uv(0.5f, 0.25f)), Rgb(1.25f));
}

TEST(Texture, VertexColoursAreThoseOfThePoint) {
  TexturePoint x;
  EXPECT_EQ(value(VertexColourTexture{}, x), Rgb(1));
  x.colour = {0.1f, 0.2f, 0.3f, 0.4f};
  EXPECT_EQ(value(VertexColourTexture{}, x), Rgb(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(value(VertexColourTexture{true}, x), Rgb(0.4f));
}

TEST(Texture, DirectionMixFollowsTheNormal) {
  const DirectionMixTexture mix{{Rgb(1)}, {Rgb(3)}, {0, 1, 0}};
  TexturePoint x;
  x.n = {0, -1, 0};
  EXPECT_EQ(value(mix, x), Rgb(1));
  x.n = {1, 0, 0};
  EXPECT_EQ(value(mix, x), Rgb(3));
  x.n = {0.6f, 0.8f, 0};
  EXPECT_NEAR(value(mix, x).x, 0.8f + 3 * 0.2f, 1e-6f);
}

CheckerboardTexture board() {
  return {UvMapping{{1, 1}}, false, {Rgb(1)}, {Rgb(0)}};
}

TEST(Texture, CheckerboardFields) {
  for (int i = -3; i < 4; ++i)
    for (int j = -3; j < 4; ++j)
      EXPECT_EQ(value(board(), at_uv(float(i) + 0.3f, float(j) + 0.6f)), Rgb((i + j) % 2 == 0 ? 1 : 0));
  CheckerboardTexture cubes = board();
  cubes.solid = true;
  EXPECT_EQ(value(cubes, at({0.5f, 0.5f, 0.5f})), Rgb(1));
  EXPECT_EQ(value(cubes, at({0.5f, 0.5f, -0.5f})), Rgb(0));
}

// Filters the border of two fields by a triangle of half width r = 1.5 w: on the border the result is 1/2 by
// symmetry, and at distance d < r inside it is 1 - (1 - d / r)^2 / 2, where the second term is the triangle's
// part beyond the border.
TEST(Texture, CheckerboardIsFilteredByATriangle) {
  constexpr float kWidth = 0.2f, kRadius = 1.5f * kWidth;
  TexturePoint x = at_uv(1, 0.5f);
  x.duvdx = {kWidth, 0};
  EXPECT_NEAR(value(board(), x).x, 0.5f, 1e-5f);
  x.uv.x = 0.9f;
  const float beyond = 0.5f * (1 - 0.1f / kRadius) * (1 - 0.1f / kRadius);
  EXPECT_NEAR(value(board(), x).x, 1 - beyond, 1e-5f);
}

// Far from the origin, with a footprint of 1/65536 of a field, at r/4 inside the border: 1 - (3/4)^2 / 2.
TEST(Texture, CheckerboardIsFilteredInSmall) {
  for (const float border : {1.0f, 15.0f}) {
    constexpr float kRadius = 0x1p-16f;
    TexturePoint x = at_uv(border - kRadius / 4, 0.5f);
    x.duvdx = {kRadius / 1.5f, 0};
    EXPECT_NEAR(value(board(), x).x, 1 - 0.5f * 0.75f * 0.75f, border * 0x1p-24f / kRadius);
    x.uv.x = border + kRadius / 4;
    EXPECT_NEAR(value(board(), x).x, 0.5f * 0.75f * 0.75f, border * 0x1p-24f / kRadius);
  }
}

// Octaves that overflow give NaN, which the readers of textures handle.
TEST(Texture, MarbleOfOverflowingOctavesIsNaN) {
  MarbleTexture marble;
  marble.octaves.omega = 1e30f;
  EXPECT_TRUE(std::isnan(value(marble, at({0.3f, 0.4f, 0.5f})).x));
}

// Filtering moves values but adds none: the mean over a period is that of the two textures, for any width.
// The mean over the midpoints of 64 columns is exact up to rounding for a function that is symmetric about
// both borders.
TEST(Texture, CheckerboardKeepsItsMean) {
  for (const float width : {0.0f, 0.1f, 0.4f, 3.0f}) {
    double sum = 0;
    for (int i = 0; i < 128; ++i) {
      TexturePoint x = at_uv((float(i) + 0.5f) / 64, 0.5f);
      x.duvdx = {width, 0};
      sum += double(value(board(), x).x);
    }
    EXPECT_NEAR(sum / 128, 0.5, 1e-4) << width;
  }
}

// Perlin's noise is zero on the lattice in three dimensions. With z fixed at 1/2 it is not, but it keeps its
// period and its bounds.
TEST(Texture, NoiseRepeatsAndIsBounded) {
  for (int i = 0; i < 1000; ++i) {
    const float x = 0.37f * float(i) - 100, y = 0.73f * float(i) - 200;
    EXPECT_LE(std::abs(noise(x, y)), 1.0f);
    EXPECT_NEAR(noise(x, y), noise(x + 256, y - 256), 1e-3f);  // rounding of x + 256 to 2^-15
  }
  EXPECT_EQ(noise(kInfinity, 0), 0);
}

// With one octave, octaves of noise equal the noise itself. With a footprint as wide as the period, only the
// mean of the turbulence is left.
TEST(Texture, OctavesOfNoise) {
  const Point3 p(0.3f, 1.7f, 2.2f);
  const Vector3 none(0), wide(10, 0, 0);
  EXPECT_EQ(fbm({0.3f, 1.7f, 0.5f}, none, none, {0.5f, 1}), noise(0.3f, 1.7f));
  EXPECT_FLOAT_EQ(fbm(p, none, none, {0.5f, 2}), noise(p) + 0.5f * noise(1.99f * p));
  EXPECT_FLOAT_EQ(turbulence(p, none, none, {0.25f, 2}),
                  std::abs(noise(p)) + 0.25f * std::abs(noise(1.99f * p)) + 0.0625f * 0.2f);
  EXPECT_EQ(fbm(p, wide, none, {0.5f, 8}), 0.0f);
  EXPECT_NEAR(turbulence(p, none, wide, {0.5f, 2}), 0.2f + 0.2f + 0.1f, 1e-6f);
}

// Each field holds at most one disc of radius 0.35, and some hold none.
TEST(Texture, DotsCoverPartOfThePlane) {
  const DotsTexture dots{UvMapping{}, {Rgb(1)}, {Rgb(0)}};
  double covered = 0;
  constexpr int kSide = 400;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) covered += double(value(dots, at_uv(float(i) * 0.1f, float(j) * 0.1f)).x);
  covered /= kSide * kSide;
  EXPECT_GT(covered, 0.05);
  EXPECT_LT(covered, std::numbers::pi * 0.35 * 0.35);
}

// An image that reports where it was looked up.
class Probe final : public ImageLibrary {
 public:
  Rgb lookup(uint32_t image, const ImageSampling&, const Point2& st, const Vector2& dstdx,
             const Vector2& dstdy) const override {
    return {st.x, st.y + float(image), dstdx.x + 10 * dstdy.y};
  }
};

// t points up in the image while rows go down; scale comes before invert; results are not negative; float
// textures take the first channel.
TEST(Texture, ImagesAreTurnedScaledAndInverted) {
  TextureSet set;
  set.set_images(std::make_shared<Probe>());
  TexturePoint x = at_uv(0.25f, 0.125f);
  x.duvdx = {0.5f, 0};
  x.duvdy = {0, 0.125f};
  ImageTexture image;
  EXPECT_EQ(set.evaluate(set.add(image, Transform()), x), Rgb(0.25f, 0.875f, 0));
  image.scale = 2;
  image.invert = true;
  EXPECT_EQ(set.evaluate(set.add(image, Transform()), x), Rgb(0.5f, 0, 2.5f));
  image.grey = true;
  EXPECT_EQ(set.evaluate(set.add(image, Transform()), x), Rgb(0.5f));
}

}  // namespace
}  // namespace kaustik
