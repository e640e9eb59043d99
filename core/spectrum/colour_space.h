#pragma once
// RGB colour spaces: those that pbrt's ColorSpace knows, and the way from them to ours, linear Rec. 709.

#include <span>
#include <string_view>

#include "core/math/vec.h"

namespace kaustik {

struct ColourSpace {
  std::string_view name;
  glm::dmat3 to_xyz;  // columns: its primaries; (1, 1, 1) is its white, of Y = 1

  bool is_ours() const { return name == "srgb"; }
  // A light stays what it is: white of another space is not our white.
  glm::dmat3 light_to_ours() const;
  // A surface that is white under the space's own illuminant is white under ours (Bradford's adaptation).
  glm::dmat3 surface_to_ours() const;
};

// srgb (rec709 is another name for it), dci-p3, rec2020, aces2065-1.
std::span<const ColourSpace> colour_spaces();
// Null when nobody knows the name.
const ColourSpace* find_colour_space(std::string_view name);

// From XYZ to linear Rec. 709 whose white is the D65 of the tables, so that D65 is (1, 1, 1).
const glm::dmat3& xyz_to_ours();
// Maps XYZ seen under one white to what looks the same under another (Bradford; Lam 1985). Whites: XYZ of
// Y = 1.
glm::dmat3 adaptation(const glm::dvec3& from_white, const glm::dvec3& to_white);

}  // namespace kaustik
