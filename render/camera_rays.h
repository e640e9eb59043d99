#pragma once
// Camera rays of neighbouring pixels, which go through the scene together: a packet holds one sample of each
// pixel of a block. Blocks are counted from the corner of the full image, and are whole wherever the film's
// window ends, so that a ray has the same company in every part of an image that is rendered by itself.

#include "accel/bvh.h"
#include "core/sampling/sampler.h"

namespace kaustik::render {

inline constexpr int kRayBlock = 4;  // pixels along each axis of a block

// The Sampler seed of pixel (x, y) of the full image, whose samples are its points. Their first dimensions
// are the place in the pixel.
uint64_t pixel_stream(uint64_t seed, const PerspectiveCamera& camera, int x, int y);
inline constexpr uint32_t kRayDimensions = 2;

class CameraRays {
 public:
  // Samples of each pixel that are traced at once, at most.
  static constexpr uint64_t kSamples = accel::kRayLanes / (kRayBlock * kRayBlock);

  // Rays of samples [first, first + count) of the pixels of block (x / kRayBlock, y / kRayBlock), and what
  // they meet. Uniform over each pixel (box filter). Beyond the image its last pixels stand again.
  void trace(const accel::Bvh& bvh, uint64_t seed, int x, int y, uint64_t first, uint64_t count);

  Ray ray(int x, int y, uint64_t sample) const { return rays_.get(lane(x, y, sample)); }
  Hit hit(int x, int y, uint64_t sample) const { return hits_.get(lane(x, y, sample)); }

 private:
  size_t lane(int x, int y, uint64_t sample) const {
    return size_t((sample - first_) * kRayBlock + uint64_t(y % kRayBlock)) * kRayBlock +
           size_t(x % kRayBlock);
  }

  accel::RayLanes rays_;
  accel::HitLanes hits_;
  uint64_t first_ = 0;
};

}  // namespace kaustik::render
