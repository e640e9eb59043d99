#pragma once
#include "core/math/vec.h"

namespace kaustik {

// What the film makes of radiance, as one matrix on linear Rec. 709: exposure and white balance. It applies
// to whole samples; light, photons and their powers know nothing of it.
struct Sensor {
  glm::mat3 response{1};
  bool neutral = true;  // response is the identity

  Rgb operator()(const Rgb& radiance) const { return neutral ? radiance : response * radiance; }
};

}  // namespace kaustik
