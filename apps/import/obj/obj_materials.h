#pragma once
// Converts MTL materials to the nearest pbrt materials (docs/reference/scene_format.md lists the mapping).

#include <functional>
#include <memory>

#include "apps/import/common/counted_warnings.h"
#include "apps/import/common/made_files.h"
#include "apps/import/common/unique_names.h"
#include "apps/import/obj/mtl_reader.h"
#include "core/scene/description/description.h"

namespace kaustik::obj {

// What a material contributes to its shapes.
struct MtlLook {
  std::string material;                // the name of a material of the scene
  std::optional<uint32_t> area_light;  // radiance Ke, or the image map_Ke times Ke's largest component
  std::optional<Parameter> alpha;      // from map_d or d; nothing for opaque and for clear materials
};

class MtlMaterials {
 public:
  // Materials, textures and area lights are added to `scene`. With `vertex_colours` the colours of vertices
  // are factors on Kd and map_Kd, whose default is then white.
  MtlMaterials(CountedWarnings& warnings, SourceFiles& files, SceneDescription& scene, bool vertex_colours)
      : warnings_(warnings), files_(files), scene_(scene), vertex_colours_(vertex_colours) {}

  MtlLook add(const MtlMaterial& mtl);

 private:
  // These return the name that the material has got, which has a number where `name` was taken.
  std::string add_surface(const MtlMaterial& mtl, const std::string& name);
  std::string add_material(MaterialDescription m, const std::string& name, const MtlMaterial& mtl);
  MaterialDescription clear(const MtlMaterial& mtl);
  MaterialDescription metal(const MtlMaterial& mtl, const glm::dvec3& colour, const MtlMap* map);
  MaterialDescription opaque(const MtlMaterial& mtl);
  std::string add_mirror_over_diffuse(const MtlMaterial& mtl, const std::string& name);
  void add_colour(const MtlMaterial& mtl, const glm::dvec3& colour, const MtlMap* map,
                  MaterialDescription& m);
  void add_width(const MtlMaterial& mtl, MaterialDescription& m);
  void add_normals(const MtlMaterial& mtl, MaterialDescription& m);
  Parameter times_vertex_colours(Parameter value);
  std::string add_texture(const MtlMap& map, const std::string& value_type);
  std::optional<MtlMap> channel(const MtlMap& map, int channel, const std::function<double(double)>& value);
  double opacity(const MtlMaterial& mtl);
  bool is_clear(const MtlMaterial& mtl);
  bool is_metal(const MtlMaterial& mtl);
  std::optional<uint32_t> add_light(const MtlMaterial& mtl);
  std::optional<Parameter> alpha_of(const MtlMaterial& mtl);
  Parameter file_parameter(const std::string& name, const MtlMap& map) const;

  CountedWarnings& warnings_;
  SourceFiles& files_;
  SceneDescription& scene_;
  bool vertex_colours_;
  std::optional<MadeFiles> made_;  // images that are made from others
  size_t derived_ = 0;
  UniqueNames names_;
};

}  // namespace kaustik::obj
