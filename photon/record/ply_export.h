#pragma once
// Photons as coloured points, for MeshLab, Blender and CloudCompare.

#include <filesystem>
#include <span>

#include "photon/record/photon_record.h"

namespace kaustik::photon {

struct PlyPhotons {
  PhotonKind kind;
  const PhotonBuffer* buffer;
};

// Writes a binary little-endian PLY point cloud: x y z (world space; float, or double where the scene has an
// origin of its own, as floats are too coarse there), nx ny nz (float), red green blue (uchar: the flux
// over the kind's mean, tone-scaled; shadow photons in kShadowColour), kind (uchar: the PhotonKind). Written
// to a temporary name beside `path` and renamed, so a reader never sees half a file. Throws
// std::runtime_error with the path and the system's reason when it cannot be written. origin: Scene::origin.
void write_photons_ply(const std::filesystem::path& path, std::span<const PlyPhotons> photons,
                       const glm::dvec3& origin);

// Colour of one photon as written; for drawing the same points. mean_flux: luminance, watts.
glm::u8vec3 photon_colour(PhotonKind kind, const Rgb& flux, float mean_flux);
inline constexpr glm::u8vec3 kShadowColour{64, 64, 255};

}  // namespace kaustik::photon
