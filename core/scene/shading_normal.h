#pragma once
#include "core/geometry/surface_parameters.h"
#include "core/scene/material.h"

namespace kaustik {

// The shading normal of a surface with a bump map, or else a normal map, as pbrt-v4 defines them (pharr 2023,
// section 10.5.3, equations 10.7 and 10.8), in the hemisphere of si.n. Where pbrt takes the tangents of
// meshes with vertex normals at right angles, these are the projections of dpdu and dpdv; and where pbrt
// takes a normal map's y along ns x u, here it is on that side of u where v is, whether or not uv is
// mirrored. si.ns where the map says nothing (NaN, or no normal).
Normal3 shading_normal(const TextureSet& textures, const TexturedMaterial& material, const TexturePoint& x,
                       const SurfaceParameters& surface, const SurfaceInteraction& si);

}  // namespace kaustik
