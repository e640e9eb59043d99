// Roughness parameters of GGX microfacets, and sampling of their visible normals.

#include "core/bsdf/microfacet/ggx.h"

#include "core/sampling/warp.h"

namespace kaustik {

Ggx Ggx::from_roughness(float u, float v, bool remap) {
  const float x = remap ? std::sqrt(u) : u, y = remap ? std::sqrt(v) : v;
  if (std::max(x, y) < kSmoothAlpha) return {};
  return {std::max(x, kLeastAlpha), std::max(y, kLeastAlpha)};
}

Vector3 Ggx::sample_visible(const Vector3& w, const Point2& u) const {
  // The facets of the ellipsoid seen from w correspond to those of a hemisphere seen from wh.
  const Vector3 wh = glm::normalize(Vector3(alpha_x * w.x, alpha_y * w.y, std::abs(w.z)));
  const float sin2 = wh.x * wh.x + wh.y * wh.y;
  const Vector3 t1 = sin2 > 0 ? Vector3(-wh.y, wh.x, 0) / std::sqrt(sin2) : Vector3(1, 0, 0);
  const Vector3 t2 = glm::cross(wh, t1);
  // The projection of the hemisphere is half a disk and half an ellipse.
  const PolarSample disk = sample_disk_polar(u);
  const Point2 p = disk.r * disk.direction;
  const float half = std::sqrt(std::max(0.0f, 1 - p.x * p.x)), s = 0.5f * (1 + wh.z);
  const float y = (1 - s) * half + s * p.y;
  const float z = std::sqrt(std::max(0.0f, 1 - p.x * p.x - y * y));
  const Vector3 nh = p.x * t1 + y * t2 + z * wh;
  const Vector3 wm = glm::normalize(Vector3(alpha_x * nh.x, alpha_y * nh.y, std::max(1e-6f, nh.z)));
  return w.z < 0 ? Vector3(wm.x, wm.y, -wm.z) : wm;
}

}  // namespace kaustik
