#pragma once
// Draws photons as points, seen by the scene's camera: where light arrived, and by which kind of path.

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "accel/bvh.h"
#include "photon/record/ply_export.h"
#include "render/picture/image.h"
#include "render/picture/legend.h"

namespace kaustik::render {

// kLight: the colours of write_photons_ply(), those of the photons' light, and blue for shadow photons.
// kKind: one colour for each kind.
enum class PhotonColours { kLight, kKind };
inline constexpr std::array<std::string_view, 2> kPhotonColoursNames = {"light", "kind"};

// What the colours of these kinds mean.
std::vector<LegendEntry> legend_of(std::span<const photon::PlyPhotons> photons, PhotonColours colours);

// Draws the scene in dim grey and on it every photon that the camera sees unobstructed, with a legend where
// the picture has room for it. A pixel takes the mean colour of its photons and is brighter the more there
// are (1 - exp(-s n) for n photons, where s decreases with the mean number per lit pixel, so that dense maps
// keep their structure). Returns linear display values in [0, 1] for write_image() with the default tone
// settings. All surfaces hide what is behind them, including glass. The picture does not depend on the number
// of threads.
Image draw_photons(const accel::Bvh& bvh, std::span<const photon::PlyPhotons> photons,
                   PhotonColours colours = PhotonColours::kLight);

}  // namespace kaustik::render
