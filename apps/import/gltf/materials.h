#pragma once
// Converts the materials of a glTF file to the nearest pbrt materials.

#include <array>
#include <functional>
#include <map>

#include "apps/import/common/unique_names.h"
#include "apps/import/common/warnings.h"
#include "apps/import/gltf/file/document.h"
#include "apps/import/gltf/textures.h"
#include "core/scene/description/description.h"

namespace kaustik::gltf {

// What a primitive's material contributes to its shape.
struct Look {
  MaterialReference material;
  std::optional<uint32_t> area_light;
  std::optional<Parameter> alpha;
  MediumReference inside;
  UvSource uv;
  bool by_vertex = false;    // shows the colours of vertices
  bool emits_image = false;  // shown once, over uv from 0 to 1
};

// What the colours of its vertices do to a primitive's base colour and alpha.
struct VertexTint {
  glm::dvec4 factor{1};  // of all vertices
  bool each = false;     // colours differ from vertex to vertex
  auto key() const { return std::array<double, 5>{factor.x, factor.y, factor.z, factor.w, each ? 1.0 : 0.0}; }
};

class Materials {
 public:
  // Materials, textures and area lights are added to `scene`.
  Materials(const Document& document, Textures& textures, FileWarnings& warnings, SceneDescription& scene)
      : document_(document), textures_(textures), warnings_(warnings), scene_(scene) {}

  // The look of the material with this index; without an index, of glTF's default material.
  const Look& look(std::optional<uint64_t> index, const VertexTint& tint);

 private:
  Look make(const View& material, const std::string& name);
  std::string surface(const View& material, const std::string& name);
  std::string opaque(const View& material, const std::string& name);
  // Base colour and alpha, or their equivalent in KHR_materials_pbrSpecularGlossiness.
  struct Base {
    View texture;
    std::vector<double> factor;  // red, green, blue, alpha
    glm::dvec3 colour() const { return {factor[0], factor[1], factor[2]}; }
  };
  Base base_of(const View& material) const;
  // The GGX width alpha as a function of one texture channel.
  struct Width {
    View texture;
    int channel;
    std::function<double(double)> width;
  };
  UvSource uv_of(const View& material);
  std::string unlit(const View& material, const std::string& name, Look& look);
  static Width width_of(const View& material, bool coat);
  std::string glossy(const View& material, const std::string& name);
  std::string sheet(const View& material, const std::string& name);
  double specular_index(const View& material);
  std::string dielectric_part(const View& material, const std::string& name, double eta);
  std::string metal_part(const View& material, const std::string& name);
  std::string clear_part(const View& material, const std::string& name);
  // The share of the second part of a mixture: a texture's name, or else a constant.
  struct Share {
    double constant = 0;
    std::optional<std::string> texture;

    bool is(double s) const { return !texture && constant == s; }
  };
  Share share_of(double factor, const View& texture, int channel);
  std::string mixed(const std::string& name, const std::string& first, const std::string& second,
                    const Share& share);
  // Returns the name that the material has got, which has a number where `name` was taken.
  std::string add(MaterialDescription m, const std::string& name, const View& material);
  void add_colour(const std::string& parameter, const View& texture, const glm::dvec3& factor,
                  MaterialDescription& m, double exponent = 1);
  // Adds the base colour times `share`, and times the colours of vertices if they differ. `exponent` applies
  // to the values of textures.
  void add_base(const std::string& parameter, const Base& base, double share, MaterialDescription& m,
                double exponent = 1);
  void add_transmittance(const View& material, bool pane, MaterialDescription& m);
  MediumReference inside_of(const View& material, const std::string& name);
  void add_width(const std::string& parameter, const Width& width, MaterialDescription& m);
  void add_roughness(const View& material, bool coat, MaterialDescription& m);
  std::optional<Parameter> alpha_of(const View& material);
  // Makes the look emit L, times a texture if `texture` names one.
  void add_light(const View& material, const View& texture, const glm::dvec3& L, Look& look);
  bool add_emitted_image(const View& texture, const glm::dvec3& L, const UvSource& uv, Directive& light);

  const Document& document_;
  Textures& textures_;
  FileWarnings& warnings_;
  SceneDescription& scene_;
  UniqueNames names_;
  VertexTint tint_;  // of the look under construction
  std::map<std::pair<std::optional<uint64_t>, std::array<double, 5>>, Look> looks_;
};

}  // namespace kaustik::gltf
