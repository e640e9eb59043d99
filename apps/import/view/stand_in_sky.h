#pragma once
// Decides whether a scene of another format (glTF, OBJ) needs a stand-in for the light that it lacks.

#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"

namespace kaustik {

// How strongly the emitters of a scene light its surfaces: the mean irradiance that they give the surfaces,
// as a share of pi, the irradiance of a white sky of radiance 1 on an open plane.
//
// The mean is taken over area and over faces, and the larger one counts: a wide ground must not hide that the
// detailed model on it is lit, nor a detailed model that the room around it is. It is estimated by a fixed
// set of points, without a look at what lies between two points, so that a glowing part that faces away from
// everything else counts for little. Surfaces that emit at least as much as they would reflect of a white sky
// need no other light and are left out. An emission image counts with its mean; one that cannot be read
// counts as black.
//
// Infinite when the scene has a punctual or infinite light, when all its surfaces are left out, and when
// shapes other than triangle meshes emit. 0 when no shape emits. `files` has the names of the files that the
// description's locations refer to.
double emitted_share(const SceneDescription& scene, const SourceFiles& files);

// Emitters of a smaller share do not replace the stand-in sky. The light of a Cornell box, of radiance 17 and
// 0.7 % of the surfaces, has about 0.1.
inline constexpr double kLeastEmittedShare = 0.01;

}  // namespace kaustik
