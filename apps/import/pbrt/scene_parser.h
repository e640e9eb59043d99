#pragma once
// Parses a pbrt scene: executes its directives, which fill a SceneDescription.

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "apps/import/common/scene_files.h"
#include "apps/import/pbrt/colours.h"
#include "apps/import/pbrt/curves/curve_collector.h"
#include "apps/import/pbrt/graphics_state.h"
#include "apps/import/pbrt/repair/repairs.h"
#include "apps/import/pbrt/tokenizer.h"
#include "apps/import/pbrt/v3/upgrader.h"
#include "core/scene/description/description.h"

namespace kaustik::pbrt {

class SceneParser {
 public:
  SceneParser(std::filesystem::path main_file, SceneFiles& files, Diagnostics& diagnostics)
      : main_file_(std::move(main_file)),
        files_(files),
        diagnostics_(diagnostics),
        colours_([this](const std::string& name) { return open_beside(name); }, diagnostics),
        v3_(diagnostics) {}

  // Reads a whole scene. After an error, parsing continues at the next directive.
  SceneDescription parse(uint32_t file);

 private:
  using Handler = void (SceneParser::*)(const Token& word);
  enum class Block { kOptions, kWorld, kAny };
  struct Entry {
    Handler handler;
    Block block;
  };
  struct Open {
    bool object;
    SourceLocation location;
    GraphicsState state;
  };
  static const std::map<std::string_view, Entry>& directives();

  void parse_file(uint32_t file);
  void run(const Token& word);
  void skip_arguments();
  void report_unknown(const Token& word);
  void finish(const SourceLocation& end);

  // Helpers that read the arguments of directives.
  std::optional<Token> in_quotes(std::string_view what, const Token& word);
  bool read_directive(const Token& word, std::string_view target, Directive& out);
  // Of a named material or medium: what was read as its type is its name; the type is a parameter. False,
  // with an error, if there is none.
  bool take_type(std::string_view what, std::string_view example, Directive& directive, std::string& name,
                 SourceLocation& name_location);
  void add_defaults(std::string_view target, std::vector<Parameter>& parameters);
  OpenedText open_beside(const std::string& name) const;
  void concat(const glm::dmat4& m) { set_transform(state_.ctm * m); }
  void set_transform(const glm::dmat4& m) {
    if (!state_.at_end_time) state_.ctm = m;
  }
  void warn_once(const Token& word, std::string message);

  // Names that are defined more than once (scene_names.cpp).
  std::string define(std::string_view what, const std::string& name, const SourceLocation& where,
                     std::set<std::string>& known, LaterNames& later);
  void resolve_names(std::string_view word, Directive& directive, bool of_float_texture = false) const;
  void leave_out_unknown_textures(Directive& directive);

  // Materials of pbrt-v3 that are more than one of ours (scene_v3_extras.cpp).
  void add_material(MaterialDescription material);
  void add_opacity(const MaterialDescription& material, Parameter opacity);
  std::optional<Parameter> alpha_of(const Parameter& opacity);
  void apply_opacity(ShapeDescription& shape) const;

  // Handlers of transforms (scene_parser_transforms.cpp).
  void on_identity(const Token& word);
  void on_translate(const Token& word);
  void on_scale(const Token& word);
  void on_rotate(const Token& word);
  void on_look_at(const Token& word);
  void on_transform(const Token& word);
  void on_concat_transform(const Token& word);
  void on_coordinate_system(const Token& word);
  void on_coord_sys_transform(const Token& word);
  void on_active_transform(const Token& word);
  void on_transform_times(const Token& word);

  // Handlers of settings of the whole scene (scene_parser_transforms.cpp).
  void on_camera(const Token& word);
  void on_setting(const Token& word);
  void on_option(const Token& word);
  void on_color_space(const Token& word);
  void on_world_begin(const Token& word);
  void on_world_end(const Token& word);
  void on_v2(const Token& word);

  // Handlers of blocks and of the graphics state.
  void on_attribute_begin(const Token& word);
  void on_attribute_end(const Token& word);
  void on_attribute(const Token& word);
  void on_reverse_orientation(const Token& word);
  void on_object_begin(const Token& word);
  void on_object_end(const Token& word);
  void on_object_instance(const Token& word);
  void push(bool object, const SourceLocation& where);
  void pop(bool object, const Token& word);

  // Handlers of the world's contents (scene_parser_world.cpp).
  void on_texture(const Token& word);
  void on_material(const Token& word);
  void on_make_named_material(const Token& word);
  void on_named_material(const Token& word);
  void on_area_light(const Token& word);
  void on_light(const Token& word);
  void on_shape(const Token& word);
  void on_include(const Token& word);
  void on_import(const Token& word);
  void on_make_named_medium(const Token& word);
  void on_medium_interface(const Token& word);
  void include(const Token& word, bool keep_state);
  // Whether a text begins with a directive and something that may follow it, or is empty. Messages quote
  // lines of such texts alone: a scene may name any file.
  static bool begins_as_scene(std::string_view text);

  std::filesystem::path main_file_;
  SceneFiles& files_;
  Diagnostics& diagnostics_;
  ColourReducer colours_;
  V3Upgrader v3_;
  CountedWarnings repeated_;
  Repairs repairs_{repeated_};
  CurveCollector curves_{repeated_};
  SceneDescription scene_;
  GraphicsState state_;
  std::vector<Open> stack_;
  std::map<std::string, glm::dmat4, std::less<>> coordinate_systems_;
  // `alpha` for the shapes of a material, by its index.
  std::map<size_t, Parameter> alpha_of_material_;
  std::map<std::string, size_t, std::less<>> seen_through_;  // indices of named materials that have an alpha
  LaterNames objects_;  // the unique name of the last definition of each object
  std::set<std::string> float_textures_, spectrum_textures_, materials_;  // names defined so far
  std::set<std::string> warned_;
  std::optional<size_t> open_object_;
  bool in_world_ = false;
  bool world_ended_ = false;
  bool misses_world_begin_ = false;  // and this has been reported
  bool stopped_ = false;             // after too many errors or too large includes
  uint64_t ignored_pushes_ = 0;      // open blocks beyond the nesting limit
  uint64_t bytes_read_ = 0;
  uint64_t files_included_ = 0;
  std::vector<uint32_t> open_files_;
  Tokenizer* tokens_ = nullptr;  // of the innermost open file
};

}  // namespace kaustik::pbrt
