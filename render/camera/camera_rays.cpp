// Generates the camera rays of a block and intersects them in packets.

#include "render/camera/camera_rays.h"

#include <algorithm>

#include "core/sampling/warp.h"

namespace kaustik::render {

namespace {

constexpr uint64_t kCameraStream = 0xca3e;  // separates the random numbers of pixels from those of photons

// Raster position of a sample of pixel (x, y), and the sample's weight.
Point2 raster_of(const PixelFilter& filter, int x, int y, const Point2& u, int8_t* weight) {
  const Point2 corner(x, y);
  *weight = 1;
  if (filter.is_pixel_box()) return corner + u;
  const FilterSample s = filter.sample(u);
  *weight = static_cast<int8_t>(s.weight);
  return corner + 0.5f + s.offset;
}

}  // namespace

uint64_t pixel_stream(uint64_t seed, const Camera& camera, int x, int y) {
  const uint64_t pixel = uint64_t(y) * uint64_t(camera.width) + uint64_t(x);
  return hash_combine(hash_combine(seed, kCameraStream), pixel);
}

void CameraRays::trace(const accel::Bvh& bvh, uint64_t seed, int x, int y, BlockPart part, uint64_t first,
                       uint64_t count) {
  const Camera& camera = bvh.scene().camera;
  const RayGenerator generate(camera);
  const bool lens = camera.lens_radius() > 0;
  const int x0 = x - x % kRayBlock, y0 = y - y % kRayBlock;
  first_ = first, part_ = part;
  for (int i = 0; i < kRayBlock * kRayBlock; ++i) {
    const int px = x0 + i % kRayBlock, py = y0 + i / kRayBlock;
    if (!has_pixel(part, px, py)) continue;
    const int in_x = std::min(px, camera.width - 1), in_y = std::min(py, camera.height - 1);
    const uint64_t stream = pixel_stream(seed, camera, in_x, in_y);
    for (uint64_t sample = first; sample < first + count; ++sample) {
      const size_t k = lane(px, py, sample);
      Sampler sampler(stream, sample);
      const Point2 raster = raster_of(camera.filter, in_x, in_y, sampler.next_2d(), &weights_[k]);
      const Ray ray = lens ? generate.through(raster, sample_uniform_disk_concentric(sampler.next_2d()))
                           : generate(raster);
      for (int c = 0; c < 3; ++c) {
        rays_.o[c][k] = ray.o[c];
        rays_.d[c][k] = ray.d[c];
      }
    }
  }
  bvh.intersect(rays_, size_t(count) * size_t(pixels_in(part)), &hits_, accel::RayOrder::kNeighbours);
}

}  // namespace kaustik::render
