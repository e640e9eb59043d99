#include "apps/import/obj/obj_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/import/common/derived_image.h"
#include "apps/import/common/make_parameter.h"

namespace kaustik {
namespace {

// The value of a key; `otherwise` when it is absent or not finite.
double number(const aiMaterial& mtl, const char* key, unsigned type, unsigned index, double otherwise) {
  float value = 0;
  const bool there = mtl.Get(key, type, index, value) == aiReturn_SUCCESS && std::isfinite(value);
  return there ? double(value) : otherwise;
}

glm::dvec3 colour(const aiMaterial& mtl, const char* key, unsigned type, unsigned index,
                  const glm::dvec3& otherwise) {
  aiColor3D c;
  if (mtl.Get(key, type, index, c) != aiReturn_SUCCESS) return otherwise;
  const glm::dvec3 out(double(c.r), double(c.g), double(c.b));
  return std::isfinite(out.x + out.y + out.z) ? glm::max(out, 0.0) : otherwise;
}

std::optional<std::string> map_of(const aiMaterial& mtl, aiTextureType type) {
  aiString name;
  if (mtl.GetTexture(type, 0, &name) != aiReturn_SUCCESS || name.length == 0) return std::nullopt;
  std::string file = name.C_Str();
  std::replace(file.begin(), file.end(), '\\', '/');
  return file;
}

std::string add_texture(const aiMaterial& mtl, const std::string& file, const std::string& keyword,
                        const MtlContext& context) {
  SceneDescription& scene = context.scene;
  const SourceLocation& where = context.warnings.where();
  const std::string value_type = keyword == "map_d" ? "float" : "spectrum";
  DirectiveMaker<TextureDescription> texture("imagemap", where);
  aiString name;
  mtl.Get(AI_MATKEY_NAME, name);
  if (const auto found = context.options.find({name.C_Str(), keyword}); found != context.options.end()) {
    const MapOptions& o = found->second;
    if (o.clamp) texture.text("wrap", "clamp");
    texture.number("uscale", o.scale[0]).number("vscale", o.scale[1]);
    texture.number("udelta", o.offset[0]).number("vdelta", o.offset[1]);
  }
  texture->name = fmt::format("texture {}", scene.textures.size());
  texture->name_location = texture->value_type_location = where;
  texture->value_type = value_type;
  texture.text("filename", file);
  if (value_type == "float") texture.text("encoding", "linear");
  scene.textures.push_back(std::move(*texture));
  return scene.textures.back().name;
}

using Maker = DirectiveMaker<MaterialDescription>;

void add_reflectance(const aiMaterial& mtl, const MtlContext& context, Maker& m) {
  const auto file = map_of(mtl, aiTextureType_DIFFUSE);
  if (!file) {
    const glm::dvec3 kd = colour(mtl, AI_MATKEY_COLOR_DIFFUSE, glm::dvec3(0.5));
    m.rgb("reflectance", glm::min(kd, 1.0));
    return;
  }
  m.add(make_parameter(ParameterType::kTexture, "reflectance", add_texture(mtl, *file, "map_kd", context),
                       context.warnings.where()));
}

// Some programs write normal maps as `map_Bump`; their mean colour is blue.
void add_normals(const aiMaterial& mtl, const MtlContext& context, Maker& m) {
  auto file = map_of(mtl, aiTextureType_NORMALS);
  if (const auto bump = map_of(mtl, aiTextureType_HEIGHT); bump && !file) {
    std::string error;
    const auto mean = gltf::mean_colour(context.folder / *bump, false, error);
    if (mean && mean->z > 0.75 && mean->x < 0.65 && mean->y < 0.65)
      file = bump;
    else
      context.warnings.say("`map_Bump` is ignored unless it is a normal map");
  }
  if (file) m.text("normalmap", *file);
}

// The GGX width alpha that matches a Blinn-Phong lobe of this exponent (Walter et al. 2007, section 5.2).
double width_of(double exponent) {
  return std::sqrt(2 / (std::max(exponent, 0.0) + 2));
}

Maker clear(const aiMaterial& mtl, const SourceLocation& where) {
  Maker m("dielectric", where);
  const double ior = number(mtl, AI_MATKEY_REFRACTI, 1.5);
  m.number("eta", ior > 0 ? ior : 1.5);
  return m;
}

// A metal's reflectance is Ks if that is not black, else Kd: many files set Kd of metals to black.
Maker metal(const aiMaterial& mtl, const SourceLocation& where, double width) {
  Maker m("conductor", where);
  const glm::dvec3 ks = colour(mtl, AI_MATKEY_COLOR_SPECULAR, glm::dvec3(0));
  m.rgb("reflectance",
        glm::min(ks == glm::dvec3(0) ? colour(mtl, AI_MATKEY_COLOR_DIFFUSE, glm::dvec3(1)) : ks, 1.0));
  m.number("roughness", width).flag("remaproughness", false);
  return m;
}

int illum_of(const aiMaterial& mtl) {
  int illum = 2;
  mtl.Get(AI_MATKEY_SHADING_MODEL,
          illum);  // assimp's enumerator; overwritten by the file's number if there is one
  mtl.Get("$mat.illum", 0, 0, illum);
  return illum;
}

bool is_clear(const aiMaterial& mtl, int illum) {
  const bool faint = number(mtl, AI_MATKEY_OPACITY, 1) < 0.5 && !map_of(mtl, aiTextureType_OPACITY);
  return illum == 4 || illum == 6 || illum == 7 || faint;
}

}  // namespace

MaterialDescription material_of_mtl(const aiMaterial& mtl, const MtlContext& context) {
  const SourceLocation& where = context.warnings.where();
  const int illum = illum_of(mtl);
  const double exponent = number(mtl, AI_MATKEY_SHININESS, 0);
  const double metallic = number(mtl, AI_MATKEY_METALLIC_FACTOR, 0);
  const double roughness = number(mtl, AI_MATKEY_ROUGHNESS_FACTOR, -1);
  const double width = roughness >= 0 ? roughness * roughness : width_of(exponent);
  const glm::dvec3 ks = colour(mtl, AI_MATKEY_COLOR_SPECULAR, glm::dvec3(0));
  if (is_clear(mtl, illum)) return std::move(*clear(mtl, where));
  if (illum == 3 || illum == 5 || metallic > 0.5)
    return std::move(*metal(mtl, where, illum == 3 && roughness < 0 && exponent <= 0 ? 0 : width));
  const bool coated = ks != glm::dvec3(0) || roughness >= 0;
  Maker m(coated ? "coateddiffuse" : "diffuse", where);
  add_reflectance(mtl, context, m);
  if (coated) m.number("roughness", width).flag("remaproughness", false);
  add_normals(mtl, context, m);
  return std::move(*m);
}

std::optional<Directive> light_of_mtl(const aiMaterial& mtl, const SourceLocation& where) {
  const glm::dvec3 ke = colour(mtl, AI_MATKEY_COLOR_EMISSIVE, glm::dvec3(0));
  const auto image = map_of(mtl, aiTextureType_EMISSIVE);
  if (ke == glm::dvec3(0) && !image) return std::nullopt;
  DirectiveMaker<Directive> light("diffuse", where);
  if (!image) return *light.rgb("L", ke);
  const double brightest = std::max(ke.x, std::max(ke.y, ke.z));
  return *light.text("filename", *image).number("scale", brightest > 0 ? brightest : 1);
}

std::optional<Parameter> alpha_of_mtl(const aiMaterial& mtl, const MtlContext& context) {
  const SourceLocation& where = context.warnings.where();
  if (const auto file = map_of(mtl, aiTextureType_OPACITY))
    return make_parameter(ParameterType::kTexture, "alpha", add_texture(mtl, *file, "map_d", context), where);
  const double opacity = number(mtl, AI_MATKEY_OPACITY, 1);
  if (!(opacity < 1) || is_clear(mtl, illum_of(mtl))) return std::nullopt;
  return make_parameter(ParameterType::kFloat, "alpha", std::vector<double>{opacity}, where);
}

}  // namespace kaustik
