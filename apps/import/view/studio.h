#pragma once
// The surroundings of a model that comes without camera and light: a camera that it fills, a lit room like a
// photographer's, and a floor that takes its shadow and its caustics. Worlds are right-handed with +y up.

#include <optional>
#include <string>

#include "apps/import/view/model_box.h"
#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"

namespace kaustik {

inline constexpr double kStudioFov = 30;  // degrees, of the shorter side

// The radiance that the background of the studio has, and the floor where nothing shades it, so that no edge
// of the floor shows. White surfaces that face the light are brighter, black ones darker.
inline constexpr double kStudioBackground = 0.38;

// The camera-to-world transform of a camera at `eye` that looks along `ahead` (unit). For right-handed
// worlds: seen along -z, +x points right. (pbrt's LookAt assumes a left-handed world.)
glm::dmat4 camera_looking_along(const glm::dvec3& eye, const glm::dvec3& ahead, const glm::dvec3& up);

// `box` below is that of the scene (box_of).

// Adds a perspective camera that sees all points of the scene in a picture of this aspect ratio (width /
// height), from the right of +z and above.
void add_studio_camera(SceneDescription& scene, const ModelBox& box, double aspect,
                       const SourceLocation& where);

// Radiance of the studio from a direction (unit) in its own frame: +y up, the camera towards +z.
double studio_radiance(const glm::dvec3& w);

// Adds the light of the studio as an image in a temporary folder, which the description keeps. Returns an
// error message if the image cannot be written.
std::optional<std::string> add_studio_light(SceneDescription& scene, const ModelBox& box, SourceFiles& files,
                                            const SourceLocation& where);

// Adds a wide diffuse disk just below the model.
void add_studio_floor(SceneDescription& scene, const ModelBox& box, const SourceLocation& where);

}  // namespace kaustik
