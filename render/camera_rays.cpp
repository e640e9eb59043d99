#include "render/camera_rays.h"

#include <algorithm>

namespace kaustik::render {

namespace {
constexpr uint64_t kCameraStream = 0xca3e;  // keeps the image's random numbers apart from the photons'
}

uint64_t pixel_stream(uint64_t seed, const PerspectiveCamera& camera, int x, int y) {
  const uint64_t pixel = uint64_t(y) * uint64_t(camera.width) + uint64_t(x);
  return hash_combine(hash_combine(seed, kCameraStream), pixel);
}

void CameraRays::trace(const accel::Bvh& bvh, uint64_t seed, int x, int y, uint64_t first, uint64_t count) {
  const PerspectiveCamera& camera = bvh.scene().camera;
  const float scale = camera.screen_scale();
  const int x0 = x - x % kRayBlock, y0 = y - y % kRayBlock;
  first_ = first;
  for (int i = 0; i < kRayBlock * kRayBlock; ++i) {
    const int px = x0 + i % kRayBlock, py = y0 + i / kRayBlock;
    const int in_x = std::min(px, camera.width - 1), in_y = std::min(py, camera.height - 1);
    const uint64_t stream = pixel_stream(seed, camera, in_x, in_y);
    for (uint64_t sample = first; sample < first + count; ++sample) {
      const Point2 u = Sampler(stream, sample).next_2d();
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
