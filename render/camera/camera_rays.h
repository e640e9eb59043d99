#pragma once
// Camera rays of neighbouring pixels, traced in packets: a packet holds one sample of each pixel of a block.
// Blocks are counted from the corner of the full image and are traced whole even where the film's window cuts
// them, so that a ray is in the same packet in every crop of an image.

#include "accel/bvh.h"
#include "core/sampling/sampler.h"

namespace kaustik::render {

inline constexpr int kRayBlock = 4;  // pixels along each axis of a block

// Index of pixel (x, y) of the full image in its block.
inline constexpr uint32_t pixel_of_block(int x, int y) {
  return uint32_t(y % kRayBlock * kRayBlock + x % kRayBlock);
}

// All pixels of a block, or those of one colour of a checkerboard.
enum class BlockPart { kWhole, kEven, kOdd };
inline constexpr int pixels_in(BlockPart part) {
  return kRayBlock * kRayBlock / (part == BlockPart::kWhole ? 1 : 2);
}
inline constexpr int kHalves = 2;
// Which half pixel (x, y) belongs to: 0 for kEven, 1 for kOdd.
inline constexpr int half_of(int x, int y) {
  return (x + y) & 1;
}
inline constexpr bool has_pixel(BlockPart part, int x, int y) {
  return part == BlockPart::kWhole || half_of(x, y) == (part == BlockPart::kOdd);
}

// Sampler seed of pixel (x, y) of the full image; the point with index i is the pixel's sample i. The first
// dimensions are the position in the pixel, followed by that on the lens if there is one.
uint64_t pixel_stream(uint64_t seed, const Camera& camera, int x, int y);
inline uint32_t ray_dimensions(const Camera& camera) {
  return camera.lens_radius() > 0 ? 4 : 2;
}

class CameraRays {
 public:
  // Most samples of each pixel that trace() accepts at once.
  static constexpr uint64_t most_samples(BlockPart part) {
    return uint64_t(accel::kRayLanes) / uint64_t(pixels_in(part));
  }

  // Generates and intersects the rays of samples [first, first + count) for the pixels of one part of block
  // (x / kRayBlock, y / kRayBlock). Samples have the density of the pixel filter's absolute value. Pixels
  // beyond the image repeat its last column or row.
  void trace(const accel::Bvh& bvh, uint64_t seed, int x, int y, BlockPart part, uint64_t first,
             uint64_t count);

  Ray ray(int x, int y, uint64_t sample) const { return rays_.get(lane(x, y, sample)); }
  Hit hit(int x, int y, uint64_t sample) const { return hits_.get(lane(x, y, sample)); }
  // Sample weight: 1, or -1 where the pixel filter is negative.
  int weight(int x, int y, uint64_t sample) const { return weights_[lane(x, y, sample)]; }

 private:
  size_t lane(int x, int y, uint64_t sample) const {
    // Any two neighbours in a row belong to different halves, so halving the index numbers the pixels of a
    // half consecutively.
    const uint32_t place = pixel_of_block(x, y) >> (part_ != BlockPart::kWhole);
    return size_t((sample - first_) * uint64_t(pixels_in(part_)) + place);
  }

  accel::RayLanes rays_;
  accel::HitLanes hits_;
  int8_t weights_[accel::kRayLanes];
  uint64_t first_ = 0;
  BlockPart part_ = BlockPart::kWhole;
};

}  // namespace kaustik::render
