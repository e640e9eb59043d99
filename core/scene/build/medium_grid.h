#pragma once
// The densities of a "uniformgrid" medium.

#include "core/medium/density_grid.h"
#include "core/scene/schema/schema.h"

namespace kaustik {

// Whether the parameters describe a grid; reports what is wrong. sigma_t: the extinction coefficient where
// the density is one, 1/m.
bool check_grid(const ParameterReader& parameters, const MediumDescription& medium, const Rgb& sigma_t,
                DiagnosticList& diagnostics);

// The grid, of parameters that check_grid accepted, relative to the scene's origin.
DensityGrid make_grid(const MediumDescription& medium, const glm::dvec3& origin);

}  // namespace kaustik
