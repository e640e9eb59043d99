// Tests bump and normal maps against normals worked out by hand.

#include "core/scene/shading_normal.h"

#include <gtest/gtest.h>

namespace kaustik {
namespace {

// A plane of 2 x 3 metres with uv from 0 to 1 along x and y.
SurfaceParameters plane() {
  SurfaceParameters s;
  s.uv = {0.25f, 0.5f};
  s.dpdu = {2, 0, 0};
  s.dpdv = {0, 3, 0};
  return s;
}

struct BumpedPlane {
  TextureSet textures;
  TexturedMaterial material;

  // The height is 0.5 u + 0.75 v metres.
  BumpedPlane() {
    material.displacement =
        textures.add(BilerpTexture{UvMapping{}, Rgb(0), Rgb(0.75f), Rgb(0.5f), Rgb(1.25f)}, Transform());
  }
  Normal3 normal(const SurfaceInteraction& si, const SurfaceParameters& s,
                 const Vector2& duvdx = Vector2(0)) const {
    TexturePoint x;
    x.uv = s.uv;
    x.duvdx = duvdx;
    return shading_normal(textures, material, x, s, si);
  }
};

// The slopes are 0.5 / 2 and 0.75 / 3, so the normal is (-1/4, -1/4, 1) normalised, whatever the step, since
// the height is linear. Differences of heights near one over a step of 5e-4 round by 6e-8 / 5e-4 = 1.2e-4,
// times three.
TEST(BumpMap, PlaneMatchesTheClosedForm) {
  const BumpedPlane bumped;
  const SurfaceInteraction si;
  const Normal3 expected = glm::normalize(Vector3(-0.25f, -0.25f, 1));
  for (const Vector2& step : {Vector2(0), Vector2(0.1f, 0.2f)}) {
    const Normal3 n = bumped.normal(si, plane(), step);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(n[c], expected[c], 4e-4f);
  }
}

// Seen from below, heights rise towards the viewer's side: the normal is (-1/4, -1/4, -1) normalised, about n
// = -z.
TEST(BumpMap, RisesTowardsTheSideThatIsSeen) {
  const BumpedPlane bumped;
  SurfaceInteraction si;
  si.n = si.ns = {0, 0, -1};
  const Normal3 n = bumped.normal(si, plane());
  const Normal3 expected = glm::normalize(Vector3(-0.25f, -0.25f, -1));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(n[c], expected[c], 4e-4f);
}

// However steep the slope, the normal stays on the side of n.
TEST(BumpMap, StaysInTheHemisphere) {
  BumpedPlane bumped;
  SurfaceInteraction si;
  si.ns = glm::normalize(Vector3(1, 0, 0.05f));
  for (float u = 0; u < 1; u += 0.1f) {
    SurfaceParameters s = plane();
    s.uv.x = u;
    const Normal3 n = bumped.normal(si, s);
    EXPECT_GE(glm::dot(n, si.n), 0);
    EXPECT_NEAR(glm::length(n), 1, 1e-6f);
  }
}

class OneColour final : public ImageLibrary {
 public:
  explicit OneColour(const Rgb& colour) : colour_(colour) {}
  Rgb lookup(uint32_t, const ImageSampling&, const Point2&, const Vector2&, const Vector2&) const override {
    return colour_;
  }

 private:
  Rgb colour_;
};

Normal3 mapped(const Rgb& colour, const SurfaceInteraction& si, const SurfaceParameters& surface = plane()) {
  TextureSet textures;
  textures.set_images(std::make_shared<OneColour>(colour));
  TexturedMaterial material;
  material.normal_map = 0;
  return shading_normal(textures, material, {}, surface, si);
}

// The normal is 2 c - 1 in the frame (u, ns x u, ns): (0.6, 0, 0.8) from (0.8, 0.5, 0.9).
TEST(NormalMap, PlaneMatchesTheClosedForm) {
  const Normal3 n = mapped({0.8f, 0.5f, 0.9f}, {});
  EXPECT_NEAR(n.x, 0.6f, 1e-6f);
  EXPECT_NEAR(n.y, 0, 1e-6f);
  EXPECT_NEAR(n.z, 0.8f, 1e-6f);
  EXPECT_NEAR(mapped({0.5f, 0.8f, 0.9f}, {}).y, 0.6f, 1e-6f);
}

// Symmetric models often use one half of a map mirrored: up in the map stays up on both halves, seen from
// either side.
TEST(NormalMap, GreenPointsTowardsV) {
  for (const bool u_turned : {false, true})
    for (const bool v_turned : {false, true})
      for (const float side : {1.0f, -1.0f}) {
        SurfaceParameters surface = plane();
        if (u_turned) surface.dpdu = -surface.dpdu;
        if (v_turned) surface.dpdv = -surface.dpdv;
        SurfaceInteraction si;
        si.n = si.ns = {0, 0, side};
        const Normal3 n = mapped({0.5f, 0.8f, 0.9f}, si, surface);
        EXPECT_NEAR(n.y, v_turned ? -0.6f : 0.6f, 1e-6f);
        EXPECT_NEAR(n.z, 0.8f * side, 1e-6f);
      }
}

TEST(NormalMap, ZeroVectorChangesNothing) {
  SurfaceInteraction si;
  si.ns = glm::normalize(Vector3(0.1f, 0.2f, 1));
  EXPECT_EQ(mapped(Rgb(0.5f), si), si.ns);
}

}  // namespace
}  // namespace kaustik
