#pragma once
// Draws photons as points, seen by the scene's camera: where light arrived, and by which kind of path.

#include <span>

#include "accel/bvh.h"
#include "photon/record/ply_export.h"
#include "render/picture/image.h"

namespace kaustik::render {

// Draws the scene in dim grey and on it every photon that the camera sees unobstructed, in the colours of
// write_photons_ply(). A pixel takes the mean colour of its photons and is brighter the more there are (1 -
// exp(-s n) for n photons, where s decreases with the mean number per lit pixel, so that dense maps keep
// their structure). Returns linear display values in [0, 1] for write_image() with the default tone settings.
// All surfaces hide what is behind them, including glass. The picture does not depend on the number of
// threads.
Image draw_photons(const accel::Bvh& bvh, std::span<const photon::PlyPhotons> photons);

}  // namespace kaustik::render
