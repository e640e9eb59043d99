// Checks area lights and makes them of placed shapes.

#include "core/scene/build/light_table.h"

#include "core/geometry/tessellate.h"

namespace kaustik {
namespace {

std::shared_ptr<const LightImage> white_pixel() {
  static const auto white = std::make_shared<const LightImage>(LightImage{1, 1, {Rgb(1)}});
  return white;
}

// pbrt hides a light by setting alpha to zero everywhere; it still emits as usual.
bool is_hidden(const Shape& shape) {
  return shape.alpha_texture == kNoIndex && shape.alpha == 0;
}

}  // namespace

bool is_power(const Rgb& power, const SourceLocation& where, DiagnosticList& diagnostics) {
  if (is_finite(power)) return true;
  diagnostics.error(where, "the power of this light is beyond the range of floats");
  return false;
}

LightTable::LightTable(const SceneDescription& description, LightImages& images, const TextureTable& textures,
                       WarnedOnce& warned, DiagnosticList& diagnostics)
    : description_(description), textures_(textures), diagnostics_(diagnostics) {
  for (const Directive& light : description.area_lights) area_lights_.push_back(check(light, images, warned));
}

LightTable::AreaLight LightTable::check(const Directive& directive, LightImages& images, WarnedOnce& warned) {
  const TypeSpec* spec = find_type(category("AreaLightSource"), directive, diagnostics_);
  if (!spec || !check_parameters("area light", *spec, directive, warned, diagnostics_)) return {};
  const ParameterReader parameters(directive, *spec);
  if (!parameters.has("filename")) return {spec, nullptr};
  return {spec, images.get(parameters, "filename")};
}

// Applies `power` and `scale`. As in pbrt, power is relative to the luminance of a white light's emission;
// for an image that is the mean of its pixels, whether or not the surface shows them all.
bool LightTable::scale(const ParameterReader& parameters, DiffuseAreaLight& light) const {
  if (parameters.has("power")) {
    const Rgb white = light.image ? light.image->mean_of_pixels() : Rgb(1);
    const float emitted = luminance(light.flux_of(light.area, white));
    if (!(emitted > 0) || is_black(light.L)) {
      diagnostics_.error(parameters.location("power"), "`power` is given for a light that emits nothing");
      return false;
    }
    light.L *= static_cast<float>(parameters.number("power")) / emitted;
  }
  light.L *= static_cast<float>(parameters.number("scale"));
  return true;
}

bool LightTable::make(const ShapeDescription& description, Shape& shape, std::vector<Light>& lights) const {
  const Directive& directive = description_.area_lights[*description.area_light];
  const auto& [spec, image] = area_lights_[*description.area_light];
  const ParameterReader parameters(directive, *spec);
  const bool partly = shape.has_alpha() && !is_hidden(shape);
  const auto from_shape = [&] {
    return DiffuseAreaLight::make(shape, parameters.rgb("L"), parameters.flag("twosided"),
                                  partly && !image ? white_pixel() : image);
  };
  auto light = from_shape();
  if (!light && swept_of(shape) && !keeps_areas_even(shape)) {
    diagnostics_.warning(description.location,
                         "a light on a sphere or cylinder that is scaled non-uniformly shines as triangles",
                         {{directive.location, "the area light"}});
    shape.geometry = tessellated(shape);
    light = from_shape();
  }
  if (!light) {
    diagnostics_.error(description.location, "the area of this light is zero or not finite",
                       {{directive.location, "the area light"}});
    return false;
  }
  if (!scale(parameters, *light) || !is_power(light->power(), directive.location, diagnostics_)) return false;
  light->invisible = is_hidden(shape);
  if (partly) {
    light->alpha = std::make_shared<const EmitterAlpha>(
        EmitterAlpha{shape.alpha, shape.alpha_texture, textures_.shared_set()});
  }
  shape.light = static_cast<uint32_t>(lights.size());
  lights.push_back(std::move(*light));
  return true;
}

}  // namespace kaustik
