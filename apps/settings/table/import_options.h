#pragma once
// What a user may choose about how scene files of other programs are read.

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "core/memory/memory_room.h"

namespace kaustik {

// Of an animated file: glTF has seconds, and most of its files come from films.
inline constexpr float kFramesPerSecond = 24;

// What the numbers of a file's punctual lights mean. Photometric: candela and lux, as glTF says. Watt: the
// power of point and spot lights, and W/m^2 of directional ones, as older exporters wrote.
enum class LightUnit { kPhotometric, kWatt };
inline constexpr std::array<std::string_view, 2> kLightUnitNames = {"photometric", "watt"};

// Whether a model gets a floor. Auto: if it has neither camera nor light.
enum class Floor { kAuto, kOn, kOff };
inline constexpr std::array<std::string_view, 3> kFloorNames = {"auto", "on", "off"};

// From where a scene is seen, and by which light, where the user does not leave it to the file.
struct ViewOptions {
  std::string camera{};                            // name or number from 1 on; empty: the file's first
  std::optional<std::array<double, 9>> look_at{};  // eye, target, up, in the units of the file
  std::optional<double> fov{};                     // degrees, of the shorter side
  std::string sky{};  // a colour (app::parse_colour), "off", or an image file; empty: the file's
  Floor floor = Floor::kAuto;
  // Width / height of the picture, for a camera that is fitted to a model. Not a setting of its own.
  double aspect = 16.0 / 9;
};

struct ImportOptions {
  LightUnit light_unit = LightUnit::kPhotometric;
  // The moment at which an animated file is shown; unset = its beginning.
  std::optional<float> seconds{};
  ViewOptions view{};
  // The folder in which all files that are read must lie; empty: any folder. Set by --root alone, which is no
  // setting: no file can name it, and none stores it.
  std::string root{};
  // Set by the command, not the user. False: images of textures are checked by their headers only and are
  // grey in the scene, for commands that render nothing.
  bool texture_pixels = true;
  MemoryRoom room{};  // for files and textures, likewise
};

// Why a file outside the root cannot be read or written.
inline std::string lies_outside(const std::string& root) {
  return "it lies outside --root " + root;
}

}  // namespace kaustik
