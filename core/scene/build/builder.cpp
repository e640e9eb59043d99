// Builds the scene: collects shapes and instances, loads meshes, chooses the origin, and places shapes and
// lights.

#include "core/scene/build/builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <map>

#include "core/diagnostics/nearest_name.h"
#include "core/parallel/parallel.h"
#include "core/scene/build/camera_builder.h"
#include "core/scene/build/light_table.h"
#include "core/scene/build/local_origin.h"
#include "core/scene/build/material_table.h"
#include "core/scene/build/medium_check.h"
#include "core/scene/build/medium_table.h"
#include "core/scene/build/sensor_builder.h"
#include "core/scene/build/surface_groups.h"
#include "core/scene/build/without_area.h"
#include "core/scene/schema/light_images.h"
#include "core/scene/shapes/shape_source.h"

namespace kaustik {
namespace {

// Limit on the number of placed shapes. Each takes some hundred bytes, so more is a mistake, or a scene for a
// larger machine.
constexpr uint64_t kMostPlacements = 10'000'000;

// A Shape line that passed the checks, with its geometry.
struct Item {
  const ShapeDescription* description = nullptr;
  uint32_t material = 0;
  MediumInterface media{};
  float alpha = 1;
  uint32_t alpha_texture = kNoIndex;
  std::optional<size_t> object;  // the object it belongs to; nothing for shapes placed directly in the world
  std::optional<ShapeSource> source;
  size_t placements = 0;
  std::optional<SharedMesh> shared;  // made from the source if its placements share it
  DiagnosticList diagnostics;        // from making the source
  size_t messages = 0;               // their number
};

// Shapes or instances that are left out for one reason, which is reported once.
struct LeftOut {
  size_t count = 0;
  SourceLocation first;

  void add(const SourceLocation& where) {
    if (count++ == 0) first = where;
  }
  void report(std::string_view noun, DiagnosticList& diagnostics) const {
    if (count == 0) return;
    const std::string many = count > 1 ? fmt::format(" ({} {}s in all)", count, noun) : "";
    diagnostics.warning(first,
                        fmt::format("the transform of this {} has no inverse: it is left out{}", noun, many));
  }
};

// One placement of an item.
struct Placement {
  size_t item = 0;
  glm::dmat4 to_world{1};
  bool light = false;
  bool last = false;    // the item's last placement, which may take the geometry instead of copying it
  size_t instance = 0;  // into SceneDescription::instances, for shapes of objects
};

class Builder {
 public:
  Builder(const SceneDescription& description, const MeshLoader& load_mesh, Diagnostics& diagnostics,
          const LightImageLoader& load_light_image, const ImageLoader& images)
      : description_(description),
        load_mesh_(load_mesh),
        images_(images),
        diagnostics_(diagnostics),
        light_images_(load_light_image, diagnostics) {}

  std::optional<Scene> build() {
    Scene scene;
    scene.camera = build_camera(description_, warned_, diagnostics_);
    scene.sensor = build_sensor(description_, diagnostics_);
    textures_.emplace(description_, images_, warned_, diagnostics_);
    MaterialTable materials(description_, *textures_, warned_, diagnostics_);
    media_.emplace(description_, warned_, diagnostics_);
    if (description_.camera) scene.camera_medium = media_->resolve(description_.camera->medium, diagnostics_);
    collect(materials);
    flat_shapes_.report("shape", diagnostics_);
    flat_instances_.report("instance", diagnostics_);
    load_sources();
    choose_origin(scene);
    lights_.emplace(description_, light_images_, *textures_, warned_, diagnostics_);
    build_lights(scene);
    if (diagnostics_.has_errors()) return std::nullopt;
    share_meshes();
    place(scene);
    if (diagnostics_.has_errors()) return std::nullopt;
    scene.materials = std::move(materials.materials());
    scene.material_names = std::move(materials.names());
    scene.media = media_->finish(scene.origin);
    scene.medium_names = std::move(media_->names());
    if (description_.camera) check_camera_medium(scene, description_.camera->location, diagnostics_);
    scene.textures = textures_->finish(scene.origin);
    finalize_scene(scene);
    return scene;
  }

 private:
  void collect(MaterialTable& materials);
  std::optional<size_t> add_item(const ShapeDescription& shape, std::optional<size_t> object,
                                 MaterialTable& materials);
  bool fits_memory(const std::map<std::string_view, std::vector<size_t>>& items_of);
  void set_alpha(const ShapeDescription& shape, Item& item);
  void add_instance(size_t index, const std::map<std::string_view, std::vector<size_t>>& items_of);
  bool fills_memory(const TriangleMesh* mesh, const ShapeDescription& shape,
                    DiagnosticList& diagnostics) const;
  void load_sources();
  std::optional<ShapeSource> make_source(const Item& item, const glm::dvec3& mesh_origin,
                                         DiagnosticList& diagnostics) const;
  std::vector<ExactBounds> item_bounds() const;
  void choose_origin(Scene& scene);
  void move_inline_meshes(const std::vector<ExactBounds>& of_item, const glm::dvec3& origin);
  void build_lights(Scene& scene);
  void share_meshes();
  void place(Scene& scene);
  bool keep(const Placement& placement, PlacedShape& placed);
  std::string group_name(const ShapeDescription& shape) const;
  std::string group_key(const Placement& placement) const;

  const SceneDescription& description_;
  const MeshLoader& load_mesh_;
  const ImageLoader& images_;
  Diagnostics& diagnostics_;
  LightImages light_images_;
  WarnedOnce warned_;
  std::optional<TextureTable> textures_;
  std::optional<MediumTable> media_;
  std::optional<LightTable> lights_;
  std::vector<Item> items_;
  std::vector<Placement> placements_;
  TrianglesWithoutArea without_area_;
  LeftOut flat_shapes_, flat_instances_;
};

// Returns nothing if the shape is invalid, or has an "interface" material and separates no media.
std::optional<size_t> Builder::add_item(const ShapeDescription& shape, std::optional<size_t> object,
                                        MaterialTable& materials) {
  const uint32_t material = materials.resolve(shape.material, diagnostics_);
  const MediumInterface media = media_->resolve(shape.media, diagnostics_);
  const TypeSpec* spec = find_type(category("Shape"), shape, diagnostics_);
  bool ok = spec && check_parameters("shape", *spec, shape, warned_, diagnostics_);
  if (!ok) return std::nullopt;
  if (!is_usable_transform(shape.object_to_world)) {
    flat_shapes_.add(shape.location);
    return std::nullopt;
  }
  if (material == MaterialTable::kInterface) {
    if (shape.area_light) {
      diagnostics_.warning(shape.location,
                           "the area light is ignored: material \"interface\" is not a surface",
                           {{description_.area_lights[*shape.area_light].location, "the area light"}});
    }
    if (!media.is_transition()) return std::nullopt;
  }
  Item& item = items_.emplace_back();
  item.description = &shape;
  item.material = material;
  item.media = media;
  item.object = object;
  set_alpha(shape, item);
  return items_.size() - 1;
}

void Builder::set_alpha(const ShapeDescription& shape, Item& item) {
  const Parameter* alpha = shape.find("alpha");
  if (!alpha) return;
  if (alpha->type == ParameterType::kTexture) {
    item.alpha_texture = textures_->find(*alpha, TextureValue::kFloat, diagnostics_);
  } else {
    item.alpha = static_cast<float>(alpha->numbers[0]);
  }
}

void Builder::collect(MaterialTable& materials) {
  for (const ShapeDescription& shape : description_.shapes) {
    if (const auto item = add_item(shape, std::nullopt, materials)) {
      const bool light = shape.area_light && items_[*item].material != MaterialTable::kInterface;
      placements_.push_back({*item, shape.object_to_world, light, true});
    }
  }
  std::map<std::string_view, std::vector<size_t>> items_of;
  for (size_t o = 0; o < description_.objects.size(); ++o) {
    const ObjectDescription& object = description_.objects[o];
    std::vector<size_t>& items = items_of[object.name];
    for (const ShapeDescription& shape : object.shapes) {
      if (const auto item = add_item(shape, o, materials)) items.push_back(*item);
      if (shape.area_light) {
        diagnostics_.warning(shape.location,
                             "the area light is ignored: shapes of an object cannot be lights");
      }
    }
  }
  if (!fits_memory(items_of)) return;
  for (size_t i = 0; i < description_.instances.size(); ++i) add_instance(i, items_of);
}

bool Builder::fits_memory(const std::map<std::string_view, std::vector<size_t>>& items_of) {
  uint64_t placed = 0;
  for (const InstanceDescription& instance : description_.instances) {
    const auto found = items_of.find(instance.object);
    if (found != items_of.end()) placed += found->second.size();
    if (placed <= kMostPlacements) continue;
    diagnostics_.error(instance.location,
                       fmt::format("instances place more than {} shapes, the limit", kMostPlacements));
    return false;
  }
  return true;
}

void Builder::add_instance(size_t index, const std::map<std::string_view, std::vector<size_t>>& items_of) {
  const InstanceDescription& instance = description_.instances[index];
  const auto found = items_of.find(instance.object);
  if (found == items_of.end()) {
    const auto names = [&] { return keys_of(items_of); };
    diagnostics_.error(instance.location, fmt::format("no object is named `{}`{}", instance.object,
                                                      diagnostics_.hint(instance.object, names)));
    return;
  }
  if (!is_usable_transform(instance.instance_to_world)) {
    return flat_instances_.add(instance.location);
  }
  for (const size_t item : found->second) {
    placements_.push_back(
        {item, instance.instance_to_world * items_[item].description->object_to_world, false, false, index});
  }
}

std::optional<ShapeSource> Builder::make_source(const Item& item, const glm::dvec3& mesh_origin,
                                                DiagnosticList& diagnostics) const {
  const auto& rows = shape_rows();
  const auto row = std::find_if(rows.begin(), rows.end(),
                                [&](const ShapeRow& r) { return r.spec.name == item.description->type; });
  return make_shape_source(*item.description, *row, load_mesh_, diagnostics_.files.root().room(), diagnostics,
                           mesh_origin);
}

// Whether the shape, of many that were made of a few numbers each, was the last one to fit into memory; then
// this is an error. Smaller shapes are not asked about.
bool Builder::fills_memory(const TriangleMesh* mesh, const ShapeDescription& shape,
                           DiagnosticList& diagnostics) const {
  constexpr size_t kFewTriangles = 128;
  if (!mesh || mesh->indices.size() < kFewTriangles) return false;
  std::string exceeded = diagnostics_.files.root().room().exceeded();
  if (exceeded.empty()) return false;
  diagnostics.error(shape.location, std::move(exceeded));
  return true;
}

void Builder::load_sources() {
  std::atomic<bool> full = false;
  parallel::for_index(size_t{0}, items_.size(), [&](size_t i) {
    if (full) return;
    Item& item = items_[i];
    item.source = make_source(item, glm::dvec3(0), item.diagnostics);
    const auto* const mesh = item.source ? std::get_if<TriangleMesh>(&item.source->geometry) : nullptr;
    if (fills_memory(mesh, *item.description, item.diagnostics)) full = true;
  });
  for (Item& item : items_) {
    item.messages = item.diagnostics.entries().size();
    diagnostics_.append(std::move(item.diagnostics));
  }
}

// Bounds of each item in its own space.
std::vector<ExactBounds> Builder::item_bounds() const {
  std::vector<ExactBounds> bounds(items_.size());
  parallel::for_index(size_t{0}, items_.size(), [&](size_t i) {
    bounds[i] = object_bounds(*items_[i].description, *items_[i].source);
  });
  return bounds;
}

// Chooses the scene's origin. From here on placements are relative to it.
void Builder::choose_origin(Scene& scene) {
  if (diagnostics_.has_errors()) return;
  const std::vector<ExactBounds> of_item = item_bounds();
  ExactBounds bounds;
  for (const Placement& p : placements_) bounds.add(mapped(p.to_world, of_item[p.item]));
  scene.origin = local_origin(bounds);
  if (scene.origin == glm::dvec3(0)) return;
  move_inline_meshes(of_item, scene.origin);
  for (Placement& p : placements_) p.to_world = relative_to(scene.origin, p.to_world);
  const glm::dmat4 camera = description_.camera ? description_.camera->camera_to_world : glm::dmat4(1);
  scene.camera.to_world = Transform::from_matrix(relative_to(scene.origin, camera));
}

// Vertices given in double may lie as far from their shape's own origin as the scene does from the world's.
// They are rounded relative to the scene's origin, or to an origin of their object, which all its shapes have
// in common so that coinciding vertices still coincide.
void Builder::move_inline_meshes(const std::vector<ExactBounds>& of_item, const glm::dvec3& origin) {
  std::vector<ExactBounds> of_object(description_.objects.size());
  for (size_t i = 0; i < items_.size(); ++i)
    if (items_[i].object)
      of_object[*items_[i].object].add(mapped(items_[i].description->object_to_world, of_item[i]));
  parallel::for_index(size_t{0}, items_.size(), [&](size_t i) {
    Item& item = items_[i];
    const glm::dvec3 around = item.object ? local_origin(of_object[*item.object]) : origin;
    if (!item.description->find("P") || around == glm::dvec3(0)) return;
    const glm::dmat4 to_mesh = glm::inverse(item.description->object_to_world);
    // Not reported: a mesh that is tiny in the world may exceed the range of floats here, which is one
    // warning more, and stays as it was.
    DiagnosticList beyond_floats;
    auto moved = make_source(item, glm::dvec3(to_mesh * glm::dvec4(around, 1)), beyond_floats);
    if (moved && beyond_floats.entries().size() == item.messages) item.source = std::move(moved);
  });
}

void Builder::build_lights(Scene& scene) {
  for (const LightDescription& light : description_.lights) {
    const TypeSpec* spec = find_type(category("LightSource"), light, diagnostics_);
    if (!spec || !check_parameters("light", *spec, light, warned_, diagnostics_)) continue;
    if (!is_usable_transform(light.light_to_world)) {
      diagnostics_.error(light.location, "the transform of this light cannot be inverted");
      continue;
    }
    const auto row = std::find_if(light_rows().begin(), light_rows().end(),
                                  [&](const LightRow& r) { return &r.spec == spec; });
    auto made = row->make(
        {ParameterReader(light, *spec), light.light_to_world, scene.origin, light_images_, diagnostics_});
    const MediumIndex medium = media_->resolve(light.medium, diagnostics_);
    if (!made || !is_power(power(*made), light.location, diagnostics_)) continue;
    scene.lights.push_back(std::move(*made));
    scene.light_media.push_back(medium);
  }
}

void Builder::share_meshes() {
  for (const Placement& placement : placements_) ++items_[placement.item].placements;
  parallel::for_index(size_t{0}, items_.size(), [&](size_t i) {
    Item& item = items_[i];
    if (!pays_to_share(*item.source, item.placements)) return;
    item.shared = share_mesh(std::move(*item.source), item.description->reverse_orientation);
  });
}

// Reports problems found while placing a shape; returns false if nothing is left of it.
bool Builder::keep(const Placement& placement, PlacedShape& placed) {
  const ShapeDescription& shape = *items_[placement.item].description;
  if (!placed.finite) {
    diagnostics_.error(shape.location, "the transform takes this shape beyond the range of floats");
    return false;
  }
  if (placed.without_area > 0)
    without_area_.add(placement.item, shape.location, placed.without_area,
                      placed.shape.mesh()->indices.size() + placed.without_area);
  return primitive_count(placed.shape) > 0;
}

std::string Builder::group_name(const ShapeDescription& shape) const {
  if (const Parameter* group = shape.find("surfacegroup")) return group->strings[0];
  if (!shape.name.empty()) return shape.name;
  if (!shape.location.valid()) return shape.type;
  const std::string_view file = diagnostics_.files.name(shape.location.file);
  if (shape.location.line == 0) return fmt::format("{} in {}", shape.type, file);
  return fmt::format("{} at {}:{}", shape.type, file, shape.location.line);
}

// Shapes with the same key form one named surface group; each instance of an object has groups of its own.
std::string Builder::group_key(const Placement& placement) const {
  const Item& item = items_[placement.item];
  const Parameter* group = item.description->find("surfacegroup");
  if (!group) return {};
  return item.object ? fmt::format("{}\n{}", group->strings[0], placement.instance) : group->strings[0];
}

void Builder::place(Scene& scene) {
  std::vector<PlacedShape> placed(placements_.size());
  parallel::for_index(size_t{0}, placements_.size(), [&](size_t i) {
    const Placement& p = placements_[i];
    Item& item = items_[p.item];
    if (item.shared) {
      placed[i] = place_instance(*item.shared, p.to_world, item.description->reverse_orientation);
      return;
    }
    // Only the placement of a Shape line in the world is marked `last`, and it is the item's only one, so no
    // other thread reads the source.
    ShapeSource source = p.last ? std::move(*item.source) : *item.source;
    placed[i] = place_shape(std::move(source), p.to_world, item.description->reverse_orientation);
  });
  std::vector<std::string> names;
  std::vector<std::string> places;
  auto interfaces = std::make_shared<Scene>();
  for (size_t i = 0; i < placed.size(); ++i) {
    const Item& item = items_[placements_[i].item];
    Shape& shape = placed[i].shape;
    if (!keep(placements_[i], placed[i])) continue;
    shape.media = item.media;
    if (item.material == MaterialTable::kInterface) {
      interfaces->bounds.add(bounds_of(shape));
      interfaces->shapes.push_back(std::move(shape));
      continue;
    }
    shape.material = item.material;
    shape.alpha = item.alpha;
    shape.alpha_texture = item.alpha_texture;
    if (placements_[i].light && !lights_->make(*item.description, shape, scene.lights)) continue;
    if (placements_[i].light && fills_memory(shape.mesh(), *item.description, diagnostics_)) return;
    scene.light_media.resize(scene.lights.size(), item.media.outside);
    names.push_back(group_key(placements_[i]));
    places.push_back(group_name(*item.description));
    scene.shapes.push_back(std::move(shape));
  }
  if (!interfaces->shapes.empty()) scene.interfaces = std::move(interfaces);
  without_area_.report(diagnostics_);
  scene.surface_group_names.resize(assign_surface_groups(scene.shapes, names));
  for (size_t i = scene.shapes.size(); i-- > 0;)
    scene.surface_group_names[scene.shapes[i].surface_group] = places[i];
}

}  // namespace

std::optional<Scene> build_scene(const SceneDescription& description, const MeshLoader& load_mesh,
                                 Diagnostics& diagnostics, const LightImageLoader& load_light_image,
                                 const ImageLoader& images) {
  return Builder(description, load_mesh, diagnostics, load_light_image, images).build();
}

}  // namespace kaustik
