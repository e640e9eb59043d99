#include "apps/import/gltf/importer.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "apps/import/common/default_view.h"
#include "apps/import/gltf/deformation.h"
#include "apps/import/gltf/lights_and_cameras.h"
#include "apps/import/gltf/materials.h"
#include "apps/import/gltf/meshes.h"
#include "apps/import/gltf/nodes.h"

namespace kaustik::gltf {
namespace {

// Extensions that a file may require: they are supported, or ignoring them leaves a usable scene.
constexpr std::string_view kKnown[] = {"KHR_lights_punctual",        "KHR_materials_emissive_strength",
                                       "KHR_materials_ior",          "KHR_materials_specular",
                                       "KHR_materials_transmission", "KHR_materials_volume",
                                       "KHR_materials_clearcoat",    "KHR_materials_sheen",
                                       "KHR_materials_unlit",        "KHR_materials_anisotropy",
                                       "KHR_materials_iridescence",  "KHR_materials_dispersion",
                                       "KHR_mesh_quantization",      "KHR_texture_transform",
                                       "EXT_texture_webp",           "KHR_materials_variants",
                                       "EXT_mesh_gpu_instancing",    "KHR_materials_diffuse_transmission",
                                       "KHR_node_visibility",        "KHR_materials_pbrSpecularGlossiness",
                                       "KHR_texture_basisu",         "KHR_materials_diffuse_roughness",
                                       "KHR_animation_pointer",      "KHR_xmp_json_ld"};

class Importer {
 public:
  Importer(const Document& document, const std::filesystem::path& path, const ImportOptions& options,
           Diagnostics& diagnostics)
      : document_(document),
        options_(options),
        warnings_({document.file(), 0, 0}, diagnostics),
        nodes_(placed_nodes(document)),
        deformation_(document, nodes_),
        textures_(document, path, warnings_, diagnostics.files, scene_),
        materials_(document, textures_, warnings_, scene_) {
    scene_.location = warnings_.where();
  }

  SceneDescription run() {
    check_extensions();
    for (const PlacedNode& n : nodes_) {
      const View node = document_.item("nodes", n.node);
      const auto mesh = node["mesh"].index(document_.size("meshes"));
      if (mesh && !deformation_.applies_to(node)) uses_[*mesh] += instances_of(document_, node).size();
    }
    for (const PlacedNode& n : nodes_) add_node(n);
    if (document_.size("animations") > 0)
      warnings_.say("animations are ignored: the scene is rendered in the pose that the file states");
    return std::move(scene_);
  }

 private:
  void check_extensions() {
    const View required = document_.root()["extensionsRequired"];
    for (uint64_t i = 0; i < required.size(); ++i) {
      const std::string name = required.at(i).text();
      if (std::find(std::begin(kKnown), std::end(kKnown), name) == std::end(kKnown))
        throw FormatError(
            fmt::format("it requires the extension {}, which is not supported", name.substr(0, 60)));
    }
  }

  void add_node(const PlacedNode& placed) {
    const View node = document_.item("nodes", placed.node);
    const auto& m = placed.to_world;
    if (!(std::isfinite(glm::determinant(m)) && glm::determinant(glm::dmat3(m)) != 0)) {
      if (node.has("mesh"))
        warnings_.say(
            fmt::format("node {} has a transform without an inverse: its mesh is ignored", placed.node));
      return;
    }
    if (const auto camera = node["camera"].index(document_.size("cameras"))) {
      if (!scene_.camera) {
        add_camera(document_.item("cameras", *camera), m, warnings_, scene_);
      } else {
        warnings_.say("the file has several cameras: the first is used");
      }
    }
    add_light(document_, node, m, options_.light_unit, warnings_, scene_);
    const auto mesh = node["mesh"].index(document_.size("meshes"));
    if (!mesh) return;
    if (deformation_.applies_to(node)) return add_deformed(node, *mesh, m);
    for (const glm::dmat4& instance : instances_of(document_, node)) add_mesh(*mesh, m * instance);
  }

  std::optional<ShapeDescription> shape_of(const View& primitive) {
    const glm::dvec3 tint = mean_vertex_colour(document_, primitive, warnings_);
    const Look& look = materials_.look(primitive["material"].index(document_.size("materials")), tint);
    auto shape = triangles_of(document_, primitive, look.uv_set, total_, warnings_);
    if (!shape) return std::nullopt;
    shape->material = look.material;
    shape->area_light = look.area_light;
    if (look.alpha) shape->parameters.push_back(*look.alpha);
    if (look.emits_image && leaves_image(*shape))
      warnings_.say("emission textures are not repeated beyond their edges");
    return shape;
  }

  std::vector<ShapeDescription> shapes_of(uint64_t mesh) {
    std::vector<ShapeDescription> shapes;
    const View primitives = document_.item("meshes", mesh)["primitives"];
    for (uint64_t i = 0; i < primitives.size(); ++i) {
      if (auto shape = shape_of(primitives.at(i))) shapes.push_back(std::move(*shape));
    }
    return shapes;
  }

  void add_deformed(const View& node, uint64_t mesh, const glm::dmat4& to_world) {
    const View primitives = document_.item("meshes", mesh)["primitives"];
    for (uint64_t i = 0; i < primitives.size(); ++i) {
      auto shape = shape_of(primitives.at(i));
      if (!shape) continue;
      const bool in_world = deformation_.apply(node, primitives.at(i), *shape);
      place(std::move(*shape), in_world ? glm::dmat4(1) : to_world);
    }
  }

  static bool leaves_image(const ShapeDescription& shape) {
    const Parameter* uv = shape.find("uv");
    return uv && std::any_of(uv->numbers.begin(), uv->numbers.end(), [](double x) { return x < 0 || x > 1; });
  }

  // A mesh that several nodes use becomes an object with instances. Its emitting shapes are copied, since
  // lights cannot be instanced.
  void add_mesh(uint64_t mesh, const glm::dmat4& to_world) {
    if (uses_[mesh] == 1) {
      for (ShapeDescription& shape : shapes_of(mesh)) place(std::move(shape), to_world);
      return;
    }
    const auto [found, is_new] = meshes_.try_emplace(mesh);
    SharedMesh& shared = found->second;
    if (is_new) {
      ObjectDescription object{fmt::format("mesh {}", mesh), warnings_.where(), {}};
      for (ShapeDescription& shape : shapes_of(mesh))
        (shape.area_light ? shared.lights : object.shapes).push_back(std::move(shape));
      shared.object = object.name;
      if (!object.shapes.empty())
        scene_.objects.push_back(std::move(object));
      else
        shared.object.clear();
    }
    for (const ShapeDescription& light : shared.lights) place(light, to_world);
    if (!shared.object.empty()) scene_.instances.push_back({shared.object, warnings_.where(), to_world});
  }

  void place(ShapeDescription shape, const glm::dmat4& to_world) {
    shape.object_to_world = to_world;
    scene_.shapes.push_back(std::move(shape));
  }

  struct SharedMesh {
    std::string object;  // name of the object; empty when all its shapes emit
    std::vector<ShapeDescription> lights;
  };

  const Document& document_;
  const ImportOptions& options_;
  SceneDescription scene_;
  FileWarnings warnings_;
  std::vector<PlacedNode> nodes_;
  Deformation deformation_;
  Textures textures_;
  Materials materials_;
  std::map<uint64_t, uint64_t> uses_;  // number of uses, by mesh
  std::map<uint64_t, SharedMesh> meshes_;
  uint64_t total_ = 0;  // numbers read for all meshes so far
};

}  // namespace

bool is_gltf(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".gltf" || extension == ".glb";
}

std::optional<SceneDescription> import_gltf(const std::filesystem::path& path, Diagnostics& diagnostics,
                                            const ImportOptions& options) {
  const auto file = static_cast<uint32_t>(diagnostics.files.size());
  try {
    const Document document(path, diagnostics.files);
    SceneDescription scene = Importer(document, path, options, diagnostics).run();
    add_missing_view(scene, scene.location, diagnostics);
    return scene;
  } catch (const FormatError& error) {
    const bool opened = diagnostics.files.size() > file;
    diagnostics.error(opened ? SourceLocation{file, 0, 0} : SourceLocation{}, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    diagnostics.error({}, error.what());
  }
  return std::nullopt;
}

}  // namespace kaustik::gltf
