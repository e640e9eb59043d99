#pragma once
// What the rows of materials have in common: entries of the schema, and how facets and metals are made.

#include <string>

#include "core/bsdf/conductor.h"
#include "core/scene/material_inputs.h"
#include "core/scene/schema/parameter_spec.h"

namespace kaustik::spec {

// What pbrt gives to every material, and textures for all that is a number or a colour.
std::vector<ParameterSpec> material(std::vector<ParameterSpec> own);
// With pbrt's ways to say how rough a surface is.
std::vector<ParameterSpec> rough_material(std::vector<ParameterSpec> own);
// pbrt's parameters of a coat with a medium in it, which is not there.
std::vector<ParameterSpec> medium_of_coat();
ParameterSpec metal_index(std::string_view name, std::string_view doc);

// By `roughness`, `uroughness`, `vroughness` and `remaproughness`. prefix: before the first three.
Ggx facets_of(const MaterialInputs& p, std::string_view prefix = "");
// By `reflectance`, or by `eta` and `k`, whose defaults are copper's. prefix: before the last two.
Conductor metal_of(const MaterialInputs& p, std::string_view prefix = "");

// Materials of pbrt that are taken for others (approximated_materials.cpp).
std::vector<MaterialRow> approximated_material_rows();

}  // namespace kaustik::spec
