#pragma once
// Photon maps as the live page draws them.

#include <cstdint>
#include <string>

#include "core/scene/scene.h"
#include "render/maps/photon_maps.h"
#include "render/maps/probe.h"

namespace kaustik::app {

// The photons of all maps, or evenly spread ones of them: at most `most`. Little-endian: u32 count, then for
// each f32 position x, y, z [m], flux r, g, b [W], and u32 kind, the index into photon::kPhotonKindNames.
std::string cloud_bytes(const render::PhotonMaps& maps, uint64_t most);

// The stored cells of all octrees, coarse ones first, at most `most`. u32 count, then for each f32 lower x,
// y, z, upper x, y, z [m], u32 depth, u32 kind.
std::string cell_bytes(const render::PhotonMaps& maps, uint64_t most);

// What an estimate read, as a JSON object.
std::string probe_json(const render::Probe& probe, const Scene& scene);

}  // namespace kaustik::app
