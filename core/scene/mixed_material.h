#pragma once
// A mixture of two materials, one of which is chosen at each hit.

#include "core/bsdf/bsdf.h"
#include "core/math/index.h"
#include "core/math/vec.h"

namespace kaustik {

// Chooses the second material with probability `amount` (a number or a texture) and the first one otherwise,
// so the mean over samples is the mixture of both pictures. The choice is a pure function of the point and wo
// (as in pbrt-v4) and so does not depend on threads. It uses only mantissas and signs, so a scene scaled by a
// power of two makes the same choices.
struct MixedMaterial {
  uint32_t first = 0, second = 0;  // indices of materials
  float amount = 0.5f;             // in [0, 1]
  // The lobes of both materials together. Photons are kept if either has a diffuse part; at a gather
  // point the choice is made anew.
  Lobes lobes;
  uint32_t amount_texture = kNoIndex;  // float texture that replaces `amount`, clamped to [0, 1]
  uint32_t depth = 1;                  // choices at a hit, at most: more than one where mixtures are mixed
  bool dispersive = false;             // one of the materials is
  bool textured = false;               // textures decide the BSDF of one of the materials

  // Returns the index of the material chosen at p; share is the amount there.
  uint32_t choose(const Point3& p, const Vector3& wo, float share) const;
};

}  // namespace kaustik
