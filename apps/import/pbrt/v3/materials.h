#pragma once
// Converts pbrt-v3's materials (including disney) to pbrt-v4's.

#include <string>

#include "apps/import/pbrt/v3/extras.h"

namespace kaustik::pbrt {

// Rewrites type and parameters, and describes the result for a warning, such as `"diffuse"`. Empty, with
// nothing changed, if it is not a v3 material. v3 and v4 map roughness to different GGX widths, so the result
// holds the width itself, with "remaproughness" false. What does not fit into one material goes to `extras`.
std::string upgrade_v3_material(Directive& material, V3Extras* extras);

}  // namespace kaustik::pbrt
