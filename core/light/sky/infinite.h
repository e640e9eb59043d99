#pragma once
// Environment light: constant, or given by an image.

#include <memory>

#include "core/light/image/direction_map.h"
#include "core/light/interface/light_bounds.h"

namespace kaustik {

// Constant radiance L from every direction. finalize_scene sets the scene's bounding sphere.
struct InfiniteLight {
  static constexpr std::string_view kName = "infinite";

  Rgb L{1};
  Point3 scene_center{0};
  float scene_radius = 0;

  static constexpr bool is_delta() { return false; }
  Rgb Le(const Ray& /*escaping*/) const { return L; }
  // Samples directions as for uniform light (core/light/sky/even_light.h).
  std::optional<LightSample> sample_Li(const LightReceiver& x, const Point2& u) const;
  float pdf_Li(const LightReceiver& x, const Vector3& wi) const;
  std::optional<EmissionSample> sample_Le(const Point2& u_pos, const Point2& u_dir, EmissionMode mode) const;
  // Flux that enters the scene's bounding sphere.
  Rgb power() const { return 4 * kPi * kPi * scene_radius * scene_radius * L; }
  std::optional<LightBounds> bounds() const { return std::nullopt; }
  double brightness(double /*scene_size*/) const { return double(max_component(L)); }
};

// Radiance from every direction, given by an image. finalize_scene sets the scene's bounding sphere.
struct ImageInfiniteLight {
  static constexpr std::string_view kName = "infinite image";

  std::shared_ptr<const DirectionMap> map;
  glm::mat3 to_world{1};  // orthogonal
  float scale = 1;
  Point3 scene_center{0};
  float scene_radius = 0;

  static constexpr bool is_delta() { return false; }
  Rgb Le(const Ray& escaping) const { return scale * map->value(to_map(escaping.d)); }
  // Samples the even part of the sky as uniform light (core/light/sky/even_light.h), and the excess over it
  // by luminance.
  std::optional<LightSample> sample_Li(const LightReceiver& x, const Point2& u) const;
  float pdf_Li(const LightReceiver& x, const Vector3& wi) const;
  std::optional<EmissionSample> sample_Le(const Point2& u_pos, const Point2& u_dir, EmissionMode mode) const;
  // Flux that enters the scene's bounding sphere.
  Rgb power() const { return 4 * kPi * kPi * scene_radius * scene_radius * scale * map->mean(); }
  std::optional<LightBounds> bounds() const { return std::nullopt; }
  double brightness(double /*scene_size*/) const {
    return double(scale) * double(max_component(map->brightest()));
  }

 private:
  Vector3 to_map(const Vector3& w) const { return w * to_world; }  // multiplies by the transposed matrix
};

}  // namespace kaustik
