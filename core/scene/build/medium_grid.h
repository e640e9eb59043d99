#pragma once
// The densities of a "uniformgrid" medium.

#include "core/medium/density_grid.h"
#include "core/scene/schema/schema.h"

namespace kaustik {

// Whether the parameters describe a grid; reports what is wrong.
bool check_grid(const ParameterReader& parameters, const MediumDescription& medium,
                DiagnosticList& diagnostics);

// The grid, of parameters that check_grid accepted, relative to the scene's origin.
DensityGrid make_grid(const MediumDescription& medium, const glm::dvec3& origin);

}  // namespace kaustik
