#pragma once
// Area lights: surfaces that emit diffusely.

#include <variant>
#include <vector>

#include "core/geometry/interaction.h"
#include "core/light/image/emission_image.h"
#include "core/light/interface/light_bounds.h"
#include "core/sampling/discrete.h"
#include "core/texture/texture.h"

namespace kaustik {

// Surfaces that emit, as oriented copies of the geometry in world space.
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
  bool inward = false;  // emits inward
};
struct SweptEmitter {
  SweptGeometry shape;
  bool inward = false;  // emits inward
};
struct DiskEmitter {
  Transform to_world;
  float inner;
  Normal3 n;
};

// Opacity of a light's surface (Shape::alpha). Rays that hit the surface see its full radiance, so samples on
// it are weighted by alpha.
struct EmitterAlpha {
  float constant = 1;
  uint32_t texture = kNoIndex;  // a float texture of the set
  std::shared_ptr<const TextureSet> textures;

  float at(const TexturePoint& x) const {
    return texture == kNoIndex ? constant : std::clamp(textures->evaluate_float(texture, x), 0.0f, 1.0f);
  }
};

// Lambertian emitter with radiance L (W/(m^2 sr)), or L times an image, on its outside or on both sides.
struct DiffuseAreaLight {
  static constexpr std::string_view kName = "diffuse";

  std::variant<TriangleEmitter, SphereEmitter, DiskEmitter, SweptEmitter> surface;
  Rgb L{1};
  bool twosided = false;
  bool invisible = false;  // pbrt's lights of alpha 0: they emit, but no ray hits them
  float area = 0;          // m^2, one side
  std::shared_ptr<const EmissionImage> image;
  std::shared_ptr<const EmitterAlpha> alpha;  // null: opaque; otherwise an image is required

  // Makes a light from a shape. Returns nothing if the shape cannot be sampled by area: a sphere or cylinder
  // whose transform does not keep it round, an instance, or a shape without a finite, positive area.
  static std::optional<DiffuseAreaLight> make(const Shape& shape, const Rgb& L, bool twosided,
                                              std::shared_ptr<const LightImage> image = nullptr);

  bool is_delta() const { return invisible; }
  // Radiance that leaves a point on the light in direction w (unit).
  Rgb Le(const SurfaceInteraction& on_light, const Vector3& w) const {
    if (!twosided && !(glm::dot(on_light.n, w) > 0)) return Rgb(0);
    return image ? L * image->value(image->uv(image->place_of(on_light))) : L;
  }
  std::optional<LightSample> sample_Li(const Point3& ref, const Point2& u) const;
  // Density of sample_Li, per solid angle at ref. on_light: the point of this light hit by the ray from ref
  // in direction wi.
  float pdf_Li(const Point3& ref, const Vector3& wi, const SurfaceInteraction& on_light) const;
  std::optional<EmissionSample> sample_Le(const Point2& u_pos, const Point2& u_dir, EmissionMode mode) const;
  // Power of the light, as if alpha were one everywhere.
  Rgb power() const { return flux_of(area, image ? L * image->mean() : L); }
  std::optional<LightBounds> bounds() const;
  double brightness(double scene_size) const;
  // Flux that an area a with radiance Le emits.
  Rgb flux_of(float a, const Rgb& Le) const { return (twosided ? 2.0f : 1.0f) * kPi * a * Le; }
};

// Whether the shape is analytic, and points that are uniform in its own space are uniform in the world. A
// sphere or cylinder under an uneven scale is not so, and cannot be a light.
bool keeps_areas_even(const Shape& shape);

}  // namespace kaustik
