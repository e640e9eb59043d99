#include "apps/import/gltf/importer.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "apps/import/common/make_parameter.h"
#include "apps/import/gltf/deformation.h"
#include "apps/import/gltf/lights_and_cameras.h"
#include "apps/import/gltf/material_warnings.h"
#include "apps/import/gltf/materials.h"
#include "apps/import/gltf/meshes.h"
#include "apps/import/gltf/nodes.h"
#include "apps/import/view/camera_choice.h"
#include "core/text.h"

namespace kaustik::gltf {
namespace {

class Importer {
 public:
  Importer(Document& document, const std::filesystem::path& path, const ImportOptions& options,
           Diagnostics& diagnostics)
      : document_(document),
        options_(options),
        warnings_({document.file(), 0, 0}, diagnostics),
        pose_(document, double(options.seconds.value_or(0)), warnings_),
        nodes_(placed_nodes(document, pose_, warnings_)),
        deformation_(document, pose_, nodes_),
        textures_(document, path, options.texture_pixels, warnings_, diagnostics.files, scene_),
        materials_(document, textures_, warnings_, scene_) {
    scene_.location = warnings_.where();
    scene_.grey_for_unreadable_images = true;
  }

  SceneDescription run() {
    check_required_extensions(document_.root(), warnings_);
    for (const PlacedNode& n : nodes_) {
      const View node = document_.item("nodes", n.node);
      const auto mesh = node["mesh"].index(document_.size("meshes"));
      if (mesh && !deformation_.applies_to(n.node))
        uses_[*mesh] += instances_of(document_, node, warnings_).size();
    }
    choose_camera();
    for (const PlacedNode& n : nodes_) add_node(n);
    if (pose_.animated()) scene_.animation = {pose_.duration(), moves_world()};
    if (pose_.animated())
      scene_.notes.push_back(
          fmt::format("the file is animated, up to {:.3g} s: it is shown at {:.3g} s (--at)",
                      pose_.duration(), options_.seconds.value_or(0)));
    return std::move(scene_);
  }

 private:
  bool moves_world() const {
    return std::any_of(nodes_.begin(), nodes_.end(), [&](const PlacedNode& n) {
      const View node = document_.item("nodes", n.node);
      const bool shown = node.has("mesh") || node["extensions"].has("KHR_lights_punctual");
      return node.has("skin") || (n.animated && shown);
    });
  }

  // A camera's name is that of its node, as modelling programs show it, or else its own.
  void choose_camera() {
    std::vector<std::string> names;
    std::vector<const PlacedNode*> placed;
    for (const PlacedNode& n : nodes_) {
      const View node = document_.item("nodes", n.node);
      const auto camera = node["camera"].index(document_.size("cameras"));
      if (!camera) continue;
      const std::string name = node["name"].text("");
      names.push_back(name.empty() ? document_.item("cameras", *camera)["name"].text("") : name);
      placed.push_back(&n);
    }
    const std::string& asked = options_.view.camera;
    std::string error;
    const auto chosen = asked.empty() ? std::optional<size_t>(0) : find_camera(names, asked, error);
    if (!chosen) throw FormatError(error);
    if (placed.empty()) return;
    camera_ = placed[*chosen];
    if (asked.empty() && names.size() > 1)
      warnings_.say(
          fmt::format("the file has {} cameras: the first is used; --camera chooses another", names.size()));
  }

  void add_node(const PlacedNode& placed) {
    const View node = document_.item("nodes", placed.node);
    const auto& m = placed.to_world;
    if (!(std::isfinite(glm::determinant(m)) && glm::determinant(glm::dmat3(m)) != 0)) {
      if (node.has("mesh"))
        warnings_.count("nodes whose transform has no inverse are left out with their meshes", "node");
      return;
    }
    if (&placed == camera_)
      add_camera(document_.item("cameras", *node["camera"].index(document_.size("cameras"))), m, warnings_,
                 scene_);
    add_light(document_, node, m, options_.light_unit, warnings_, scene_);
    const auto mesh = node["mesh"].index(document_.size("meshes"));
    if (!mesh) return;
    if (deformation_.applies_to(placed.node)) return add_deformed(placed.node, *mesh, m);
    const std::string name = name_of(node, *mesh);
    for (const glm::dmat4& instance : instances_of(document_, node, warnings_))
      add_mesh(*mesh, name, m * instance);
  }

  std::optional<ShapeDescription> shape_of(const View& primitive) {
    if (!has_triangles(primitive, warnings_)) return std::nullopt;
    document_.decompress(primitive);
    VertexColours colours = vertex_colours(document_, primitive, total_);
    const Look& look = materials_.look(primitive["material"].index(document_.size("materials")),
                                       {colours.common, !colours.each.empty()});
    auto shape = triangles_of(document_, primitive, look.uv, total_, warnings_);
    if (!shape) return std::nullopt;
    shape->material = look.material;
    shape->area_light = look.area_light;
    shape->media.inside = look.inside;
    if (look.alpha) shape->parameters.push_back(*look.alpha);
    if (look.by_vertex)
      shape->parameters.push_back(
          make_parameter(ParameterType::kFloat, "Cd", std::move(colours.each), warnings_.where()));
    if (look.emits_image && leaves_image(*shape))
      warnings_.say("emission textures are not repeated beyond their edges");
    return shape;
  }

  std::vector<ShapeDescription> shapes_of(uint64_t mesh, const std::string& name) {
    std::vector<ShapeDescription> shapes;
    const View primitives = document_.item("meshes", mesh)["primitives"];
    for (uint64_t i = 0; i < primitives.size(); ++i) {
      auto shape = shape_of(primitives.at(i));
      if (!shape) continue;
      shape->name = name_of(name, primitives, i);
      shapes.push_back(std::move(*shape));
    }
    return shapes;
  }

  // What the file calls a node, or else its mesh.
  std::string name_of(const View& node, uint64_t mesh) const {
    const std::string name = node["name"].text("");
    return name.empty() ? document_.item("meshes", mesh)["name"].text("") : name;
  }

  // The name of a part of something; materials tell several parts apart.
  std::string name_of(const std::string& whole, const View& primitives, uint64_t part) const {
    const auto material = primitives.at(part)["material"].index(document_.size("materials"));
    if (primitives.size() == 1 || whole.empty() || !material) return whole;
    return fmt::format("{}, {}", whole, document_.item("materials", *material)["name"].text("material"));
  }

  void add_deformed(uint64_t node, uint64_t mesh, const glm::dmat4& to_world) {
    const View primitives = document_.item("meshes", mesh)["primitives"];
    for (uint64_t i = 0; i < primitives.size(); ++i) {
      auto shape = shape_of(primitives.at(i));
      if (!shape) continue;
      shape->name = name_of(name_of(document_.item("nodes", node), mesh), primitives, i);
      const bool in_world = deformation_.apply(node, primitives.at(i), *shape);
      place(std::move(*shape), in_world ? glm::dmat4(1) : to_world);
    }
  }

  static bool leaves_image(const ShapeDescription& shape) {
    const Parameter* uv = shape.find("uv");
    return uv && std::any_of(uv->numbers.begin(), uv->numbers.end(), [](double x) { return x < 0 || x > 1; });
  }

  // A mesh that several nodes use becomes an object with instances. Its emitting shapes are copied, since
  // lights cannot be instanced. Instances have the name of the first node.
  void add_mesh(uint64_t mesh, const std::string& name, const glm::dmat4& to_world) {
    if (uses_[mesh] == 1) {
      for (ShapeDescription& shape : shapes_of(mesh, name)) place(std::move(shape), to_world);
      return;
    }
    const auto [found, is_new] = meshes_.try_emplace(mesh);
    SharedMesh& shared = found->second;
    if (is_new) {
      ObjectDescription object{fmt::format("mesh {}", mesh), warnings_.where(), {}};
      for (ShapeDescription& shape : shapes_of(mesh, name))
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

  Document& document_;
  const ImportOptions& options_;
  SceneDescription scene_;
  FileWarnings warnings_;
  Pose pose_;
  std::vector<PlacedNode> nodes_;
  const PlacedNode* camera_ = nullptr;  // the node whose camera is used
  Deformation deformation_;
  Textures textures_;
  Materials materials_;
  std::map<uint64_t, uint64_t> uses_;  // number of uses, by mesh
  std::map<uint64_t, SharedMesh> meshes_;
  uint64_t total_ = 0;  // numbers read for all meshes so far
};

}  // namespace

bool is_gltf(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".gltf" || extension == ".glb";
}

std::optional<SceneDescription> import_gltf(const ReadableFile& readable, Diagnostics& diagnostics,
                                            const ImportOptions& options) {
  const auto file = static_cast<uint32_t>(diagnostics.files.size());
  try {
    Document document(readable, diagnostics.files);
    SceneDescription scene = Importer(document, readable.path(), options, diagnostics).run();
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
