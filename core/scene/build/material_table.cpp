// Makes materials from their directives, and finds them by name.

#include "core/scene/build/material_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/diagnostics/nearest_name.h"
#include "core/scene/build/dispersion.h"
#include "core/spectrum/refractive_index.h"

namespace kaustik {

namespace {

constexpr uint32_t kDeepestMixture = 256;

uint32_t depth_of(const Material& material) {
  return material.mixed() ? material.mixed()->depth : 0;
}

// The mixture of two of the materials, half of each.
MixedMaterial mixture_of(const std::vector<Material>& materials, const uint32_t (&of)[2]) {
  const Material &first = materials[of[0]], &second = materials[of[1]];
  MixedMaterial mixed{of[0], of[1], 0.5f, first.lobes()};
  mixed.lobes.diffuse |= second.lobes().diffuse;
  mixed.lobes.specular |= second.lobes().specular;
  mixed.lobes.glossy &= second.lobes().glossy;
  mixed.depth = 1 + std::max(depth_of(first), depth_of(second));
  mixed.dispersive = first.is_dispersive() || second.is_dispersive();
  mixed.textured = first.has_textured_bsdf() || second.has_textured_bsdf();
  return mixed;
}

TextureValue value_of(const ParameterSpec& spec) {
  return spec.types.front() == ParameterType::kRgb ? TextureValue::kSpectrum : TextureValue::kFloat;
}

}  // namespace

MaterialTable::MaterialTable(const SceneDescription& description, const TextureTable& textures,
                             WarnedOnce& warned, DiagnosticList& diagnostics)
    : textures_(textures) {
  std::map<std::string_view, SourceLocation> first_place;
  for (const MaterialDescription& material : description.materials) {
    const uint32_t index = make(material, warned, diagnostics);
    of_description_.push_back(index);
    if (material.name.empty()) continue;
    const auto [first, is_new] = first_place.emplace(material.name, material.name_location);
    if (!is_new) {
      diagnostics.error(material.name_location, fmt::format("material `{}` is defined twice", material.name),
                        {{first->second, "first defined here"}});
    }
    by_name_.emplace(material.name, index);
  }
}

uint32_t MaterialTable::add(Material made, std::string name) {
  materials_.push_back(std::move(made));
  names_.push_back(std::move(name));
  return static_cast<uint32_t>(materials_.size() - 1);
}

uint32_t MaterialTable::make(const MaterialDescription& material, WarnedOnce& warned,
                             DiagnosticList& diagnostics) {
  const TypeSpec* spec = find_type(category("Material"), material, diagnostics);
  if (!spec || !check_parameters("material", *spec, material, warned, diagnostics)) return default_material();
  const auto row = std::find_if(material_rows().begin(), material_rows().end(),
                                [&](const MaterialRow& r) { return &r.spec == spec; });
  if (spec->name == "mix") return mix(material, *spec, diagnostics);
  if (!row->make) return kInterface;
  return add(make(*row, material, diagnostics), material.name.empty() ? material.type : material.name);
}

// Makes a constant or a textured material. A constant height is no bump map. A texture that cannot be found
// is an error and is left out.
Material MaterialTable::make(const MaterialRow& row, const MaterialDescription& material,
                             DiagnosticList& diagnostics) {
  const auto eta = dispersion_of(ParameterReader(material, row.spec), diagnostics);
  Material made = make_of_one_colour(row, material, eta.get(), diagnostics);
  if (eta && varies(*eta)) made.disperse(eta);
  return made;
}

Material MaterialTable::make_of_one_colour(const MaterialRow& row, const MaterialDescription& material,
                                           const Spectrum* eta, DiagnosticList& diagnostics) {
  TexturedMaterial made;
  made.make = row.make;
  made.inputs = material_inputs(ParameterReader(material, row.spec));
  for (MaterialInput& input : made.inputs) {
    if (eta && input.name == "eta") input.numbers = {eta->at(kHeliumLine)};
    const Parameter* given = material.find(input.name);
    if (!given) continue;
    const bool named = given->type == ParameterType::kTexture;
    const uint32_t texture =
        named ? textures_.find(*given, value_of(*row.spec.find(input.name)), diagnostics) : kNoIndex;
    if (input.name == "displacement") {
      made.displacement = texture;
    } else if (input.name == "normalmap") {
      made.normal_map =
          textures_.load_linear_image(input.text, given->value_location(0), diagnostics).value_or(kNoIndex);
    } else {
      input.texture = texture;
    }
  }
  const bool has_map = made.displacement != kNoIndex || made.normal_map != kNoIndex;
  if (!has_map && !made.makes_bsdf()) return made.make(MaterialInputs(made.inputs));
  return Material(std::move(made), textures_.set());
}

// As in pbrt, a mixture may only name materials defined before it, so no mixture contains itself.
uint32_t MaterialTable::mix(const MaterialDescription& material, const TypeSpec& spec,
                            DiagnosticList& diagnostics) {
  const Parameter* names = material.find("materials");
  if (!names) {
    diagnostics.error(material.type_location,
                      "material \"mix\" needs `materials`, the names of two materials");
    return default_material();
  }
  uint32_t found[2];
  for (size_t i = 0; i < 2; ++i) {
    found[i] = resolve({std::nullopt, names->strings[i], names->value_location(i)}, diagnostics);
  }
  for (size_t i = 0; i < 2; ++i) {
    if (found[i] != kInterface) continue;
    diagnostics.warning(
        names->value_location(i),
        "material \"interface\" is not a surface and cannot be mixed: the other one is taken");
    return found[1 - i];
  }
  MixedMaterial mixed = mixture_of(materials_, found);
  if (mixed.depth > kDeepestMixture) {
    diagnostics.error(material.type_location,
                      fmt::format("this mixture of mixtures is {} deep: at most {} are supported",
                                  mixed.depth, kDeepestMixture));
    return default_material();
  }
  const Parameter* amount = material.find("amount");
  if (amount && amount->type == ParameterType::kTexture) {
    mixed.amount_texture = textures_.find(*amount, TextureValue::kFloat, diagnostics);
  } else {
    mixed.amount = static_cast<float>(ParameterReader(material, spec).number("amount"));
  }
  return add(Material(mixed, materials_[found[0]].typical()),
             material.name.empty() ? material.type : material.name);
}

uint32_t MaterialTable::default_material() {
  if (default_ == kNoIndex) default_ = add(Lambertian{}, "default");
  return default_;
}

uint32_t MaterialTable::resolve(const MaterialReference& reference, DiagnosticList& diagnostics) {
  if (reference.index) return of_description_[*reference.index];
  if (reference.name.empty()) return default_material();
  const auto found = by_name_.find(reference.name);
  if (found != by_name_.end()) return found->second;
  if (reported_.insert(reference.name).second) {
    const auto names = [&] { return keys_of(by_name_); };
    diagnostics.warning(reference.location,
                        fmt::format("no material is named `{}`: diffuse with reflectance 0.5 stands in{}",
                                    reference.name, diagnostics.hint(reference.name, names)));
  }
  return default_material();
}

}  // namespace kaustik
