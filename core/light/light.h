#pragma once
// The list of all lights. To add one: (1) write a header with the struct (core/light/interface/light_types.h
// says what it must have), (2) add its name here, (3) add its row to core/scene/schema/light_rows.cpp. The
// tests then ask for example values of it in tests/core/light/light_cases.cpp.

#include <variant>
#include <vector>

#include "core/light/area/area.h"
#include "core/light/goniometric.h"
#include "core/light/point.h"
#include "core/light/projection.h"
#include "core/light/sky/distant.h"
#include "core/light/sky/infinite.h"
#include "core/light/sky/portal.h"
#include "core/light/spot.h"
#include "core/sampling/discrete.h"

namespace kaustik {

// Does not compile when a type lacks a member that LightType requires.
template <LightType... L>
using VariantOfLights = std::variant<L...>;

using Light = VariantOfLights<PointLight, SpotLight, GoniometricLight, ProjectionLight, DistantLight,
                              InfiniteLight, ImageInfiniteLight, PortalInfiniteLight, DiffuseAreaLight>;

inline std::string_view name_of(const Light& light) {
  return std::visit([]<class L>(const L&) -> std::string_view { return L::kName; }, light);
}
inline Rgb power(const Light& light) {
  return std::visit([](const auto& l) { return l.power(); }, light);
}
// Whether no ray can hit the light.
inline bool is_delta(const Light& light) {
  return std::visit([](const auto& l) { return l.is_delta(); }, light);
}
// Nothing for lights without a place.
inline std::optional<LightBounds> bounds_of(const Light& light) {
  return std::visit([](const auto& l) { return l.bounds(); }, light);
}
inline double brightness(const Light& light, double scene_size) {
  return std::visit([&](const auto& l) { return l.brightness(scene_size); }, light);
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
      [&]<class L>(const L& l) {
        if constexpr (SamplesReceivers<L>)
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
