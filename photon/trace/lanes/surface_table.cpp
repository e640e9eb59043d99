// Fills the rows of the surface table from shapes and materials.

#include "photon/trace/lanes/surface_table.h"

namespace kaustik::photon {

namespace {

constexpr std::array<uint32_t, 3> kNoIndices{};
constexpr Point3 kNoPoint{0};
constexpr uint64_t kManyTriangles = 1u << 13;

void set_geometry(SurfaceRow& row, const Shape& shape) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry)) {
    row.indices = mesh->indices.data();
    row.P = mesh->P.data();
    row.primitives = ~0u;
    if (!mesh->N.empty()) row.traits |= kScalarTrait;
  } else {
    row.traits |= std::holds_alternative<Sphere>(shape.geometry) ? kSphereTrait : kScalarTrait;
  }
}

void set_bsdf(SurfaceRow& row, const Lambertian& bsdf) {
  row.reflectance = bsdf.reflectance;
}
void set_bsdf(SurfaceRow& row, const OrenNayar& bsdf) {
  row.reflectance = bsdf.reflectance;
  row.parameter[0] = bsdf.A;
  row.parameter[1] = bsdf.B;
  row.traits |= kRoughTrait;
}
void set_bsdf(SurfaceRow& row, const Mirror& bsdf) {
  row.reflectance = bsdf.reflectance;
  row.traits |= kSpecularTrait;
}
void set_bsdf(SurfaceRow& row, const Dielectric& bsdf) {
  if (!bsdf.facets.smooth() || bsdf.tints.tinted()) row.traits |= kScalarTrait;
  row.parameter[0] = bsdf.eta;
  row.traits |= kSpecularTrait | kDielectricTrait;
}

SurfaceRow make_row(const Shape& shape, const std::vector<Material>& materials) {
  SurfaceRow row{&kNoIndices, &kNoPoint};
  row.traits = 0;
  row.flip = shape.flip_normal ? -1.0f : 1.0f;
  row.surface_group = shape.surface_group;
  set_geometry(row, shape);
  const Material& material = materials[shape.material];
  // What only reflects leaves photons in their medium.
  if (shape.media.is_transition() && std::holds_alternative<Dielectric>(material.typical()))
    row.traits |= kScalarTrait;
  std::visit(
      [&](const auto& bsdf) {
        if constexpr (requires { set_bsdf(row, bsdf); }) {
          if (material.constant()) return set_bsdf(row, bsdf);
        }
        row.traits |= kScalarTrait;
      },
      material.typical());
  return row;
}

}  // namespace

SurfaceTable::SurfaceTable(const std::vector<Shape>& shapes, const std::vector<Material>& materials)
    : shapes_(&shapes) {
  rows_.reserve(shapes.size() + 1);
  uint64_t triangles = 0;
  for (const Shape& shape : shapes) {
    rows_.push_back(make_row(shape, materials));
    triangles += primitive_count(shape);
  }
  rows_.push_back({&kNoIndices, &kNoPoint});
  many_triangles_ = triangles > kManyTriangles;
}

}  // namespace kaustik::photon
