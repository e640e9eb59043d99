#pragma once
// Materials of a glTF file as the nearest ones of pbrt.

#include <map>

#include "apps/import/gltf/document.h"
#include "apps/import/gltf/textures.h"
#include "apps/import/warnings.h"
#include "core/scene/description.h"

namespace kaustik::gltf {

// What a primitive's material says about its shape.
struct Look {
  MaterialReference material;
  std::optional<uint32_t> area_light;
  std::optional<Parameter> alpha;
  uint64_t uv_set = 0;
  bool emits_image = false;  // over 0 to 1 of that set
};

class Materials {
 public:
  // Materials, textures and area lights are added to `scene`.
  Materials(const Document& document, Textures& textures, FileWarnings& warnings, SceneDescription& scene)
      : document_(document), textures_(textures), warnings_(warnings), scene_(scene) {}

  // Of a material's index; of glTF's default material without one.
  const Look& look(std::optional<uint64_t> index);

 private:
  Look make(const View& material, const std::string& name);
  std::string surface(const View& material, const std::string& name);
  std::string opaque(const View& material, const std::string& name);
  std::string dielectric_part(const View& material, const std::string& name);
  std::string metal_part(const View& material, const std::string& name);
  std::string clear_part(const View& material, const std::string& name);
  // The share of a mixture's second part: a texture's, where one is named.
  struct Share {
    double constant = 0;
    std::optional<std::string> texture;

    bool is(double s) const { return !texture && constant == s; }
  };
  Share share_of(double factor, const View& texture, int channel);
  std::string mixed(const std::string& name, const std::string& first, const std::string& second,
                    const Share& share);
  std::string add(MaterialDescription m, const std::string& name, const View& material);
  void add_colour(const View& material, MaterialDescription& m);
  void add_roughness(const View& material, MaterialDescription& m);
  std::optional<Parameter> alpha_of(const View& material);
  void add_lamp(const View& material, Look& look);
  bool add_emitted_image(const View& material, const glm::dvec3& L, uint64_t uv_set, Directive& lamp);
  void warn_of_extensions(const View& material);

  const Document& document_;
  Textures& textures_;
  FileWarnings& warnings_;
  SceneDescription& scene_;
  std::map<std::optional<uint64_t>, Look> looks_;
};

}  // namespace kaustik::gltf
