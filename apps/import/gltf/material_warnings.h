#pragma once
#include "apps/import/common/warnings.h"
#include "apps/import/gltf/file/json_view.h"

namespace kaustik::gltf {

// Counts a warning for each part of a material that is left out or approximated, whatever its values.
void warn_of_extensions(const View& material, FileWarnings& warnings);

// Checks the extensions that a file requires. Those that only materials, textures or descriptions need give a
// warning if they are not rendered; without others geometry would be missing, which throws FormatError.
void check_required_extensions(const View& root, FileWarnings& warnings);

}  // namespace kaustik::gltf
