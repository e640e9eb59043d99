#pragma once
// The RGB colour spaces that pbrt's ColorSpace knows, and conversions from them to the renderer's own, linear
// Rec. 709.

#include <span>
#include <string_view>

#include "core/math/vec.h"

namespace kaustik {

struct ColourSpace {
  std::string_view name;
  glm::dmat3 to_xyz;  // columns: the primaries; (1, 1, 1) maps to the white, with Y = 1

  bool is_ours() const { return name == "srgb"; }
  // Conversion of emitted colours, without adaptation: the white of another space is not our white.
  glm::dmat3 light_to_ours() const;
  // Conversion of reflectances: a surface that is white under the space's own illuminant is white under ours
  // (Bradford's adaptation).
  glm::dmat3 surface_to_ours() const;
};

// srgb (also called rec709), dci-p3, rec2020 and aces2065-1.
std::span<const ColourSpace> colour_spaces();
// Null when the name is unknown.
const ColourSpace* find_colour_space(std::string_view name);

// From XYZ to linear Rec. 709 with the white of the tabulated D65, so that D65 is (1, 1, 1).
const glm::dmat3& xyz_to_ours();
// The same from XYZ in which D65 is (1, 1, 1), and back.
const glm::dmat3& white_xyz_to_ours();
const glm::dmat3& ours_to_white_xyz();
// Maps XYZ under one white to XYZ of the same appearance under another (Bradford; Lam 1985). Both whites are
// XYZ with Y = 1.
glm::dmat3 adaptation(const glm::dvec3& from_white, const glm::dvec3& to_white);

}  // namespace kaustik
