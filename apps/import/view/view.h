#pragma once
// How a scene is looked at and lit where the file leaves it open or the command line decides it.

#include "apps/import/view/model_box.h"
#include "apps/settings/table/import_options.h"
#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"

namespace kaustik {

// What a format says of its worlds.
enum class Convention {
  kPbrt,        // left-handed; a scene without camera or light is meant so
  kRightHanded  // +y up; a model without camera or light gets a stand-in for what it lacks (studio.h)
};

// Applies --look-at and --fov alone.
void apply_camera(SceneDescription& scene, const ViewOptions& options, Convention convention,
                  Diagnostics& diagnostics);

// Applies --look-at, --fov, --sky and --floor. Then, for right-handed formats, each with a warning: a model
// that has neither a camera nor light that reaches its surfaces is shown in a studio, and one that lacks only
// one of them gets a camera that it fills, or a white sky. Reports an error for an option that the scene has
// no use for.
void apply_view(SceneDescription& scene, const ViewOptions& options, Convention convention,
                Diagnostics& diagnostics);

}  // namespace kaustik
