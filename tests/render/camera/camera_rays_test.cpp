// Tests camera rays in packets against single camera rays.

#include "render/camera/camera_rays.h"

#include <gtest/gtest.h>

#include "tests/render/support/test_scenes.h"

namespace kaustik::render {
namespace {

using namespace test;

struct Pixel {
  int x, y;
};

// The image's border cuts the last block.
constexpr int kSide = 10;

TEST(CameraRays, MatchTheRaysAndHitsOfSingleSamples) {
  const Scene scene = cornell(kSide);
  const accel::Bvh bvh(scene);
  CameraRays rays;
  constexpr uint64_t kSeed = 3, kFirst = 5, kCount = 3;
  size_t met = 0;
  for (const Pixel& block : {Pixel{0, 0}, Pixel{4, 8}, Pixel{8, 8}}) {
    rays.trace(bvh, kSeed, block.x, block.y, BlockPart::kWhole, kFirst, kCount);
    for (int y = block.y; y < std::min(kSide, block.y + kRayBlock); ++y) {
      for (int x = block.x; x < std::min(kSide, block.x + kRayBlock); ++x) {
        for (uint64_t i = kFirst; i < kFirst + kCount; ++i) {
          const Point2 u = Sampler(pixel_stream(kSeed, scene.camera, x, y), i).next_2d();
          const Ray expected = scene.camera.generate_ray(Point2(x, y) + u), ray = rays.ray(x, y, i);
          ASSERT_EQ(ray.o, expected.o);
          ASSERT_EQ(ray.d, expected.d);
          ASSERT_EQ(ray.t_max, expected.t_max);
          const Hit alone = bvh.intersect(ray), hit = rays.hit(x, y, i);
          ASSERT_EQ(hit.shape, alone.shape);
          met += hit.valid();
          if (hit.valid()) {
            ASSERT_EQ(hit.t, alone.t);
          }
        }
      }
    }
  }
  EXPECT_GT(met, 0u);
}

// Any pixel of a block identifies the block: what a pixel sees does not depend on where the window begins.
TEST(CameraRays, EveryPixelOfABlockIdentifiesIt) {
  const Scene scene = cornell(kSide);
  const accel::Bvh bvh(scene);
  constexpr uint64_t kSamples = CameraRays::most_samples(BlockPart::kWhole);
  CameraRays by_corner, by_pixel;
  by_corner.trace(bvh, 0, 4, 4, BlockPart::kWhole, 0, kSamples);
  by_pixel.trace(bvh, 0, 6, 7, BlockPart::kWhole, 0, kSamples);
  for (int y = 4; y < 8; ++y) {
    for (int x = 4; x < 8; ++x) {
      for (uint64_t i = 0; i < kSamples; ++i) {
        ASSERT_EQ(by_pixel.ray(x, y, i).d, by_corner.ray(x, y, i).d);
        ASSERT_EQ(by_pixel.hit(x, y, i).t, by_corner.hit(x, y, i).t);
        ASSERT_EQ(by_pixel.hit(x, y, i).shape, by_corner.hit(x, y, i).shape);
      }
    }
  }
}

// The two halves of a block contain each of its rays once, with more samples of each pixel at a time.
TEST(CameraRays, HalvesAddUpToTheBlock) {
  const Scene scene = cornell(kSide);
  const accel::Bvh bvh(scene);
  constexpr uint64_t kSamples = CameraRays::most_samples(BlockPart::kEven);
  static_assert(kSamples == 2 * CameraRays::most_samples(BlockPart::kWhole));
  CameraRays whole;
  std::array<CameraRays, kHalves> halves;
  halves[0].trace(bvh, 0, 4, 4, BlockPart::kEven, 0, kSamples);
  halves[1].trace(bvh, 0, 4, 4, BlockPart::kOdd, 0, kSamples);
  for (uint64_t i = 0; i < kSamples; ++i) {
    whole.trace(bvh, 0, 4, 4, BlockPart::kWhole, i, 1);
    for (int y = 4; y < 8; ++y)
      for (int x = 4; x < 8; ++x) {
        ASSERT_EQ(halves[size_t(half_of(x, y))].ray(x, y, i).d, whole.ray(x, y, i).d);
        ASSERT_EQ(halves[size_t(half_of(x, y))].hit(x, y, i).t, whole.hit(x, y, i).t);
      }
  }
}

// A sampler that skips the numbers of the camera ray continues like one that drew them, and no two pixels
// share their points.
TEST(CameraRays, SamplersContinueAfterTheRaysNumbers) {
  const Camera camera;
  const uint64_t stream = pixel_stream(7, camera, 2, 3);
  Sampler whole(stream, 11), rest(stream, 11, ray_dimensions(camera));
  whole.next_2d();
  for (int i = 0; i < 9; ++i) EXPECT_EQ(rest.next_1d(), whole.next_1d());
  EXPECT_NE(pixel_stream(7, camera, 3, 2), stream);
  EXPECT_NE(pixel_stream(8, camera, 2, 3), stream);
}

}  // namespace
}  // namespace kaustik::render
