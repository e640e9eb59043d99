#include "apps/import/gltf/materials.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/import/common/make_parameter.h"
#include "apps/import/gltf/material_warnings.h"

namespace kaustik::gltf {
namespace {

using Maker = DirectiveMaker<MaterialDescription>;

constexpr const char* kClearcoat = "KHR_materials_clearcoat";
constexpr const char* kGlossiness = "KHR_materials_pbrSpecularGlossiness";
constexpr const char* kSheet = "KHR_materials_diffuse_transmission";

glm::dvec3 colour(const std::vector<double>& v) {
  return {v[0], v[1], v[2]};
}

View metallic_roughness(const View& material) {
  return material["pbrMetallicRoughness"];
}
View extension(const View& material, const char* name) {
  return material["extensions"][name];
}

// Without KHR_materials_volume of some thickness, a transmissive surface is a thin pane.
bool is_pane(const View& material) {
  return !(extension(material, "KHR_materials_volume")["thicknessFactor"].number(0) > 0);
}

// The index of refraction; 0 stands for an infinite one.
double index_of(const View& material) {
  const double ior = extension(material, "KHR_materials_ior")["ior"].number(1.5);
  return ior == 0 ? 4.0 : std::clamp(ior, 1.01, 4.0);
}

}  // namespace

const Look& Materials::look(std::optional<uint64_t> index, const VertexTint& tint) {
  const std::pair key{index, tint.key()};
  const auto found = looks_.find(key);
  if (found != looks_.end()) return found->second;
  const View material = index ? document_.item("materials", *index) : View();
  std::string name = index ? std::string(material["name"].text("material")) : "default";
  if (tint.key() != VertexTint{}.key()) name += " tinted";
  tint_ = tint;
  return looks_.emplace(key, make(material, name)).first->second;
}

Look Materials::make(const View& material, const std::string& name) {
  warn_of_extensions(material, warnings_);
  Look look;
  look.uv = uv_of(material);
  textures_.set_uv_of_mesh(look.uv.transform);
  look.by_vertex = tint_.each;
  const bool is_unlit = extension(material, "KHR_materials_unlit").exists();
  look.material = {std::nullopt, is_unlit ? unlit(material, name, look) : surface(material, name),
                   warnings_.where()};
  look.alpha = alpha_of(material);
  if (!is_unlit) look.inside = inside_of(material, look.material.name);
  const View strength = extension(material, "KHR_materials_emissive_strength")["emissiveStrength"];
  if (!is_unlit)
    add_light(material, material["emissiveTexture"],
              strength.number(1) * colour(material["emissiveFactor"].numbers(3, {0, 0, 0})), look);
  return look;
}

// The set of texture coordinates of the material's first texture, which all of them have to share,
// transformed as the normal map has it: normal maps are read at the mesh's coordinates.
UvSource Materials::uv_of(const View& material) {
  std::optional<uint64_t> set;
  const View pbr = metallic_roughness(material);
  for (const View& info : {base_of(material).texture, pbr["metallicRoughnessTexture"],
                           material["normalTexture"], material["emissiveTexture"]}) {
    if (!info) continue;
    const uint64_t own = uv_set_of(info);
    if (own != set.value_or(own))
      warnings_.count("textures with texture coordinates of their own use those of the base colour",
                      "texture");
    if (!set) set = own;
  }
  const glm::dmat3 transform = uv_transform_of(material["normalTexture"]);
  const bool usable = glm::determinant(transform) != 0;
  return {set.value_or(0), usable ? transform : glm::dmat3(1)};
}

// KHR_materials_unlit: the picture shows the base colour whatever the light, so the surface is black and
// emits it. Colours that vary from vertex to vertex cannot be emitted: those are lit.
std::string Materials::unlit(const View& material, const std::string& name, Look& look) {
  Maker m("diffuse", warnings_.where());
  const Base base = base_of(material);
  if (tint_.each) {
    warnings_.count("KHR_materials_unlit with colours of vertices is rendered as a diffuse surface",
                    "material");
    add_base("reflectance", base, 1, *m);
  } else {
    m.rgb("reflectance", glm::dvec3(0));
    add_light(material, base.texture, base.colour(), look);
  }
  return add(std::move(*m), name, View());
}

// The whole surface: a mix of its opaque and its transmissive part. Returns the material's name.
std::string Materials::surface(const View& material, const std::string& name) {
  const View transmission = extension(material, "KHR_materials_transmission");
  const double factor = std::clamp(transmission["transmissionFactor"].number(0), 0.0, 1.0);
  const Share share = share_of(factor, transmission["transmissionTexture"], 0);
  if (share.is(0)) return opaque(material, name);
  if (share.is(1)) return clear_part(material, name);
  const std::string solid = opaque(material, name + " opaque");
  const std::string clear = clear_part(material, name + " clear");
  return mixed(name, solid, clear, share);
}

Materials::Base Materials::base_of(const View& material) const {
  const View glossiness = extension(material, kGlossiness), pbr = metallic_roughness(material);
  Base base = glossiness
                  ? Base{glossiness["diffuseTexture"], glossiness["diffuseFactor"].numbers(4, {1, 1, 1, 1})}
                  : Base{pbr["baseColorTexture"], pbr["baseColorFactor"].numbers(4, {1, 1, 1, 1})};
  for (size_t k = 0; k < 4; ++k)
    base.factor[k] = std::clamp(base.factor[k] * tint_.factor[static_cast<int>(k)], 0.0, 1.0);
  return base;
}

std::string Materials::opaque(const View& material, const std::string& name) {
  if (extension(material, kGlossiness)) return glossy(material, name);
  if (extension(material, kSheet)["diffuseTransmissionFactor"].number(0) > 0) return sheet(material, name);
  const View pbr = metallic_roughness(material);
  const double metallic = std::clamp(pbr["metallicFactor"].number(1), 0.0, 1.0);
  const Share share = share_of(metallic, pbr["metallicRoughnessTexture"], 2);
  if (share.is(0)) return dielectric_part(material, name, specular_index(material));
  if (share.is(1)) return metal_part(material, name);
  const std::string dielectric = dielectric_part(material, name + " dielectric", specular_index(material));
  const std::string metal = metal_part(material, name + " metal");
  return mixed(name, dielectric, metal, share);
}

// Textures that are 0 or 1 everywhere are common and need no mixture; their mean shows it.
Materials::Share Materials::share_of(double factor, const View& texture, int channel) {
  const auto mean = factor > 0 ? textures_.mean_of_channel(texture, channel) : std::nullopt;
  if (!mean) return {texture ? 0 : factor, std::nullopt};  // unreadable ones are mostly 0
  const double share = factor * std::clamp(*mean, 0.0, 1.0);
  if (share == 0 || share == 1) return {share, std::nullopt};
  return {share, textures_.channel(texture, channel, [factor](double v) { return factor * v; })};
}

// Adds a pbrt "mix"; its `amount` is the share of the second material.
std::string Materials::mixed(const std::string& name, const std::string& first, const std::string& second,
                             const Share& share) {
  Maker m("mix", warnings_.where());
  Parameter parts = make_parameter(ParameterType::kString, "materials", first, warnings_.where());
  parts.strings.push_back(second);
  m.add(std::move(parts));
  if (share.texture)
    m.add(textures_.parameter("amount", *share.texture));
  else
    m.number("amount", share.constant);
  return add(std::move(*m), name, View());
}

// KHR_materials_pbrSpecularGlossiness, by diffuse and specular colours. A mean specular colour above that of
// any glass means metal.
std::string Materials::glossy(const View& material, const std::string& name) {
  constexpr double kMostOfGlass = 0.35;
  const View glossiness = extension(material, kGlossiness);
  const glm::dvec3 F0 =
      glm::clamp(colour(glossiness["specularFactor"].numbers(3, {1, 1, 1})) *
                     textures_.mean(glossiness["specularGlossinessTexture"]).value_or(glm::dvec3(1)),
                 0.0, 1.0);
  const double most = std::max(F0.x, std::max(F0.y, F0.z)), root = std::sqrt(most);
  if (most <= kMostOfGlass)
    return dielectric_part(material, name, std::clamp((1 + root) / (1 - root), 1.01, 4.0));
  Maker m("conductor", warnings_.where());
  m.rgb("reflectance", F0);
  add_roughness(material, false, *m);
  return add(std::move(*m), name, material);
}

// KHR_materials_diffuse_transmission: a thin sheet that transmits diffusely.
std::string Materials::sheet(const View& material, const std::string& name) {
  const View transmission = extension(material, kSheet);
  const double through = std::clamp(transmission["diffuseTransmissionFactor"].number(0), 0.0, 1.0);
  if (transmission.has("diffuseTransmissionTexture"))
    warnings_.say("KHR_materials_diffuse_transmission is rendered without diffuseTransmissionTexture");
  const Base base = base_of(material);
  Maker m("diffusetransmission", warnings_.where());
  add_base("reflectance", base, 1 - through, *m);
  add_colour(
      "transmittance", transmission["diffuseTransmissionColorTexture"],
      through *
          glm::clamp(colour(transmission["diffuseTransmissionColorFactor"].numbers(3, {1, 1, 1})), 0.0, 1.0),
      *m);
  return add(std::move(*m), name, material);
}

// The index of refraction whose reflection at normal incidence is that of KHR_materials_ior, times the factor
// and the mean colour of KHR_materials_specular.
double Materials::specular_index(const View& material) {
  const double eta = index_of(material);
  const View specular = extension(material, "KHR_materials_specular");
  if (!specular) return eta;
  const glm::dvec3 tint = glm::max(colour(specular["specularColorFactor"].numbers(3, {1, 1, 1})), 0.0) *
                          textures_.mean(specular["specularColorTexture"]).value_or(glm::dvec3(1));
  const double factor = std::clamp(specular["specularFactor"].number(1), 0.0, 1.0) *
                        textures_.mean_of_channel(specular["specularTexture"], 3).value_or(1);
  if (tint.x != tint.y || tint.y != tint.z)
    warnings_.count("the colour of KHR_materials_specular is replaced by its mean", "material");
  const double ior = extension(material, "KHR_materials_ior")["ior"].number(1.5);
  const double F0 = std::pow((ior - 1) / (ior + 1), 2);  // 1 for the infinite one, whose tint is all of it
  const double root = std::sqrt(std::min(factor * F0 * (tint.x + tint.y + tint.z) / 3, 0.36));
  return (1 + root) / (1 - root);
}

// A diffuse base under a dielectric coat. With KHR_materials_clearcoat the clear coat replaces the base's own
// reflection.
std::string Materials::dielectric_part(const View& material, const std::string& name, double eta) {
  const bool coat = extension(material, kClearcoat)["clearcoatFactor"].number(0) >= 0.5;
  const bool dull = !coat && eta == 1;
  Maker m(dull ? "diffuse" : "coateddiffuse", warnings_.where());
  const Base base = base_of(material);
  add_base("reflectance", base, 1, *m);
  if (!dull) {
    m.number("eta", coat ? 1.5 : std::clamp(eta, 1.01, 4.0));
    add_roughness(material, coat, *m);
  }
  return add(std::move(*m), name, material);
}

std::string Materials::metal_part(const View& material, const std::string& name) {
  Maker m("conductor", warnings_.where());
  const Base base = base_of(material);
  add_base("reflectance", base, 1, *m);
  add_roughness(material, false, *m);
  return add(std::move(*m), name, material);
}

// The transmissive part.
std::string Materials::clear_part(const View& material, const std::string& name) {
  const bool pane = is_pane(material);
  Maker m(pane ? "thindielectric" : "dielectric", warnings_.where());
  m.number("eta", index_of(material));
  add_transmittance(material, pane, *m);
  if (!pane) add_roughness(material, false, *m);
  // The extension counts 20 over the Abbe number; that of real materials is above 10.
  const double dispersion = extension(material, "KHR_materials_dispersion")["dispersion"].number(0);
  if (!pane && dispersion > 0) m.number("abbe", std::max(20 / dispersion, 1.0));
  return add(std::move(*m), name, material);
}

// The medium inside a transmissive body, by KHR_materials_volume: attenuationColor is what it leaves of light
// along attenuationDistance, which is in world space.
MediumReference Materials::inside_of(const View& material, const std::string& name) {
  const View volume = extension(material, "KHR_materials_volume");
  const double distance = volume["attenuationDistance"].number(0);
  const bool opaque =
      !(extension(material, "KHR_materials_transmission")["transmissionFactor"].number(0) > 0);
  if (opaque || is_pane(material) || !(distance > 0)) return {};
  constexpr double kDarkest = 1e-6;  // of a colour without a component: so that the coefficient is finite
  const glm::dvec3 left = glm::clamp(colour(volume["attenuationColor"].numbers(3, {1, 1, 1})), kDarkest, 1.0);
  if (left == glm::dvec3(1)) return {};
  DirectiveMaker<MediumDescription> medium("homogeneous", warnings_.where());
  medium.rgb("sigma_a", -glm::log(left) / distance).rgb("sigma_s", glm::dvec3(0));
  medium->name = name;  // materials have names of their own
  medium->name_location = warnings_.where();
  scene_.media.push_back(std::move(*medium));
  return {name, warnings_.where()};
}

// The base colour tints the light that passes a pane. Light passes the surface of a body twice, so that each
// time it is tinted by the root of the base colour.
void Materials::add_transmittance(const View& material, bool pane, MaterialDescription& m) {
  Base base = base_of(material);
  const glm::dvec3 tint = pane ? base.colour() : glm::sqrt(base.colour());
  if (tint == glm::dvec3(1) && !base.texture && !tint_.each) return;
  for (size_t k = 0; k < 3; ++k) base.factor[k] = tint[static_cast<int>(k)];
  add_base("transmittance", base, 1, m, pane ? 1 : 0.5);
}

// A texture that cannot be read is grey.
void Materials::add_colour(const std::string& parameter, const View& texture, const glm::dvec3& factor,
                           MaterialDescription& m, double exponent) {
  const auto named = textures_.colour(texture, factor, exponent);
  const glm::dvec3 c = texture ? 0.5 * factor : factor;
  m.parameters.push_back(named ? textures_.parameter(parameter, *named)
                               : make_parameter(ParameterType::kRgb, parameter,
                                                std::vector<double>{c.x, c.y, c.z}, warnings_.where()));
}

void Materials::add_base(const std::string& parameter, const Base& base, double share, MaterialDescription& m,
                         double exponent) {
  const glm::dvec3 factor = share * base.colour();
  if (!tint_.each) return add_colour(parameter, base.texture, factor, m, exponent);
  const auto named = textures_.colour(base.texture, factor, exponent);
  m.parameters.push_back(textures_.parameter(parameter, textures_.by_vertex(named, factor)));
}

// glTF's roughness is the square root of the GGX width; pbrt takes the width itself when "remaproughness" is
// false.
Materials::Width Materials::width_of(const View& material, bool coat) {
  const auto squared = [](double x) { return x * x; };
  if (const View glossiness = extension(material, kGlossiness); glossiness && !coat) {
    const double factor = std::clamp(glossiness["glossinessFactor"].number(1), 0.0, 1.0);
    return {glossiness["specularGlossinessTexture"], 3, [=](double v) { return squared(1 - factor * v); }};
  }
  const View of = coat ? extension(material, kClearcoat) : metallic_roughness(material);
  const double factor =
      std::clamp(coat ? of["clearcoatRoughnessFactor"].number(0) : of["roughnessFactor"].number(1), 0.0, 1.0);
  return {of[coat ? "clearcoatRoughnessTexture" : "metallicRoughnessTexture"], 1,
          [=](double v) { return squared(factor * v); }};
}

void Materials::add_width(const std::string& parameter, const Width& width, MaterialDescription& m) {
  const auto texture = textures_.channel(width.texture, width.channel, width.width);
  m.parameters.push_back(texture ? textures_.parameter(parameter, *texture)
                                 : make_parameter(ParameterType::kFloat, parameter,
                                                  std::vector<double>{width.width(width.texture ? 0.5 : 1)},
                                                  warnings_.where()));
}

// With KHR_materials_anisotropy the lobe is wider along the tangent, which is the direction of u here.
void Materials::add_roughness(const View& material, bool coat, MaterialDescription& m) {
  const Width width = width_of(material, coat);
  const View anisotropy = coat ? View() : extension(material, "KHR_materials_anisotropy");
  const double strength = std::clamp(anisotropy["anisotropyStrength"].number(0), -1.0, 1.0);
  if (strength == 0) {
    add_width("roughness", width, m);
  } else {
    const double rotation = anisotropy["anisotropyRotation"].number(0);
    if (std::abs(std::sin(2 * rotation)) > 0.01 || anisotropy.has("anisotropyTexture"))
      warnings_.say(
          "KHR_materials_anisotropy is rendered along u or v, whichever is nearer, and without textures");
    Width wide = width;
    wide.width = [width, strength](double v) {
      return width.width(v) + (1 - width.width(v)) * strength * strength;
    };
    const bool along_u = std::abs(std::cos(rotation)) >= std::abs(std::sin(rotation));
    add_width("uroughness", along_u ? wide : width, m);
    add_width("vroughness", along_u ? width : wide, m);
  }
  m.parameters.push_back(
      make_parameter(ParameterType::kBool, "remaproughness", std::vector<double>{0}, warnings_.where()));
}

std::string Materials::add(MaterialDescription m, const std::string& name, const View& material) {
  m.name = names_.take(name);
  m.name_location = warnings_.where();
  if (const View normal = material["normalTexture"]) {
    if (normal["scale"].number(1) != 1) warnings_.say("the `scale` of normal maps is ignored");
    if (const auto file = textures_.file(normal))
      m.parameters.push_back(textures_.file_parameter("normalmap", *file));
  }
  scene_.materials.push_back(std::move(m));
  return scene_.materials.back().name;
}

std::optional<Parameter> Materials::alpha_of(const View& material) {
  const std::string mode = material["alphaMode"].text("OPAQUE");
  if (mode == "OPAQUE") return std::nullopt;
  const Base base = base_of(material);
  const double factor = base.factor[3];
  const double cutoff = mode == "MASK" ? material["alphaCutoff"].number(0.5) : -1;
  const auto covered = [=](double v) { return cutoff < 0 ? factor * v : factor * v >= cutoff ? 1.0 : 0.0; };
  const auto texture = textures_.channel(base.texture, 3, covered);
  if (tint_.each) {
    if (cutoff >= 0)
      warnings_.count("masks by the alpha of vertices are rendered as partly transparent", "material");
    return textures_.parameter("alpha", textures_.by_vertex_alpha(texture, covered(1)));
  }
  if (texture) return textures_.parameter("alpha", *texture);
  if (covered(1) == 1) return std::nullopt;
  return make_parameter(ParameterType::kFloat, "alpha", std::vector<double>{covered(1)}, warnings_.where());
}

void Materials::add_light(const View& material, const View& texture, const glm::dvec3& radiance, Look& look) {
  const glm::dvec3 L = glm::max(radiance, 0.0);
  if (L == glm::dvec3(0)) return;
  DirectiveMaker<Directive> light("diffuse", warnings_.where());
  look.emits_image = add_emitted_image(texture, L, look.uv, *light);
  if (!look.emits_image) {
    // An emission texture that cannot be read is taken for black, which most of them mostly are.
    const glm::dvec3 mean = texture ? textures_.mean(texture).value_or(glm::dvec3(0)) : glm::dvec3(1);
    if (L * mean == glm::dvec3(0)) return;
    light.rgb("L", L * mean);
  }
  if (material["doubleSided"].flag(false)) light.flag("twosided", true);
  scene_.area_lights.push_back(std::move(*light));
  look.area_light = static_cast<uint32_t>(scene_.area_lights.size() - 1);
}

// Adds the emission texture to `light`; false if there is none that can be shown. pbrt's area lights show
// their image once, by the shape's own uv.
bool Materials::add_emitted_image(const View& texture, const glm::dvec3& L, const UvSource& uv,
                                  Directive& light) {
  if (!texture || textures_.mean(texture).value_or(glm::dvec3(0)) == glm::dvec3(0)) return false;
  if (uv_transform_of(texture) != uv.transform || uv_set_of(texture) != uv.set) {
    warnings_.say(
        "emission textures with a transform or with texture coordinates of their own are rendered as their "
        "mean");
    return false;
  }
  const double brightest = std::max(L.x, std::max(L.y, L.z));
  const auto file = textures_.tinted_file(texture, L / brightest);
  if (!file) return false;
  light.parameters.push_back(Textures::file_parameter("filename", *file));
  light.parameters.push_back(
      make_parameter(ParameterType::kFloat, "scale", std::vector<double>{brightest}, warnings_.where()));
  return true;
}

}  // namespace kaustik::gltf
