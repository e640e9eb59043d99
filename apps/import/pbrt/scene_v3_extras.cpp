// Materials of pbrt-v3 that become several materials of ours, or a material and the alpha of its shapes.

#include <algorithm>
#include <numeric>

#include "apps/import/pbrt/scene_parser.h"

namespace kaustik::pbrt {
namespace {

// The mean of a colour, or of a spectrum of pairs; nothing for a name.
std::optional<double> mean_of(const Parameter& p) {
  const size_t step = p.type == ParameterType::kSpectrum ? 2 : 1;
  double sum = 0, count = 0;
  for (size_t i = step - 1; i < p.numbers.size(); i += step) sum += p.numbers[i], ++count;
  return count > 0 ? std::optional(std::clamp(sum / count, 0.0, 1.0)) : std::nullopt;
}

}  // namespace

void SceneParser::add_material(MaterialDescription material) {
  V3Extras extras = v3_.take_extras();
  for (MaterialDescription& part : extras.parts) {
    resolve_names("Material", part);
    repairs_.repair("Material", part);
    colours_.reduce("Material", *state_.colour_space, part);
    scene_.materials.push_back(std::move(part));
  }
  colours_.reduce("Material", *state_.colour_space, material);
  if (extras.opacity) add_opacity(material, std::move(*extras.opacity));
  scene_.materials.push_back(std::move(material));
}

// `material` is the next one of the scene.
void SceneParser::add_opacity(const MaterialDescription& material, Parameter opacity) {
  if (opacity.type == ParameterType::kTexture && opacity.strings.size() == 1) {
    const auto later = state_.spectrum_textures.find(opacity.strings[0]);
    if (later != state_.spectrum_textures.end()) opacity.strings[0] = later->second;
  }
  const auto alpha = alpha_of(opacity);
  if (!alpha) return;
  if (!material.name.empty()) seen_through_[material.name] = scene_.materials.size();
  alpha_of_material_[scene_.materials.size()] = *alpha;
}

// Nothing for an opacity of one, and, with a warning, for what cannot be an alpha.
std::optional<Parameter> SceneParser::alpha_of(const Parameter& opacity) {
  Parameter alpha = opacity;
  alpha.name = "alpha";
  alpha.inherited = true;
  if (opacity.type != ParameterType::kTexture) {
    const auto mean = mean_of(opacity);
    if (!mean || *mean == 1) return std::nullopt;
    alpha.type = ParameterType::kFloat;
    alpha.strings.clear();
    alpha.numbers = {*mean};
    return alpha;
  }
  const auto texture = std::find_if(scene_.textures.rbegin(), scene_.textures.rend(), [&](const auto& t) {
    return t.value_type == "spectrum" && !opacity.strings.empty() && t.name == opacity.strings[0];
  });
  if (texture == scene_.textures.rend()) return alpha;  // a float texture, or reported later
  if (texture->type != "imagemap") {
    diagnostics_.warning(opacity.location, "`opacity` is ignored: only images and numbers can be an `alpha`");
    return std::nullopt;
  }
  // The same image as a texture of numbers.
  alpha.strings[0] = texture->name + " as opacity";
  if (float_textures_.insert(alpha.strings[0]).second) {
    TextureDescription numbers = *texture;
    numbers.name = alpha.strings[0];
    numbers.value_type = "float";
    scene_.textures.push_back(std::move(numbers));
  }
  return alpha;
}

// A shape's own alpha comes first. Emission does not depend on the material, so lights keep theirs.
void SceneParser::apply_opacity(ShapeDescription& shape) const {
  if (alpha_of_material_.empty() || shape.area_light || shape.find("alpha")) return;
  std::optional<size_t> material = shape.material.index;
  if (const auto named = seen_through_.find(shape.material.name); !material && named != seen_through_.end())
    material = named->second;
  if (!material) return;
  if (const auto alpha = alpha_of_material_.find(*material); alpha != alpha_of_material_.end())
    shape.parameters.push_back(alpha->second);
}

}  // namespace kaustik::pbrt
