#pragma once
// The list of all lights. Adding one: (1) a header with the struct, (2) its name here, (3) its row in
// core/scene/light_rows.cpp.

#include <variant>
#include <vector>

#include "core/light/area.h"
#include "core/light/distant.h"
#include "core/light/infinite.h"
#include "core/light/point.h"
#include "core/light/spot.h"
#include "core/sampling/discrete.h"

namespace kaustik {

using Light = std::variant<PointLight, SpotLight, DistantLight, InfiniteLight, DiffuseAreaLight>;

inline Rgb power(const Light& light) {
  return std::visit([](const auto& l) { return l.power(); }, light);
}
inline bool is_delta(const Light& light) {
  return std::visit([](const auto& l) { return std::decay_t<decltype(l)>::kDelta; }, light);
}
// Probabilities in proportion to luminance of power (uniform when every power is zero).
DiscreteDistribution light_power_distribution(const std::vector<Light>& lights);

}  // namespace kaustik
