#pragma once
// Exports photons as coloured points, for MeshLab, Blender and CloudCompare.

#include <filesystem>
#include <span>

#include "photon/record/photon_record.h"

namespace kaustik::photon {

struct PlyPhotons {
  PhotonKind kind;
  const PhotonBuffer* buffer;
};

// Writes a binary little-endian PLY point cloud: x y z (world space; float, or double if the scene has a
// local origin, where floats would be too coarse), nx ny nz (float), red green blue (uchar: the flux relative
// to the kind's mean, tone mapped; shadow photons in kShadowColour), kind (uchar: the PhotonKind). The file
// is written under a temporary name beside `path` and renamed, so readers never see an incomplete file.
// Throws std::runtime_error with the path and the system's reason if it cannot be written. origin:
// Scene::origin.
void write_photons_ply(const std::filesystem::path& path, std::span<const PlyPhotons> photons,
                       const glm::dvec3& origin);

// Colour of a photon as written, also used to draw photons. mean_flux: luminance, in watts.
glm::u8vec3 photon_colour(PhotonKind kind, const Rgb& flux, float mean_flux);
inline constexpr glm::u8vec3 kShadowColour{64, 64, 255};

}  // namespace kaustik::photon
