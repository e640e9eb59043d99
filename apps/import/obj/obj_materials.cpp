#include "apps/import/obj/obj_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/import/common/derived_image.h"
#include "apps/import/common/make_parameter.h"

namespace kaustik::obj {
namespace {

using MaterialMaker = DirectiveMaker<MaterialDescription>;

const glm::dvec3 kBlack(0), kGrey(0.5);

double most_of(const glm::dvec3& c) {
  return std::max(c.x, std::max(c.y, c.z));
}

int illum_of(const MtlMaterial& mtl) {
  return static_cast<int>(std::clamp(mtl.number("illum").value_or(2), 0.0, 100.0));
}

// The GGX width alpha that matches a Blinn-Phong lobe of this exponent (Walter et al. 2007, section 5.2).
double width_of(double exponent) {
  return std::sqrt(2 / (std::max(exponent, 0.0) + 2));
}

// Kd, or `otherwise` if it is not stated. Beside an image Kd is often black or white, which says nothing of
// the colour that the image would have had: grey stands in for an image that is missing.
glm::dvec3 diffuse_colour(const MtlMaterial& mtl, const glm::dvec3& otherwise = kGrey) {
  const MtlMap* const map = mtl.map("map_kd");
  const glm::dvec3 kd = glm::min(mtl.colour("kd").value_or(otherwise), 1.0);
  const bool says_nothing = kd == kBlack || kd == glm::dvec3(1);
  return map && !map->file && says_nothing ? kGrey : kd;
}

const MtlMap* image(const MtlMaterial& mtl, std::string_view keyword) {
  const MtlMap* const map = mtl.map(keyword);
  return map && map->file ? map : nullptr;
}

}  // namespace

MtlLook MtlMaterials::add(const MtlMaterial& mtl) {
  std::string name = add_surface(mtl, mtl.name);
  return {std::move(name), add_light(mtl), alpha_of(mtl)};
}

std::string MtlMaterials::add_surface(const MtlMaterial& mtl, const std::string& name) {
  const int illum = illum_of(mtl);
  const glm::dvec3 kd = diffuse_colour(mtl), ks = glm::min(mtl.colour("ks").value_or(kBlack), 1.0);
  const bool diffuse = image(mtl, "map_kd") || (mtl.colour("kd") && kd != kBlack);
  if (is_clear(mtl)) return add_material(clear(mtl), name, mtl);
  if (is_metal(mtl)) {
    const bool by_ks = !diffuse && ks != kBlack;
    return add_material(metal(mtl, by_ks ? ks : kd, by_ks ? nullptr : image(mtl, "map_kd")), name, mtl);
  }
  if (illum == 3 && diffuse && ks != kBlack) return add_mirror_over_diffuse(mtl, name);
  if ((illum == 3 || illum == 5) && !(illum == 5 && diffuse))
    return add_material(metal(mtl, ks == kBlack ? kd : ks, nullptr), name, mtl);
  return add_material(opaque(mtl), name, mtl);
}

std::string MtlMaterials::add_material(MaterialDescription m, const std::string& name,
                                       const MtlMaterial& mtl) {
  m.name = names_.take(name);
  m.name_location = mtl.where;
  scene_.materials.push_back(std::move(m));
  return scene_.materials.back().name;
}

MaterialDescription MtlMaterials::clear(const MtlMaterial& mtl) {
  MaterialMaker m("dielectric", mtl.where);
  double eta = mtl.number("ni").value_or(1.5);
  if (!(eta > 0) || eta == 1) {
    warnings_.say(mtl.where, fmt::format("glass of `Ni` {} would not be seen: 1.5 is used", eta));
    eta = 1.5;
  }
  m.number("eta", eta);
  // Tf filters what passes the object, and light crosses two surfaces. Black is what programs write that do
  // not use it.
  const glm::dvec3 tf = glm::min(mtl.colour("tf").value_or(kBlack), 1.0);
  if (tf != kBlack && tf != glm::dvec3(1)) m.rgb("transmittance", glm::sqrt(tf));
  if (mtl.number("pr").value_or(0) > 0) add_width(mtl, *m);
  return std::move(*m);
}

MaterialDescription MtlMaterials::metal(const MtlMaterial& mtl, const glm::dvec3& colour, const MtlMap* map) {
  MaterialMaker m("conductor", mtl.where);
  add_colour(mtl, colour, map, *m);
  const bool ideal =
      illum_of(mtl) == 3 && !mtl.number("pr") && !image(mtl, "map_pr") && mtl.number("ns").value_or(0) <= 0;
  if (ideal)
    m.number("roughness", 0).flag("remaproughness", false);
  else
    add_width(mtl, *m);
  add_normals(mtl, *m);
  return std::move(*m);
}

MaterialDescription MtlMaterials::opaque(const MtlMaterial& mtl) {
  const bool coated = mtl.colour("ks").value_or(kBlack) != kBlack || mtl.number("pr") || image(mtl, "map_pr");
  MaterialMaker m(coated ? "coateddiffuse" : "diffuse", mtl.where);
  add_colour(mtl, diffuse_colour(mtl, vertex_colours_ ? glm::dvec3(1) : kGrey), image(mtl, "map_kd"), *m);
  if (coated) add_width(mtl, *m);
  add_normals(mtl, *m);
  return std::move(*m);
}

// Phong's sum of Kd and a mirror of Ks, as a mixture whose parts are scaled so that the sum remains as long
// as it does not exceed one.
std::string MtlMaterials::add_mirror_over_diffuse(const MtlMaterial& mtl, const std::string& name) {
  const glm::dvec3 kd = diffuse_colour(mtl), ks = glm::min(*mtl.colour("ks"), 1.0);
  const MtlMap* const map = image(mtl, "map_kd");
  const double both = most_of(map ? kGrey : kd) + most_of(ks), share = most_of(ks) / both;
  const double scale = 1 / std::max(both, 1.0);
  MaterialMaker diffuse("diffuse", mtl.where), mix("mix", mtl.where);
  add_colour(mtl, scale / (1 - share) * kd, map, *diffuse);
  add_normals(mtl, *diffuse);
  const std::string below = add_material(std::move(*diffuse), name + " diffuse", mtl);
  Parameter parts = make_parameter(ParameterType::kString, "materials", below, mtl.where);
  parts.strings.push_back(add_material(metal(mtl, scale / share * ks, nullptr), name + " mirror", mtl));
  mix.add(std::move(parts)).number("amount", share);
  return add_material(std::move(*mix), name, mtl);
}

void MtlMaterials::add_colour(const MtlMaterial& mtl, const glm::dvec3& colour, const MtlMap* map,
                              MaterialDescription& m) {
  const glm::dvec3 c = glm::min(colour, 1.0);
  Parameter value =
      map ? make_parameter(ParameterType::kTexture, "reflectance", add_texture(*map, "spectrum"), mtl.where)
          : make_parameter(ParameterType::kRgb, "reflectance", std::vector<double>{c.x, c.y, c.z}, mtl.where);
  m.parameters.push_back(vertex_colours_ ? times_vertex_colours(std::move(value)) : std::move(value));
}

// A texture that is the product of a parameter and the colours of vertices, as a parameter of the same name.
Parameter MtlMaterials::times_vertex_colours(Parameter value) {
  const auto add = [&](DirectiveMaker<TextureDescription> texture) {
    texture->name = fmt::format("texture {}", scene_.textures.size());
    texture->name_location = texture->value_type_location = value.location;
    texture->value_type = "spectrum";
    scene_.textures.push_back(std::move(*texture));
    return scene_.textures.back().name;
  };
  const std::string colours = add({"vertexcolor", value.location}), name = value.name;
  value.name = "tex";
  DirectiveMaker<TextureDescription> product("scale", value.location);
  product.add(value).add(make_parameter(ParameterType::kTexture, "scale", colours, value.location));
  return make_parameter(ParameterType::kTexture, name, add(std::move(product)), value.location);
}

// The GGX width: Pr or map_Pr squared, as in glTF, or that of the exponent Ns.
void MtlMaterials::add_width(const MtlMaterial& mtl, MaterialDescription& m) {
  const auto squared = [](double v) { return v * v; };
  const MtlMap* const map = image(mtl, "map_pr");
  const auto pr = mtl.number("pr");
  const auto widths = map ? channel(*map, 0, squared) : std::nullopt;
  if (widths) {
    m.parameters.push_back(
        make_parameter(ParameterType::kTexture, "roughness", add_texture(*widths, "float"), mtl.where));
  } else {
    const double width = pr ? squared(std::clamp(*pr, 0.0, 1.0)) : width_of(mtl.number("ns").value_or(0));
    m.parameters.push_back(
        make_parameter(ParameterType::kFloat, "roughness", std::vector<double>{width}, mtl.where));
  }
  m.parameters.push_back(
      make_parameter(ParameterType::kBool, "remaproughness", std::vector<double>{0}, mtl.where));
}

// Some programs write normal maps as `map_Bump`; their mean colour is blue.
void MtlMaterials::add_normals(const MtlMaterial& mtl, MaterialDescription& m) {
  const MtlMap* map = image(mtl, "norm");
  if (const MtlMap* const bump = image(mtl, "bump"); bump && !map) {
    std::string error;
    const auto mean = gltf::mean_colour(*bump->file, false, error);
    if (mean && mean->z > 0.75 && mean->x < 0.65 && mean->y < 0.65)
      map = bump;
    else
      warnings_.say(bump->where, "`map_Bump` is ignored unless it is a normal map");
  }
  if (map) m.parameters.push_back(file_parameter("normalmap", *map));
}

// A file name relative to the file that names it.
Parameter MtlMaterials::file_parameter(const std::string& name, const MtlMap& map) const {
  const std::filesystem::path folder = std::filesystem::path(files_.name(map.where.file)).parent_path();
  std::filesystem::path file = map.file->path().lexically_relative(folder.empty() ? "." : folder);
  if (file.empty()) file = std::filesystem::absolute(map.file->path());
  return make_parameter(ParameterType::kString, name, file.string(), map.where);
}

std::string MtlMaterials::add_texture(const MtlMap& map, const std::string& value_type) {
  DirectiveMaker<TextureDescription> texture("imagemap", map.where);
  if (map.clamp) texture.text("wrap", "clamp");
  texture.number("uscale", map.scale[0]).number("vscale", map.scale[1]);
  texture.number("udelta", map.offset[0]).number("vdelta", map.offset[1]);
  texture->name = fmt::format("texture {}", scene_.textures.size());
  texture->name_location = texture->value_type_location = map.where;
  texture->value_type = value_type;
  texture.add(file_parameter("filename", map));
  if (value_type == "float") texture.text("encoding", "linear");
  scene_.textures.push_back(std::move(*texture));
  return scene_.textures.back().name;
}

// An image of one channel, each of whose values is replaced by a function of it. Nothing, with a warning,
// when the image cannot be read.
std::optional<MtlMap> MtlMaterials::channel(const MtlMap& map, int channel,
                                            const std::function<double(double)>& value) {
  if (!made_) made_.emplace(files_, scene_);
  MtlMap out = map;
  out.file = files_.root().find(made_->path(fmt::format("derived{}.png", derived_++)));
  out.where = made_->where();
  if (const auto error = gltf::write_channel(*map.file, out.file->path(), channel, value)) {
    warnings_.say(map.where, *error);
    return std::nullopt;
  }
  return out;
}

// d, or else 1 - Tr. `Tr 1` without d is written for opaque surfaces by some programs, and nobody means
// surfaces that are not there.
double MtlMaterials::opacity(const MtlMaterial& mtl) {
  if (const auto d = mtl.number("d")) return *d;
  const double tr = mtl.number("tr").value_or(0);
  return tr >= 1 && illum_of(mtl) < 4 ? 1 : 1 - tr;
}

// illum 6 and 7 refract. Some programs write illum 4 for all materials: without d or Tr below it says that a
// surface is clear only where nothing speaks for an opaque one.
bool MtlMaterials::is_clear(const MtlMaterial& mtl) {
  const int illum = illum_of(mtl);
  const bool stated = mtl.number("d") || mtl.number("tr");
  const bool refracts = mtl.number("ni").value_or(1) > 1 || mtl.colour("kd").value_or(kBlack) == kBlack;
  const bool faint = opacity(mtl) < 0.5 && !image(mtl, "map_d");
  return illum == 6 || illum == 7 || (illum == 4 && (stated ? opacity(mtl) < 1 : refracts)) || faint;
}

// Where Pm, or the mean of map_Pm, is above one half.
bool MtlMaterials::is_metal(const MtlMaterial& mtl) {
  const MtlMap* const map = image(mtl, "map_pm");
  std::string error;
  const auto mean = map ? gltf::mean_colour(*map->file, false, error) : std::nullopt;
  if (map && !mean) warnings_.say(map->where, error);
  return (mean ? mean->x : mtl.number("pm").value_or(0)) > 0.5;
}

std::optional<uint32_t> MtlMaterials::add_light(const MtlMaterial& mtl) {
  const glm::dvec3 ke = mtl.colour("ke").value_or(kBlack);
  const MtlMap* const map = image(mtl, "map_ke");
  if (ke == kBlack && !map) return std::nullopt;
  DirectiveMaker<Directive> light("diffuse", mtl.where);
  if (map)
    light.add(file_parameter("filename", *map)).number("scale", ke == kBlack ? 1 : most_of(ke));
  else
    light.rgb("L", ke);
  scene_.area_lights.push_back(std::move(*light));
  return static_cast<uint32_t>(scene_.area_lights.size() - 1);
}

// An image that is also map_Kd gives its alpha channel.
std::optional<Parameter> MtlMaterials::alpha_of(const MtlMaterial& mtl) {
  if (const MtlMap* const map = image(mtl, "map_d")) {
    const MtlMap* const kd = image(mtl, "map_kd");
    const auto alpha =
        kd && kd->file->path() == map->file->path() ? channel(*map, 3, [](double v) { return v; }) : *map;
    if (!alpha) return std::nullopt;
    return make_parameter(ParameterType::kTexture, "alpha", add_texture(*alpha, "float"), mtl.where);
  }
  const double opaque = std::max(opacity(mtl), 0.0);
  if (!(opaque < 1) || is_clear(mtl)) return std::nullopt;
  return make_parameter(ParameterType::kFloat, "alpha", std::vector<double>{opaque}, mtl.where);
}

}  // namespace kaustik::obj
