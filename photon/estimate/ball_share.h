#pragma once
// The share of a gather disc that lies on a ball, in closed form.
//
// The part of a sphere within a distance d of one of its points has the area pi d^2 of a flat disc
// (Archimedes). So nothing of the disc is missing up to the distance at which normals cease to count
// (kNormalCosine), and everything beyond.

#include "core/geometry/interaction.h"
#include "photon/gather/kernel.h"

namespace kaustik::photon {

class WallCut;

// The share of the kernel's mass on the ball on which si lies. ball_radius: metres, negative where the
// normals point to the centre. radius: of the disc, metres. cut: walls that hide parts of the ball from si;
// may be null.
double share_on_ball(const SurfaceInteraction& si, float ball_radius, const KernelSpec& kernel, float radius,
                     const WallCut* cut);

}  // namespace kaustik::photon
