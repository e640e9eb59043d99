#pragma once
// What the schema rows of materials share: parameter entries, and functions that make facets and metals.

#include <string>

#include "core/bsdf/conductor.h"
#include "core/scene/material_inputs.h"
#include "core/scene/schema/parameter_spec.h"

namespace kaustik::spec {

// Adds the parameters that pbrt gives to every material, and makes all numbers and colours accept textures.
std::vector<ParameterSpec> material(std::vector<ParameterSpec> own);
// Adds pbrt's roughness parameters as well.
std::vector<ParameterSpec> rough_material(std::vector<ParameterSpec> own);
// pbrt's parameters of a medium inside a coat, which is not modelled.
std::vector<ParameterSpec> medium_of_coat();
ParameterSpec metal_index(std::string_view name, std::string_view doc);

// Reads `roughness`, `uroughness`, `vroughness` and `remaproughness`. prefix: prepended to the first three
// names.
Ggx facets_of(const MaterialInputs& p, std::string_view prefix = "");
// Reads `reflectance`, or `eta` and `k`, whose defaults are copper's. prefix: prepended to the last two
// names.
Conductor metal_of(const MaterialInputs& p, std::string_view prefix = "");

// Materials of pbrt that are approximated by others (approximated_materials.cpp).
std::vector<MaterialRow> approximated_material_rows();

}  // namespace kaustik::spec
