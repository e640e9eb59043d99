#pragma once
// The dispersion of a dielectric, from the parameters of its directive.

#include <memory>

#include "core/scene/schema/schema.h"
#include "core/spectrum/spectrum.h"

namespace kaustik {

// Whether a parameter of this name tells how the index of refraction depends on the wavelength.
bool tells_dispersion(std::string_view parameter);
// The index of refraction by wavelength; null if the directive tells none, or if its parameters contradict
// each other, with an error added.
std::shared_ptr<const Spectrum> dispersion_of(const ParameterReader& parameters, DiagnosticList& diagnostics);

}  // namespace kaustik
