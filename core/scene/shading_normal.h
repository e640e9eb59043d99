#pragma once
// Shading normals from bump maps and normal maps.

#include "core/geometry/surface_parameters.h"
#include "core/scene/material.h"

namespace kaustik {

// The shading normal of a surface with a bump map, or else a normal map, in the hemisphere of si.n, as
// defined by pbrt-v4 (Pharr 2023, section 10.5.3, equations 10.7 and 10.8) with two differences. On meshes
// with vertex normals, pbrt orthogonalises the tangents; here they are the projections of dpdu and dpdv. pbrt
// takes the y axis of a normal map along ns x u; here it is on the side of u on which v lies, also where uv
// is mirrored. Returns si.ns where the map gives no normal (NaN or zero).
Normal3 shading_normal(const TextureSet& textures, const TexturedMaterial& material, const TexturePoint& x,
                       const SurfaceParameters& surface, const SurfaceInteraction& si);

}  // namespace kaustik
