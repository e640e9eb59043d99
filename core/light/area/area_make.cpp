// Builds area lights from shapes, with a copy of the geometry.

#include "core/geometry/analytic/quadric_bounds.h"
#include "core/geometry/triangle_bounds.h"
#include "core/light/area/area.h"

namespace kaustik {
namespace {

TriangleEmitter make_emitter(const TriangleMesh& mesh, bool flip_normal) {
  TriangleEmitter e;
  std::vector<double> areas;
  for (const auto& [i0, i1, i2] : mesh.indices) {
    const Point3 p0 = mesh.P[i0];
    const Vector3 e1 = mesh.P[i1] - p0;
    const Vector3 e2 = mesh.P[i2] - p0;
    const glm::dvec3 normal = glm::cross(glm::dvec3(e1), glm::dvec3(e2));
    const double length = glm::length(normal);
    if (!(length > 0)) continue;
    const Normal3 n(normal / length);
    e.triangles.push_back({p0, e1, e2, outside_of(mesh, {i0, i1, i2}, n, flip_normal) * n});
    areas.push_back(0.5 * length);
  }
  e.by_area = DiscreteDistribution(areas);
  return e;
}

// pbrt's uv of triangles in meshes without uv.
constexpr std::array<Point2, 3> kUvOfBareTriangle{Point2(0, 0), Point2(1, 0), Point2(1, 1)};

std::vector<EmissionImage::Triangle> triangles_of(const TriangleMesh& mesh, const TriangleEmitter& emitter) {
  std::vector<EmissionImage::Triangle> out;
  for (size_t i = 0; i < mesh.indices.size(); ++i) {
    const auto& t = emitter.triangles[i];
    const double area = 0.5 * glm::length(glm::cross(glm::dvec3(t.e1), glm::dvec3(t.e2)));
    const auto [i0, i1, i2] = mesh.indices[i];
    out.push_back({area, mesh.uv.empty() ? kUvOfBareTriangle
                                         : std::array<Point2, 3>{mesh.uv[i0], mesh.uv[i1], mesh.uv[i2]}});
  }
  return out;
}

// Sets the image of a light. Returns false if the mesh has triangles without area.
bool set_image(const Shape& shape, std::shared_ptr<const LightImage> image, DiffuseAreaLight& light) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry)) {
    const auto& emitter = std::get<TriangleEmitter>(light.surface);
    if (emitter.triangles.size() != mesh->indices.size()) return false;
    light.image = std::make_shared<const EmissionImage>(std::move(image), triangles_of(*mesh, emitter));
    return true;
  }
  const SweptGeometry swept = *swept_of(shape);
  light.surface = SweptEmitter{swept, shape.flip_normal};
  light.image = std::make_shared<const EmissionImage>(std::move(image), swept, double(light.area));
  return true;
}

}  // namespace

bool keeps_areas_even(const Shape& shape) {
  const auto swept = swept_of(shape);
  return swept && std::visit([](const auto& s) { return s.keeps_areas_even(); }, *swept);
}

std::optional<DiffuseAreaLight> DiffuseAreaLight::make(const Shape& shape, const Rgb& L, bool twosided,
                                                       std::shared_ptr<const LightImage> image) {
  DiffuseAreaLight light;
  light.L = L;
  light.twosided = twosided;
  light.area = static_cast<float>(surface_area(shape));
  if (!(light.area > 0) || !std::isfinite(light.area)) return std::nullopt;
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry)) {
    light.surface = make_emitter(*mesh, shape.flip_normal);
  } else if (!keeps_areas_even(shape)) {
    return std::nullopt;
  } else if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
    const Transform& t = sphere->to_world;
    light.surface = SphereEmitter{t.translation, glm::length(t.linear[0]), shape.flip_normal};
  } else if (const auto* disk = std::get_if<Disk>(&shape.geometry)) {
    const Normal3 n = disk_normal(disk->to_world);
    light.surface = DiskEmitter{disk->to_world, disk->inner, shape.flip_normal ? -n : n};
  } else {
    light.surface = SweptEmitter{*swept_of(shape), shape.flip_normal};
  }
  if (image && !set_image(shape, std::move(image), light)) return std::nullopt;
  return light;
}

}  // namespace kaustik
