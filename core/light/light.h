#pragma once
// The variant of all light types. To add a light: (1) write a header with the struct, (2) add its name here,
// (3) add its row in core/scene/schema/light_rows.cpp.

#include <variant>
#include <vector>

#include "core/light/area.h"
#include "core/light/distant.h"
#include "core/light/goniometric.h"
#include "core/light/infinite.h"
#include "core/light/point.h"
#include "core/light/portal.h"
#include "core/light/projection.h"
#include "core/light/spot.h"
#include "core/sampling/discrete.h"

namespace kaustik {

using Light = std::variant<PointLight, SpotLight, GoniometricLight, ProjectionLight, DistantLight,
                           InfiniteLight, ImageInfiniteLight, PortalInfiniteLight, DiffuseAreaLight>;

inline Rgb power(const Light& light) {
  return std::visit([](const auto& l) { return l.power(); }, light);
}
// Whether no ray can hit the light.
inline bool is_delta(const Light& light) {
  const auto* area = std::get_if<DiffuseAreaLight>(&light);
  if (area && area->invisible) return true;
  return std::visit([](const auto& l) { return std::decay_t<decltype(l)>::kDelta; }, light);
}
// Lights that are seen by rays leaving the scene.
template <class L>
concept InfinitelyFar = requires(const L& light, const Ray& ray) {
  light.Le(ray);
};
inline bool is_infinite(const Light& light) {
  return std::visit([]<class L>(const L&) { return InfinitelyFar<L>; }, light);
}
// Radiance seen by a ray of unit direction that leaves the scene; zero unless is_infinite().
inline Rgb escaped_radiance(const Light& light, const Ray& ray) {
  return std::visit(
      [&]<class L>(const L& l) {
        if constexpr (InfinitelyFar<L>) return l.Le(ray);
        return Rgb(0);
      },
      light);
}
// Samples the light arriving at x from `light`, before visibility. Most lights need only the position of the
// receiver.
inline std::optional<LightSample> sample_Li(const Light& light, const LightReceiver& x, const Point2& u) {
  return std::visit(
      [&](const auto& l) {
        if constexpr (requires { l.sample_Li(x, u); })
          return l.sample_Li(x, u);
        else
          return l.sample_Li(x.p, u);
      },
      light);
}
// Density of sample_Li at x for a direction in which the ray leaves the scene; zero unless is_infinite().
inline float escaped_pdf(const Light& light, const LightReceiver& x, const Vector3& wi) {
  return std::visit(
      [&]<class L>(const L& l) {
        if constexpr (requires { l.pdf_Li(x, wi); })
          return l.pdf_Li(x, wi);
        else if constexpr (InfinitelyFar<L>)
          return l.pdf_Li(x.p, wi);
        else
          return 0.0f;
      },
      light);
}
// Probabilities proportional to the luminance of power (uniform if every power is zero).
DiscreteDistribution light_power_distribution(const std::vector<Light>& lights);

}  // namespace kaustik
