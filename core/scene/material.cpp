#include "core/scene/material.h"

namespace kaustik {

void BsdfAt::make(const std::vector<Material>& materials, const SurfaceInteraction& si, const Vector3& wo) {
  const Material* material = &materials[si.material];
  // Mixtures hold materials defined before them only: this ends.
  while (const MixedMaterial* mixed = material->mixed()) material = &materials[mixed->choose(si.p, wo)];
  bsdf_ = &material->typical();
  if (material->constant()) return;
  const TexturedMaterial& textured = *material->textured();
  made_ = textured.make(MaterialInputs(textured.inputs));
  bsdf_ = &*made_;
}

}  // namespace kaustik
