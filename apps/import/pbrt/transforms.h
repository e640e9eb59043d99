#pragma once
// pbrt's transforms as matrices for column vectors (Pharr 2023, section 3.9).

#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace kaustik::pbrt {

// World to camera, left-handed: +z ahead, +y up, +x right. `values`: eye, look-at point, up vector. Nothing
// when they do not define a frame.
std::optional<glm::dmat4> look_at(const std::vector<double>& values);
// `values`: angle in degrees, axis. Nothing for an axis of length zero.
std::optional<glm::dmat4> rotate(const std::vector<double>& values);
glm::dmat4 translate(const std::vector<double>& values);
glm::dmat4 scale(const std::vector<double>& values);
// `values`: sixteen numbers in column-major order, as in the file.
glm::dmat4 matrix(const std::vector<double>& values);

// The inverse. For an affine map the last row is exactly (0, 0, 0, 1): glm::inverse may round it.
glm::dmat4 inverse_transform(const glm::dmat4& m);

}  // namespace kaustik::pbrt
