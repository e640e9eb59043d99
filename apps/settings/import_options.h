#pragma once
// What a user may choose about how scene files of other programs are read.

#include <array>
#include <optional>
#include <string_view>

namespace kaustik {

// What the numbers of a file's punctual lights mean. Photometric: candela and lux, as glTF says. Watt: the
// power of point and spot lights, and W/m^2 of directional ones, as older exporters wrote.
enum class LightUnit { kPhotometric, kWatt };
inline constexpr std::array<std::string_view, 2> kLightUnitNames = {"photometric", "watt"};

struct ImportOptions {
  LightUnit light_unit = LightUnit::kPhotometric;
  // The moment at which an animated file is shown; unset = its beginning.
  std::optional<float> seconds;
};

}  // namespace kaustik
