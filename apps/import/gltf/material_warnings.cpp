#include "apps/import/gltf/material_warnings.h"

#include <fmt/format.h>

#include <algorithm>

namespace kaustik::gltf {
namespace {

struct LeftOut {
  std::string_view name;     // of the extension
  const char* factor;        // its effect is none where this is 0
  std::string_view message;  // what becomes of it
};

constexpr LeftOut kLeftOut[] = {
    {"KHR_materials_sheen", "sheenColorFactor", "is left out: cloth lacks its soft edges of light"},
    {"KHR_materials_iridescence", "iridescenceFactor",
     "is left out: reflections have no colours of thin films"},
    {"KHR_materials_clearcoat", "clearcoatFactor",
     "replaces the base's own reflection where its factor is 0.5 or more, and is left out otherwise and over "
     "metal"},
};

// Extensions of materials that are rendered, or that do not change the picture.
constexpr std::string_view kRendered[] = {"KHR_materials_anisotropy", "KHR_materials_diffuse_transmission",
                                          "KHR_materials_dispersion", "KHR_materials_emissive_strength",
                                          "KHR_materials_ior",        "KHR_materials_pbrSpecularGlossiness",
                                          "KHR_materials_specular",   "KHR_materials_transmission",
                                          "KHR_materials_unlit",      "KHR_materials_volume"};

// Extensions with which a file says more than a picture of its first scene shows, or that are rendered.
constexpr std::string_view kUnderstood[] = {"KHR_lights_punctual",
                                            "KHR_mesh_quantization",
                                            "KHR_texture_transform",
                                            "EXT_texture_webp",
                                            "EXT_mesh_gpu_instancing",
                                            "KHR_node_visibility",
                                            "KHR_draco_mesh_compression",
                                            "EXT_meshopt_compression",
                                            "KHR_meshopt_compression",
                                            "KHR_materials_variants",
                                            "KHR_animation_pointer",
                                            "KHR_texture_basisu",
                                            "EXT_texture_avif",
                                            "MSFT_texture_dds",
                                            "MSFT_lod",
                                            "KHR_audio",
                                            "VRM",
                                            "VRMC_vrm",
                                            "VRMC_springBone",
                                            "VRMC_node_constraint"};

// Words in the names of extensions whose absence changes the look of surfaces, or nothing.
constexpr std::string_view kHarmless[] = {"_materials_", "_texture", "xmp",           "metadata",
                                          "features",    "physics",  "interactivity", "audio"};

template <class List>
bool holds(const List& list, std::string_view name) {
  return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

// Whether the value of a factor, a number or a colour, is zero.
bool is_zero(const View& factor) {
  if (!factor) return true;
  if (!factor.is_list()) return factor.number() == 0;
  for (uint64_t i = 0; i < factor.size(); ++i) {
    if (factor.at(i).number() != 0) return false;
  }
  return true;
}

}  // namespace

void warn_of_extensions(const View& material, FileWarnings& warnings) {
  for (const std::string& name : material["extensions"].names()) {
    if (holds(kRendered, name)) continue;
    const auto known = std::find_if(std::begin(kLeftOut), std::end(kLeftOut),
                                    [&](const LeftOut& l) { return l.name == name; });
    if (known == std::end(kLeftOut))
      warnings.count(fmt::format("{} is ignored", name.substr(0, 60)), "material");
    else if (!is_zero(material["extensions"][name.c_str()][known->factor]))
      warnings.count(fmt::format("{} {}", name, known->message), "material");
  }
  if (material.has("occlusionTexture"))
    warnings.say("occlusion textures are ignored: the renderer computes occlusion itself");
}

void check_required_extensions(const View& root, FileWarnings& warnings) {
  const View required = root["extensionsRequired"];
  for (uint64_t i = 0; i < required.size(); ++i) {
    const std::string name = required.at(i).text();
    const bool rendered = holds(kRendered, name) || holds(kUnderstood, name) ||
                          std::any_of(std::begin(kLeftOut), std::end(kLeftOut),
                                      [&](const LeftOut& l) { return l.name == name; });
    if (rendered) continue;
    const bool harmless = std::any_of(std::begin(kHarmless), std::end(kHarmless), [&](std::string_view word) {
      return name.find(word) != std::string::npos;
    });
    if (!harmless)
      throw FormatError(
          fmt::format("it requires the extension {}, which is not supported: parts of it would be missing",
                      name.substr(0, 60)));
    warnings.say(fmt::format("it requires the extension {}, which is ignored", name.substr(0, 60)));
  }
}

}  // namespace kaustik::gltf
