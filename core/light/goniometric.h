#pragma once
// Point lights whose intensity is given by an image.

#include <memory>

#include "core/light/image/direction_map.h"
#include "core/light/interface/light_bounds.h"

namespace kaustik {

// Point light whose radiant intensity depends on the direction: I (W/sr) times the red channel of a map.
struct GoniometricLight {
  static constexpr std::string_view kName = "goniometric";

  Point3 position{0};
  glm::mat3 to_world{1};  // orthogonal, from the map's space
  std::shared_ptr<const DirectionMap> map;
  Rgb I{1};

  static constexpr bool is_delta() { return true; }
  // Radiant intensity in direction w (unit, away from the light).
  Rgb intensity(const Vector3& w) const { return I * map->value(w * to_world).x; }
  std::optional<LightSample> sample_Li(const Point3& ref, const Point2& u) const;
  std::optional<EmissionSample> sample_Le(const Point2& u_pos, const Point2& u_dir, EmissionMode mode) const;
  Rgb power() const { return 4 * kPi * map->mean().x * I; }
  std::optional<LightBounds> bounds() const { return bounds_of_point(position, I * map->mean().x); }
  double brightness(double scene_size) const {
    return point_light_brightness(I * map->brightest().x, scene_size);
  }
};

}  // namespace kaustik
