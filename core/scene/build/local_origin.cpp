// Exact bounds of shapes, and the origin chosen from them.

#include "core/scene/build/local_origin.h"

namespace kaustik {
namespace {

// The smallest power of two that is not less than x > 0.
double power_of_two_above(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(1.0, mantissa > 0.5 ? exponent : exponent - 1);
}

}  // namespace

ExactBounds object_bounds(const ShapeDescription& shape, const ShapeSource& source) {
  ExactBounds box;
  const auto* mesh = std::get_if<TriangleMesh>(&source.geometry);
  if (!mesh) {
    const Bounds3 local = std::visit(
        []<class G>(const G& g) {
          if constexpr (AnalyticShape<G>) return g.local_bounds();
          return Bounds3();
        },
        source.geometry);
    box.add(glm::dvec3(local.min));
    box.add(glm::dvec3(local.max));
    return mapped(source.local, box);
  }
  if (const Parameter* P = shape.find("P")) {
    for (size_t i = 0; i + 2 < P->numbers.size(); i += 3)
      box.add(glm::dvec3(P->numbers[i], P->numbers[i + 1], P->numbers[i + 2]));
  } else {
    for (const Point3& p : mesh->P) box.add(glm::dvec3(p));
  }
  return box;
}

ExactBounds mapped(const glm::dmat4& m, const ExactBounds& box) {
  ExactBounds out;
  if (!(box.min.x <= box.max.x)) return out;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                       corner & 4 ? box.max.z : box.min.z);
    out.add(glm::dvec3(m * glm::dvec4(p, 1)));
  }
  return out;
}

glm::dvec3 local_origin(const ExactBounds& shapes) {
  const glm::dvec3 center = 0.5 * shapes.min + 0.5 * shapes.max;
  const double radius = 0.5 * glm::length(shapes.max - shapes.min);
  const double distance = glm::length(center);
  if (!(radius > 0 && distance > kFarRadii * radius && std::isfinite(distance))) return glm::dvec3(0);
  const double step = power_of_two_above(radius);
  return glm::round(center / step) * step;
}

}  // namespace kaustik
