#pragma once
#include <memory>

#include "core/light/image/direction_map.h"
#include "core/light/light_types.h"
#include "core/math/frame.h"
#include "core/sampling/windowed_2d.h"

namespace kaustik {

// What a rectangular opening shows of a sky, by angles: (alpha, beta) = atan(x/z), atan(y/z) of directions
// that leave through it (z > 0 in its frame), each from -pi/2 to pi/2 (Bitterli et al. 2015). A portal and a
// point give a rectangle of this square. Immutable; thread-safe.
class PortalSky {
 public:
  // The map's colours, resampled to as many cells a side as it has rows, 64 at least and 2048 at most.
  // to_map: from the portal's frame.
  PortalSky(const DirectionMap& map, const glm::mat3& to_map);
  // One colour.
  explicit PortalSky(const Rgb& L);

  // w in the portal's frame, w.z > 0; a point of the square.
  static Point2 square_of(const Vector3& w);
  // Unit direction, and its solid angle per area of the square.
  static Vector3 direction_of(const Point2& p, float* solid_angle);

  Rgb value(const Point2& p) const;
  // By luminance times solid angle, for shadow rays.
  const WindowedPiecewiseConstant2D& seen() const { return seen_; }
  // By luminance times solid angle times the portal's cosine, for photons.
  struct Photon {
    Vector3 w;  // unit, in the portal's frame, to the sky
    Rgb flux;   // per area of the portal: L cos / pdf, W/m^2
  };
  std::optional<Photon> sample_photon(const Point2& u) const;
  Rgb irradiance() const { return irradiance_; }  // of the portal, from outside, W/m^2
  Rgb brightest() const { return brightest_; }    // per channel

 private:
  void prepare();

  int resolution_ = 0;
  std::vector<Rgb> cells_;
  WindowedPiecewiseConstant2D seen_;
  PiecewiseConstant2D photons_;
  Rgb irradiance_{0}, brightest_{0};
};

// A sky that shines through a rectangle only (pbrt-v4's PortalImageInfiniteLight): on a point behind it, from
// the directions that leave through it to infinity. What stands outside casts shadows but is not lit.
struct PortalInfiniteLight {
  static constexpr bool kDelta = false;
  static constexpr std::string_view kName = "infinite portal";

  Point3 corner{0};
  Vector3 along_x{1, 0, 0}, along_y{0, 1, 0};  // the rectangle's sides
  glm::mat3 to_world{1};                       // unit sides and, to the sky, their normal
  std::shared_ptr<const PortalSky> sky;
  float scale = 1;

  Rgb Le(const Ray& escaping) const;
  std::optional<LightSample> sample_Li(const Point3& ref, const Point2& u) const;
  float pdf_Li(const Point3& ref, const Vector3& wi) const;
  // Starts on the portal; meant only where nothing stands behind the start.
  std::optional<EmissionSample> sample_Le(const Point2& u_pos, const Point2& u_dir, EmissionMode mode) const;
  // Flux through the portal if nothing stands before it.
  Rgb power() const;

 private:
  // What of the square the portal covers, seen from p; nothing from outside.
  std::optional<Window> window_from(const Point3& p) const;
};

}  // namespace kaustik
