#include "render/camera_rays.h"

#include <algorithm>

namespace kaustik::render {

namespace {
constexpr uint64_t kCameraStream = 0xca3e;  // keeps the image's random numbers apart from the photons'
}

Sampler pixel_sampler(uint64_t seed, const PerspectiveCamera& camera, int x, int y, uint64_t sample,
                      uint32_t first_dimension) {
  const uint64_t pixel = uint64_t(y) * uint64_t(camera.width) + uint64_t(x);
  return Sampler(hash_combine(hash_combine(seed, kCameraStream), pixel), sample, first_dimension);
}

void CameraRays::trace(const accel::Bvh& bvh, uint64_t seed, int x, int y, uint64_t first, uint64_t count) {
  const PerspectiveCamera& camera = bvh.scene().camera;
  const float scale = camera.screen_scale();
  const int x0 = x - x % kRayBlock, y0 = y - y % kRayBlock;
  first_ = first;
  for (uint64_t sample = first; sample < first + count; ++sample) {
    for (int i = 0; i < kRayBlock * kRayBlock; ++i) {
      const int px = x0 + i % kRayBlock, py = y0 + i / kRayBlock;
      const int in_x = std::min(px, camera.width - 1), in_y = std::min(py, camera.height - 1);
      const Point2 u = pixel_sampler(seed, camera, in_x, in_y, sample, 0).next_2d();
      const Ray ray = camera.generate_ray({float(in_x) + u.x, float(in_y) + u.y}, scale);
      const size_t k = lane(px, py, sample);
      for (int c = 0; c < 3; ++c) {
        rays_.o[c][k] = ray.o[c];
        rays_.d[c][k] = ray.d[c];
      }
    }
  }
  bvh.intersect(rays_, size_t(count) * kRayBlock * kRayBlock, &hits_, accel::RayOrder::kNeighbours);
}

}  // namespace kaustik::render
