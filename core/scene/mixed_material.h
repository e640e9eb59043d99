#pragma once
// One of two materials, chosen anew at each hit.

#include "core/bsdf/bsdf.h"
#include "core/geometry/shape.h"
#include "core/math/vec.h"

namespace kaustik {

// The second with probability `amount`, a number's or a texture's, else the first: samples form the mean of
// both pictures. The choice is a pure function of the point and of wo (as in pbrt-v4), so it does not depend
// on threads; of mantissas and signs alone, so that a scene scaled by a power of two chooses alike.
struct MixedMaterial {
  uint32_t first = 0, second = 0;  // indices of materials
  float amount = 0.5f;             // in [0, 1]
  // Of all that can be chosen. Photons are kept where any of it has a broad part: who looks there chooses for
  // himself.
  Lobes lobes;
  uint32_t amount_texture = kNoIndex;  // float texture that says `amount` instead, clamped to [0, 1]

  // share: the amount at p.
  uint32_t choose(const Point3& p, const Vector3& wo, float share) const;
};

}  // namespace kaustik
