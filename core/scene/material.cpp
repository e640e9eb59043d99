#include "core/scene/material.h"

namespace kaustik {

void BsdfAt::make(const TexturedMaterial& material, const SurfaceInteraction& /*si*/) {
  made_ = material.make(MaterialInputs(material.inputs));
  bsdf_ = &*made_;
}

}  // namespace kaustik
