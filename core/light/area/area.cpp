// Area lights: samples uniform points on triangles, spheres and disks, directions in the cone that a sphere
// subtends (Pharr et al. 2023, section 6.2.4), and photon emission.

#include "core/light/area/area.h"

#include "core/geometry/analytic/quadric_bounds.h"
#include "core/geometry/triangle_bounds.h"
#include "core/sampling/warp.h"

namespace kaustik {
namespace {

// A point on a light, before any direction is known.
struct SurfaceSample {
  Point3 p;
  float p_error;
  Normal3 n;  // outside
};

SurfaceSample point_on_triangle(const TriangleEmitter::Triangle& t, const Point2& u) {
  const Point2 b = sample_uniform_triangle(u);
  const Point3 p = t.p0 + (b.x * t.e1 + b.y * t.e2);
  return {p, triangle_error(p, t.e1, t.e2), t.n};
}

SurfaceSample sample_surface(const TriangleEmitter& e, const Point2& u) {
  const DiscreteDistribution::Sample choice = e.by_area.sample(u.x);
  return point_on_triangle(e.triangles[choice.index], {choice.u_remapped, u.y});
}

SurfaceSample sample_surface(const SphereEmitter& e, const Point2& u) {
  const Vector3 out = sample_uniform_sphere(u);
  return {e.center + e.radius * out, sphere_error(e.center, e.radius), e.inward ? -out : out};
}

SurfaceSample sample_surface(const DiskEmitter& e, const Point2& u) {
  PolarSample s = sample_disk_polar(u);
  if (e.inner > 0) s.r = std::sqrt(e.inner * e.inner + s.r * s.r * (1 - e.inner * e.inner));
  const Point3 p = e.to_world.point({s.r * s.direction.x, s.r * s.direction.y, 0});
  return {p, disk_error(e.to_world), e.n};
}

SurfaceSample sample_surface(const SweptEmitter& e, const Point2& u) {
  const auto sample = [&](const auto& shape) {
    const Transform& t = shape.to_world;
    const Point3 p = shape.sample_uniform(u);
    const Normal3 n = unit_vector(t.normal(Normal3(shape.normal_at(glm::dvec3(p)))));
    return SurfaceSample{t.point(p), shape.error(), e.inward ? -n : n};
  };
  return std::visit(sample, e.shape);
}

// A point on a light, its emitted radiance, and one over its density per area. Used for all lights except
// spheres seen from outside.
struct EmittingSample {
  SurfaceSample at;
  Rgb L;
  float area;
};

// The point at `place`; lights with an image are triangles or quadrics.
SurfaceSample surface_at(const DiffuseAreaLight& light, const EmissionImage::Place& place) {
  if (const auto* mesh = std::get_if<TriangleEmitter>(&light.surface))
    return point_on_triangle(mesh->triangles[place.part], place.u);
  return sample_surface(std::get<SweptEmitter>(light.surface), place.u);
}

EmittingSample sample_emitting(const DiffuseAreaLight& light, const Point2& u) {
  if (!light.image) {
    return {std::visit([&](const auto& e) { return sample_surface(e, u); }, light.surface), light.L,
            light.area};
  }
  const EmissionImage::Sample s = light.image->sample(u);
  const Point2 uv = light.image->uv(s.place);
  const EmittingSample out{surface_at(light, s.place), light.L * light.image->value(uv), s.area};
  if (!light.alpha) return out;
  const TexturePoint x{out.at.p, out.at.n, uv};
  return {out.at, out.L * light.alpha->at(x), out.area};
}

// Whether ref is clearly outside the sphere. Points on the sphere itself, known up to their rounding, count
// as inside, where sampling by area is correct from either side.
bool outside(const SphereEmitter& e, const Point3& ref) {
  const float reach = e.radius + 2 * sphere_error(e.center, e.radius);
  return length_squared(ref - e.center) > reach * reach;
}

// 1 - cosine of the half-angle that the sphere subtends at an outside point, without cancellation.
float subtended_one_minus_cos(float sin2_max) {
  return sin2_max / (1 + std::sqrt(std::max(0.0f, 1 - sin2_max)));
}

// Samples uniformly within the subtended cone. The point on the sphere is found from its angle alpha at the
// centre (Pharr et al. 2023, equation 6.18), which is precise even for small and distant spheres.
std::optional<LightSample> sample_sphere_cone(const SphereEmitter& e, const Point3& ref, const Point2& u,
                                              const Rgb& L) {
  const Vector3 to_ref = ref - e.center;
  const float distance2 = length_squared(to_ref);
  const float sin2_max = e.radius * e.radius / distance2;
  const float one_minus_cos_max = subtended_one_minus_cos(sin2_max);
  const float h = u.x * one_minus_cos_max;  // 1 - cos theta
  const float sin2_theta = h * (2 - h);
  const float sin2_ratio = std::min(1.0f, sin2_theta / sin2_max);
  const float cos_alpha = sin2_theta / std::sqrt(sin2_max) + (1 - h) * std::sqrt(1 - sin2_ratio);
  const float sin_alpha = std::sqrt(std::max(0.0f, (1 - cos_alpha) * (1 + cos_alpha)));
  const Frame frame = Frame::from_z(to_ref / std::sqrt(distance2));
  const Point2 xy = sin_alpha * cos_sin_turns(u.y);
  const Vector3 out = frame.to_world({xy.x, xy.y, cos_alpha});
  const Point3 p = e.center + e.radius * out;
  const Vector3 to_light = p - ref;
  const float length2 = length_squared(to_light);
  if (!(length2 > 0)) return std::nullopt;
  const Point3 p_light = p + sphere_error(e.center, e.radius) * out;
  return LightSample{to_light / std::sqrt(length2), L, uniform_cone_pdf(one_minus_cos_max), p_light, false};
}

// Converts the density 1/area of a point on the light to solid angle at ref.
float area_to_solid_angle(float distance2, float abs_cos, float area) {
  return distance2 / (abs_cos * area);
}

std::optional<LightSample> sample_by_area(const DiffuseAreaLight& light, const Point3& ref, const Point2& u) {
  const EmittingSample emitting = sample_emitting(light, u);
  const SurfaceSample& s = emitting.at;
  const Vector3 to_light = s.p - ref;
  const float distance2 = length_squared(to_light);
  if (!(distance2 > 0)) return std::nullopt;
  const Vector3 wi = to_light / std::sqrt(distance2);
  const float cos_out = -glm::dot(wi, s.n);
  if (cos_out == 0 || (cos_out < 0 && !light.twosided)) return std::nullopt;
  const float pdf = area_to_solid_angle(distance2, std::abs(cos_out), emitting.area);
  if (!std::isfinite(pdf)) return std::nullopt;
  return LightSample{wi, emitting.L, pdf, offset_origin(s.p, s.p_error, s.n, -wi), false};
}

// Chooses the direction first, then a point of the disc that the sphere shows it: radiance is even over
// directions and discs. So the directions towards a small target are the same for all points, and a guide of
// emission finds them as one box of u_dir (photon/emission/emission_guide.h).
std::optional<EmissionSample> emitted_by_sphere(const SphereEmitter& e, bool twosided, const Rgb& flux,
                                                const Point2& u_pos, const Point2& u_dir) {
  bool inward = e.inward;
  Point2 u = u_dir;
  if (twosided) {
    inward = u.x < 0.5f;
    u.x = inward ? 2 * u.x : 2 * u.x - 1;
  }
  Vector3 local = sample_cosine_hemisphere(u_pos);
  if (!(local.z > 0)) return std::nullopt;
  if (inward) local.z = -local.z;
  const Vector3 d = sample_uniform_sphere(u);
  const Vector3 out = Frame::from_z(d).to_world(local);
  const float error = sphere_error(e.center, e.radius);
  return EmissionSample{{e.center + (e.radius + (inward ? -error : error)) * out, d}, flux};
}

}  // namespace

std::optional<LightSample> DiffuseAreaLight::sample_Li(const Point3& ref, const Point2& u) const {
  if (const auto* sphere = std::get_if<SphereEmitter>(&surface); sphere && outside(*sphere, ref)) {
    if (sphere->inward && !twosided) return std::nullopt;
    return sample_sphere_cone(*sphere, ref, u, L);
  }
  return sample_by_area(*this, ref, u);
}

float DiffuseAreaLight::pdf_Li(const Point3& ref, const Vector3& wi,
                               const SurfaceInteraction& on_light) const {
  const float cos_out = -glm::dot(wi, on_light.n);
  if (cos_out == 0 || (cos_out < 0 && !twosided)) return 0;
  if (const auto* sphere = std::get_if<SphereEmitter>(&surface); sphere && outside(*sphere, ref)) {
    const float sin2_max = sphere->radius * sphere->radius / length_squared(ref - sphere->center);
    return uniform_cone_pdf(subtended_one_minus_cos(sin2_max));
  }
  const float per_density = image ? image->area(image->place_of(on_light)) : area;
  const float pdf = area_to_solid_angle(length_squared(on_light.p - ref), std::abs(cos_out), per_density);
  return std::isfinite(pdf) ? pdf : 0;
}

std::optional<EmissionSample> DiffuseAreaLight::sample_Le(const Point2& u_pos, const Point2& u_dir,
                                                          EmissionMode mode) const {
  if (const auto* sphere = std::get_if<SphereEmitter>(&surface); sphere && mode == EmissionMode::kCosine)
    return emitted_by_sphere(*sphere, twosided, flux_of(area, L), u_pos, u_dir);
  // Filled in place where it is returned: copying a value that has just been written would stall on the
  // writes.
  std::optional<EmissionSample> start;
  Point2 u = u_dir;
  float side = 1;
  if (twosided) {
    side = u.x < 0.5f ? 1.0f : -1.0f;
    u.x = u.x < 0.5f ? 2 * u.x : 2 * u.x - 1;
  }
  Vector3 local;
  float factor = 1;
  if (mode == EmissionMode::kCosine) {
    local = sample_cosine_hemisphere(u);
  } else {
    // The density per solid angle is 1/(pi^2 sin theta), so flux = L cos pi^2 sin area = power() pi cos sin.
    const Point2 theta = cos_sin_turns(0.25f * u.x);
    const Point2 phi = cos_sin_turns(u.y);
    local = {theta.y * phi.x, theta.y * phi.y, theta.x};
    factor = kPi * theta.x * theta.y;
  }
  if (!(local.z > 0) || factor == 0) return start;
  const EmittingSample emitting = sample_emitting(*this, u_pos);
  const SurfaceSample& s = emitting.at;
  start.emplace();
  start->ray.o = s.p + (side * s.p_error) * s.n;
  start->ray.d = Frame::from_z(side * s.n).to_world(local);
  start->flux = flux_of(emitting.area, emitting.L) * factor;
  return start;
}

}  // namespace kaustik
