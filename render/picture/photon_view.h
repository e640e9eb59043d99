#pragma once
// Photons as points in a picture, seen by the scene's camera: where light arrived and how it came there.

#include <span>

#include "accel/bvh.h"
#include "photon/record/ply_export.h"
#include "render/picture/image.h"

namespace kaustik::render {

// The scene in dim grey, and on it every photon that the camera sees unobstructed, in the colours of
// write_photons_ply: a pixel takes the mean colour of its photons, brighter the more there are (1 - exp(-s n)
// for n photons, s falling with the mean number per lit pixel, so that dense maps keep their structure).
// Linear display values in [0, 1] for write_image with the default tone settings. Surfaces hide what is
// behind them, glass too. The picture does not depend on the number of threads.
Image draw_photons(const accel::Bvh& bvh, std::span<const photon::PlyPhotons> photons);

}  // namespace kaustik::render
