// Matrices of RGB colour spaces from their primaries and whites.

#include "core/spectrum/colour_space.h"

#include <algorithm>
#include <array>

#include "core/spectrum/spectrum.h"

namespace kaustik {
namespace {

glm::dvec3 from_chromaticity(double x, double y) {
  return {x / y, 1, (1 - x - y) / y};
}

glm::dvec3 white_of(const Spectrum& illuminant) {
  const glm::dvec3 xyz = tristimulus(illuminant);
  return xyz / xyz.y;
}

// The RGB-to-XYZ matrix of the given primaries (chromaticities), scaled so that they add up to the white.
glm::dmat3 matrix_of(const glm::dvec2& r, const glm::dvec2& g, const glm::dvec2& b, const glm::dvec3& white) {
  // Primaries are scaled to X + Y + Z = 1, as one with y <= 0 cannot be scaled to Y = 1.
  const glm::dmat3 m({r.x, r.y, 1 - r.x - r.y}, {g.x, g.y, 1 - g.x - g.y}, {b.x, b.y, 1 - b.x - b.y});
  const glm::dvec3 scale = glm::inverse(m) * white;
  return {m[0] * scale[0], m[1] * scale[1], m[2] * scale[2]};
}

std::array<ColourSpace, 4> make_spaces() {
  const glm::dvec3 d65 = white_of(daylight(6500));
  const glm::dmat3 rec709 = matrix_of({0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, d65);
  // The white of ACES, which is near D60 (SMPTE ST 2065-1).
  const glm::dvec3 aces = from_chromaticity(0.32168, 0.33767);
  return {ColourSpace{"srgb", rec709},
          ColourSpace{"dci-p3", matrix_of({0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, d65)},
          ColourSpace{"rec2020", matrix_of({0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, d65)},
          ColourSpace{"aces2065-1", matrix_of({0.7347, 0.2653}, {0, 1}, {0.0001, -0.0770}, aces)}};
}

}  // namespace

std::span<const ColourSpace> colour_spaces() {
  static const std::array<ColourSpace, 4> spaces = make_spaces();
  return spaces;
}

const ColourSpace* find_colour_space(std::string_view name) {
  if (name == "rec709") name = "srgb";
  for (const ColourSpace& space : colour_spaces()) {
    if (space.name == name) return &space;
  }
  return nullptr;
}

const glm::dmat3& xyz_to_ours() {
  static const glm::dmat3 m = glm::inverse(colour_spaces().front().to_xyz);
  return m;
}

const glm::dmat3& ours_to_white_xyz() {
  static const glm::dmat3 m = [] {
    const glm::dmat3& to_xyz = colour_spaces().front().to_xyz;
    const glm::dvec3 white = to_xyz * glm::dvec3(1);
    return glm::dmat3(to_xyz[0] / white, to_xyz[1] / white, to_xyz[2] / white);
  }();
  return m;
}

const glm::dmat3& white_xyz_to_ours() {
  static const glm::dmat3 m = glm::inverse(ours_to_white_xyz());
  return m;
}

glm::dmat3 adaptation(const glm::dvec3& from_white, const glm::dvec3& to_white) {
  const glm::dmat3 cones({0.8951, -0.7502, 0.0389}, {0.2664, 1.7135, -0.0685}, {-0.1614, 0.0367, 1.0296});
  const glm::dvec3 gain = (cones * to_white) / (cones * from_white);
  const glm::dmat3 scale({gain.x, 0, 0}, {0, gain.y, 0}, {0, 0, gain.z});
  return glm::inverse(cones) * scale * cones;
}

glm::dmat3 ColourSpace::light_to_ours() const {
  return xyz_to_ours() * to_xyz;
}

glm::dmat3 ColourSpace::surface_to_ours() const {
  const glm::dvec3 ones(1);
  return xyz_to_ours() * adaptation(to_xyz * ones, colour_spaces().front().to_xyz * ones) * to_xyz;
}

}  // namespace kaustik
