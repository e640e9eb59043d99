#pragma once
// The response of the camera's sensor.

#include "core/math/vec.h"

namespace kaustik {

// The sensor's response to radiance as one matrix on linear Rec. 709: exposure and white balance. It is
// applied to whole samples; lights, photons and their powers are not affected.
struct Sensor {
  glm::mat3 response{1};
  bool neutral = true;  // response is the identity

  Rgb operator()(const Rgb& radiance) const { return neutral ? radiance : response * radiance; }
};

}  // namespace kaustik
