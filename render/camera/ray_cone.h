#pragma once
// Cone about a camera ray that stands for its pixel, for the footprints of textures (Akenine-Möller et al.
// 2021, "Improved Shader and Texture Level of Detail Using Ray Cones"). Flat mirrors and windows leave it
// unchanged. Not handled: curved mirrors and lenses. Behind them textures are looked up more sharply than a
// pixel needs, which costs samples but blurs nothing.

#include "core/scene/bsdf_at.h"

namespace kaustik::render {

struct RayCone {
  float width = 0;   // diameter, metres
  float spread = 0;  // growth of width per length

  RayCone after(float length) const { return {width + spread * length, spread}; }

  // Footprint of the cone on a plane of normal n, hit in direction d (unit): its shorter and its longer axis.
  Footprint on_surface(const Vector3& d, const Normal3& n) const {
    constexpr float kMostStretch = 32;
    const float cosine = glm::dot(d, n);
    const Vector3 across = glm::cross(n, d);
    const float sine = glm::length(across);
    if (!(sine > 0)) {
      const Frame frame = Frame::from_z(n);
      return {width * frame.x, width * frame.y};
    }
    const Vector3 along = (d - cosine * n) / sine;
    return {width / sine * across, std::min(1 / std::abs(cosine), kMostStretch) * width * along};
  }
};

// Cone of one sample of a pixel at the image's centre: as wide as the pixel divided by the root of the
// samples, but at least an eighth of the pixel (Pharr et al. 2023, section 10.1.3). samples: those of the
// pixel once the pass is done. Of fewer than kFewest, which more passes may follow, the cone is that of
// kFewest: what is not linear in a texture, such as the light of a bump map, is wrong where wide footprints
// have made it even.
inline RayCone camera_cone(const Camera& camera, uint64_t samples) {
  constexpr uint64_t kFewest = 16;
  const Point2 centre(0.5f * float(camera.width), 0.5f * float(camera.height));
  const Ray a = camera.generate_ray(centre), b = camera.generate_ray(centre + Vector2(1, 0));
  const float scale = std::max(0.125f, 1 / std::sqrt(float(std::max(samples, kFewest))));
  return {scale * glm::distance(a.o, b.o), scale * glm::distance(a.d, b.d)};
}

}  // namespace kaustik::render
