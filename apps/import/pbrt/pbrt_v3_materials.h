#pragma once
// Materials of pbrt-v3 (and its disney) as those of pbrt-v4.

#include <string>

#include "core/scene/description/description.h"

namespace kaustik::pbrt {

// Rewrites type and parameters; says what it became and what was lost: `"diffuse"`. Empty, and nothing done,
// for what is no material of v3. GGX widths are kept: v3's and v4's roughness mean different ones, so the
// width itself is given.
std::string upgrade_v3_material(Directive& material);

}  // namespace kaustik::pbrt
