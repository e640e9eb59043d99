#pragma once
// A scene as it was written: plain data, independent of any file format, with the location of every value.
// Nothing is checked or interpreted here; build_scene does that according to core/scene/schema/schema.h.

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics/source_location.h"

namespace kaustik {

enum class ParameterType {
  kFloat,
  kInteger,
  kBool,
  kString,
  kPoint2,
  kVector2,
  kPoint3,
  kVector3,
  kNormal,
  kRgb,
  kSpectrum,
  kBlackbody,
  kTexture
};
// The word used in scene files: "float", "point3" and so on.
std::string_view parameter_type_name(ParameterType type);

// One typed parameter, for example "rgb L" [ 17 12 4 ].
struct Parameter {
  ParameterType type = ParameterType::kFloat;
  std::string name;
  SourceLocation location;  // of the declaration "type name"
  // The values: numbers for float, integer (exact up to 2^53), bool (0, 1), points, vectors, normals, rgb,
  // blackbody and sampled spectra; strings for string, texture and named spectra. One of the two is empty.
  std::vector<double> numbers;
  std::vector<std::string> strings;
  std::vector<LineColumn> value_places;  // location of each value
  // A default from an enclosing block, which shapes ignore if they do not know it.
  bool inherited = false;

  size_t count() const { return numbers.size() + strings.size(); }
  // Whether these are positions or normals of a mesh or curve. NaN among them concerns only the faces there.
  bool may_have_holes() const;
  // Location of value i, or of the declaration if there is no such value.
  SourceLocation value_location(size_t i) const;
};

// A directive with a type and parameters, for example Shape "sphere" "float radius" 2.
struct Directive {
  std::string type;
  SourceLocation location;       // of the directive's keyword
  SourceLocation type_location;  // of the quoted type
  std::vector<Parameter> parameters;
  bool incomplete = false;  // invalid parameters, which have been reported, were left out

  // Null if there is no parameter of this name.
  const Parameter* find(std::string_view name) const;
  Parameter* find(std::string_view name);
};

// A participating medium.
struct MediumDescription : Directive {
  std::string name;
  SourceLocation name_location;
  glm::dmat4 medium_to_world{1};
};

// A medium by its name, which may be defined later. Without a name: the vacuum.
struct MediumReference {
  std::string name;
  SourceLocation location;
};

// The media on the two sides of a surface.
struct MediaReference {
  MediumReference inside, outside;
};

struct CameraDescription : Directive {
  glm::dmat4 camera_to_world{1};
  MediumReference medium;
};

// A texture; Directive::type is its class, for example "imagemap".
struct TextureDescription : Directive {
  std::string name;
  SourceLocation name_location;
  std::string value_type;  // "float" or "spectrum"
  SourceLocation value_type_location;
  glm::dmat4 texture_to_world{1};
};

struct MaterialDescription : Directive {
  std::string name;  // empty for a material set in place
  SourceLocation name_location;
};

// How a shape refers to its material: in place (by index), by a name that may be defined later, or not at all
// (the default material).
struct MaterialReference {
  std::optional<uint32_t> index;  // into SceneDescription::materials
  std::string name;
  SourceLocation location;
};

struct ShapeDescription : Directive {
  std::string name;  // what its file calls it, if that has names for shapes
  glm::dmat4 object_to_world{1};
  bool reverse_orientation = false;
  MaterialReference material;
  std::optional<uint32_t> area_light;  // into SceneDescription::area_lights
  MediaReference media;
};

struct LightDescription : Directive {
  glm::dmat4 light_to_world{1};
  MediumReference medium;  // in which it shines
};

// Shapes that exist only through instances.
struct ObjectDescription {
  std::string name;
  SourceLocation location;
  std::vector<ShapeDescription> shapes;
};

struct InstanceDescription {
  std::string object;
  SourceLocation location;  // of the name
  // Applied after the transforms of the shapes.
  glm::dmat4 instance_to_world{1};
};

// What the animations of a file change.
struct SceneAnimation {
  double seconds = 0;        // time of the last key
  bool moves_world = false;  // more than the camera: shapes or lights
};

// A complete scene. Matrices apply to column vectors; the order is that of the files.
struct SceneDescription {
  SourceLocation location;  // the main file
  std::optional<CameraDescription> camera;
  std::optional<Directive> film, sampler, filter, integrator, accelerator;
  std::vector<Parameter> options;
  std::vector<TextureDescription> textures;
  std::vector<MaterialDescription> materials;
  std::vector<MediumDescription> media;
  std::vector<Directive> area_lights;
  std::vector<ShapeDescription> shapes;
  std::vector<LightDescription> lights;
  std::vector<ObjectDescription> objects;
  std::vector<InstanceDescription> instances;
  std::optional<SceneAnimation> animation;  // unset for scenes without animations
  // Images of textures that cannot be read give a warning, and grey in their place, instead of an error.
  bool grey_for_unreadable_images = false;
  // What became of the file that a user may want to know, one sentence each, for the log.
  std::vector<std::string> notes;
  // Owner of temporary files that the description names, such as images that were embedded in a scene file.
  std::shared_ptr<const void> keeps;
};

}  // namespace kaustik
