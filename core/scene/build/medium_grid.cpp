#include "core/scene/build/medium_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "core/math/transform.h"

namespace kaustik {

namespace {

glm::ivec3 points_of(const ParameterReader& p) {
  return {int(p.number("nx")), int(p.number("ny")), int(p.number("nz"))};
}

// As in pbrt-v4, the two corners may be any that are opposite.
glm::dmat4 box_to_medium(const ParameterReader& p) {
  const glm::dvec3 a = p.vec3("p0"), b = p.vec3("p1");
  return glm::scale(glm::translate(glm::dmat4(1), glm::min(a, b)), glm::abs(b - a));
}

}  // namespace

bool check_grid(const ParameterReader& p, const MediumDescription& medium, const Rgb& sigma_t,
                DiagnosticList& diagnostics) {
  const glm::dvec3 points(points_of(p));
  const double cells = points.x * points.y * points.z;
  const size_t count = p.numbers("density").size();
  if (!p.has("density")) {
    diagnostics.error(medium.type_location, "medium \"uniformgrid\" needs `density`");
    return false;
  }
  if (double(count) != cells) {
    diagnostics.error(
        p.location("density"),
        fmt::format("`density` has {} values, but `nx`, `ny` and `nz` make {:.0f} points", count, cells));
    return false;
  }
  const glm::dmat4 box_to_world = medium.medium_to_world * box_to_medium(p);
  if (!is_usable_transform(box_to_world) || !DensityGrid::can_place(points_of(p), box_to_world)) {
    diagnostics.error(p.location("p1"),
                      "the box of this grid, from `p0` to `p1`, is flat or too small, or its "
                      "transform cannot be inverted");
    return false;
  }
  const std::vector<double>& densities = p.numbers("density");
  const double largest = *std::max_element(densities.begin(), densities.end());
  if (!is_finite(Rgb(glm::dvec3(sigma_t) * largest))) {
    diagnostics.error(p.location("density"), "`density` takes coefficients beyond the range of floats");
    return false;
  }
  return true;
}

DensityGrid make_grid(const MediumDescription& medium, const glm::dvec3& origin) {
  const auto& types = medium_types();
  const auto type =
      std::find_if(types.begin(), types.end(), [&](const TypeSpec& t) { return t.name == medium.type; });
  const ParameterReader p(medium, *type);
  return {points_of(p), p.numbers("density"), relative_to(origin, medium.medium_to_world) * box_to_medium(p)};
}

}  // namespace kaustik
