#pragma once
// Environment light through a rectangular opening (Bitterli et al. 2015, "Portal-Masked Environment Map
// Sampling").

#include <memory>

#include "core/light/image/direction_map.h"
#include "core/light/interface/light_bounds.h"
#include "core/math/frame.h"
#include "core/sampling/windowed_2d.h"

namespace kaustik {

// The part of a sky that is visible through a rectangular opening, parametrised by angles (alpha, beta) =
// (atan(x/z), atan(y/z)) of directions that leave through it (z > 0 in its frame), each from -pi/2 to pi/2
// and mapped to the unit square (Bitterli et al. 2015). Seen from a point, the portal is a rectangle in this
// square. Immutable; thread-safe.
class PortalSky {
 public:
  // Resamples the map's colours to a square grid with as many cells per side as the map has rows, from 64 to
  // 2048. to_map: from the portal's frame.
  PortalSky(const DirectionMap& map, const glm::mat3& to_map);
  // A sky of one colour.
  explicit PortalSky(const Rgb& L);

  // Maps w (in the portal's frame, w.z > 0) to a point of the square.
  static Point2 square_of(const Vector3& w);
  // Maps a point of the square to a unit direction; *solid_angle receives the solid angle per area of the
  // square.
  static Vector3 direction_of(const Point2& p, float* solid_angle);

  Rgb value(const Point2& p) const;
  // Density proportional to luminance times solid angle, for shadow rays.
  const WindowedPiecewiseConstant2D& seen() const { return seen_; }
  // Samples by luminance times solid angle times the portal's cosine, for photons.
  struct Photon {
    Vector3 w;  // unit, in the portal's frame, towards the sky
    Rgb flux;   // per area of the portal: L cos / pdf, W/m^2
  };
  std::optional<Photon> sample_photon(const Point2& u) const;
  Rgb irradiance() const { return irradiance_; }  // of the portal from outside, W/m^2
  Rgb brightest() const { return brightest_; }    // maximum per channel

 private:
  void prepare();

  int resolution_ = 0;
  std::vector<Rgb> cells_;
  WindowedPiecewiseConstant2D seen_;
  PiecewiseConstant2D photons_;
  Rgb irradiance_{0}, brightest_{0};
};

// A sky that shines only through a rectangle (pbrt-v4's PortalImageInfiniteLight). It reaches points behind
// the rectangle, from the directions that leave through it to infinity. Objects outside cast shadows but are
// not lit.
struct PortalInfiniteLight {
  static constexpr std::string_view kName = "infinite portal";

  Point3 corner{0};
  Vector3 along_x{1, 0, 0}, along_y{0, 1, 0};  // sides of the rectangle
  glm::mat3 to_world{1};                       // columns: the unit sides, and their normal towards the sky
  std::shared_ptr<const PortalSky> sky;
  float scale = 1;

  static constexpr bool is_delta() { return false; }
  Rgb Le(const Ray& escaping) const;
  std::optional<LightSample> sample_Li(const Point3& ref, const Point2& u) const;
  float pdf_Li(const Point3& ref, const Vector3& wi) const;
  // Starts on the portal. The sample is valid only if nothing blocks the ray backwards
  // (EmissionSample::from_sky).
  std::optional<EmissionSample> sample_Le(const Point2& u_pos, const Point2& u_dir, EmissionMode mode) const;
  // Flux through the portal if nothing blocks it.
  Rgb power() const;
  std::optional<LightBounds> bounds() const { return std::nullopt; }
  double brightness(double /*scene_size*/) const {
    return double(scale) * double(max_component(sky->brightest()));
  }

 private:
  // The part of the square that the portal covers as seen from p; nothing if p is outside.
  std::optional<Window> window_from(const Point3& p) const;
};

}  // namespace kaustik
