#pragma once
// pbrt's transforms as matrices for column vectors (pharr 2023, chapter 3.9).

#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace kaustik::pbrt {

// World to camera, left-handed: +z ahead, +y up, +x right. values: eye, point looked at, up. Nothing when
// they leave the frame undefined.
std::optional<glm::dmat4> look_at(const std::vector<double>& values);
// values: angle in degrees, axis. Nothing for an axis of length zero.
std::optional<glm::dmat4> rotate(const std::vector<double>& values);
glm::dmat4 translate(const std::vector<double>& values);
glm::dmat4 scale(const std::vector<double>& values);
// Sixteen numbers, column by column, as in the file.
glm::dmat4 matrix(const std::vector<double>& values);

// Of an affine map an affine one, to the bit: glm's last row can be off by a rounding.
glm::dmat4 inverse_transform(const glm::dmat4& m);

}  // namespace kaustik::pbrt
