#pragma once
#include <variant>
#include <vector>

#include "core/geometry/interaction.h"
#include "core/light/image/emission_image.h"
#include "core/light/light_types.h"
#include "core/sampling/discrete.h"
#include "core/texture/texture.h"

namespace kaustik {

// Surfaces that emit: their own copy of the geometry, in world space, oriented.
struct TriangleEmitter {
  struct Triangle {
    Point3 p0;
    Vector3 e1, e2;
    Normal3 n;  // unit, outside
  };
  std::vector<Triangle> triangles;
  DiscreteDistribution by_area;
};
struct SphereEmitter {
  Point3 center;
  float radius;
  bool inward = false;  // emits to the inside
};
struct QuadricEmitter {
  Quadric quadric;
  bool inward = false;  // emits to the inside
};
struct DiskEmitter {
  Transform to_world;
  float inner;
  Normal3 n;
};

// What of a light's surface is there (Shape::alpha). Rays that meet it meet all of what they meet, so samples
// of it count by the share.
struct EmitterAlpha {
  float constant = 1;
  uint32_t texture = kNoIndex;  // a float texture of the set
  std::shared_ptr<const TextureSet> textures;

  float at(const TexturePoint& x) const {
    return texture == kNoIndex ? constant : std::clamp(textures->evaluate_float(texture, x), 0.0f, 1.0f);
  }
};

// Lambertian emitter of radiance L (W/(m^2 sr)), or L times an image, on its outside or on both sides.
struct DiffuseAreaLight {
  static constexpr bool kDelta = false;
  static constexpr std::string_view kName = "diffuse";

  std::variant<TriangleEmitter, SphereEmitter, DiskEmitter, QuadricEmitter> surface;
  Rgb L{1};
  bool twosided = false;
  bool invisible = false;  // pbrt's lights of alpha 0: they shine, but no ray meets them
  float area = 0;          // m^2, one side
  std::shared_ptr<const EmissionImage> image;
  std::shared_ptr<const EmitterAlpha> alpha;  // null: all of it; needs an image

  // Empty when the shape cannot emit by area sampling: a sphere or cylinder under a transform that does not
  // keep it round, or an instance.
  static std::optional<DiffuseAreaLight> make(const Shape& shape, const Rgb& L, bool twosided,
                                              std::shared_ptr<const LightImage> image = nullptr);

  // Radiance that leaves a point of the light in direction w (unit).
  Rgb Le(const SurfaceInteraction& on_light, const Vector3& w) const {
    if (!twosided && !(glm::dot(on_light.n, w) > 0)) return Rgb(0);
    return image ? L * image->value(image->uv(image->place_of(on_light))) : L;
  }
  std::optional<LightSample> sample_Li(const Point3& ref, const Point2& u) const;
  // on_light: the point of this light that the ray from ref in direction wi meets.
  float pdf_Li(const Point3& ref, const Vector3& wi, const SurfaceInteraction& on_light) const;
  std::optional<EmissionSample> sample_Le(const Point2& u_pos, const Point2& u_dir, EmissionMode mode) const;
  // As if alpha were one everywhere.
  Rgb power() const { return flux_of(area, image ? L * image->mean() : L); }
  // Of an area of radiance Le.
  Rgb flux_of(float a, const Rgb& Le) const { return (twosided ? 2.0f : 1.0f) * kPi * a * Le; }
};

}  // namespace kaustik
