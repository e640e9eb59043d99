// Directives for materials, lights, shapes, objects and included files.

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "apps/import/pbrt/parameter_parser.h"
#include "apps/import/pbrt/scene_parser.h"

namespace kaustik::pbrt {
namespace {

constexpr size_t kDeepestInclude = 64;
// Limits of the total: files that each include the next one twice grow exponentially before they are deep.
constexpr uint64_t kMostBytes = uint64_t{8} << 30;
constexpr uint64_t kMostIncludes = 100'000;

}  // namespace

void SceneParser::on_texture(const Token& word) {
  TextureDescription texture;
  const auto name = in_quotes("a name", word);
  if (!name) return;
  const auto value_type = in_quotes("its type, \"float\" or \"spectrum\",", word);
  if (!value_type || !read_directive(word, "texture", texture)) return;
  texture.value_type = unescape(value_type->text);
  if (texture.value_type == "color") texture.value_type = "spectrum";  // pbrt-v3's name of it
  if (texture.value_type != "float" && texture.value_type != "spectrum") {
    repeated_.say_one_of("texture's type", value_type->location,
                         fmt::format("a texture is \"float\" or \"spectrum\": \"{}\" is read as \"spectrum\"",
                                     texture.value_type.substr(0, 60)));
    texture.value_type = "spectrum";
  }
  const bool is_float = texture.value_type == "float";
  resolve_names("Texture", texture, is_float);
  texture.name =
      define("texture", unescape(name->text), name->location, is_float ? float_textures_ : spectrum_textures_,
             is_float ? state_.float_textures : state_.spectrum_textures);
  texture.name_location = name->location;
  texture.value_type_location = value_type->location;
  colours_.reduce("Texture", *state_.colour_space, texture);
  texture.texture_to_world = state_.ctm;
  scene_.textures.push_back(std::move(texture));
}

void SceneParser::on_material(const Token& word) {
  MaterialDescription material;
  if (!read_directive(word, "material", material)) return;
  const SourceLocation where = material.location;
  add_material(std::move(material));
  state_.material = {static_cast<uint32_t>(scene_.materials.size() - 1), {}, where};
}

bool SceneParser::take_type(std::string_view what, std::string_view example, Directive& directive,
                            std::string& name, SourceLocation& name_location) {
  name = std::exchange(directive.type, {});
  name_location = directive.type_location;
  const Parameter* type = directive.find("type");
  if (!type || type->strings.size() != 1) {
    diagnostics_.error(name_location,
                       fmt::format("{} `{}` needs its type: \"string type\" \"{}\"", what, name, example));
    return false;
  }
  directive.type = type->strings[0];
  directive.type_location = type->value_location(0);
  std::erase_if(directive.parameters, [](const Parameter& p) { return p.name == "type"; });
  return true;
}

void SceneParser::on_make_named_material(const Token& word) {
  MaterialDescription material;
  if (!read_directive(word, "material", material)) return;
  if (!take_type("material", "diffuse", material, material.name, material.name_location)) return;
  v3_.upgrade("Material", material);
  resolve_names("Material", material);
  repairs_.repair("Material", material);
  material.name = define("material", material.name, material.name_location, materials_, state_.materials);
  add_material(std::move(material));
}

void SceneParser::on_named_material(const Token& word) {
  const auto name = in_quotes("a name", word);
  if (!name) return;
  std::string text = unescape(name->text);
  if (const auto later = state_.materials.find(text); later != state_.materials.end()) text = later->second;
  state_.material = {std::nullopt, std::move(text), name->location};
}

void SceneParser::on_area_light(const Token& word) {
  Directive light;
  if (!read_directive(word, "light", light)) return;
  colours_.reduce(word.text, *state_.colour_space, light);
  state_.area_light = static_cast<uint32_t>(scene_.area_lights.size());
  scene_.area_lights.push_back(std::move(light));
}

void SceneParser::on_light(const Token& word) {
  LightDescription light;
  if (!read_directive(word, "light", light)) return;
  colours_.reduce(word.text, *state_.colour_space, light);
  light.light_to_world = state_.ctm;
  // For lights at infinity the transform only turns directions. Scenes may contain any translation there, as
  // pbrt ignores it.
  if (light.type == "infinite" || light.type == "distant")
    light.light_to_world = glm::dmat4(glm::dmat3(state_.ctm));
  light.medium = state_.media.outside;
  scene_.lights.push_back(std::move(light));
}

void SceneParser::on_shape(const Token& word) {
  ShapeDescription shape;
  if (!read_directive(word, "shape", shape)) return;
  for (const std::string_view name : {"P", "indices"}) {
    const Parameter* p = shape.find(name);
    if (!p || p->count() > 0) continue;
    return repeated_.say_one_of("empty mesh", shape.location,
                                fmt::format("a shape with an empty list `{}` is left out", name));
  }
  shape.object_to_world = state_.ctm;
  shape.reverse_orientation = state_.reverse_orientation;
  shape.material = state_.material;
  shape.area_light = state_.area_light;
  shape.media = state_.media;
  apply_opacity(shape);
  if (shape.type == "curve") return curves_.add(shape, open_object_);
  (open_object_ ? scene_.objects[*open_object_].shapes : scene_.shapes).push_back(std::move(shape));
}

void SceneParser::on_object_begin(const Token& word) {
  const auto name = in_quotes("a name", word);
  if (!name) return;
  push(true, word.location);
  if (open_object_) {
    diagnostics_.error(word.location, "an object cannot contain another one",
                       {{scene_.objects[*open_object_].location, "the outer one"}});
    return;
  }
  const std::string text = unescape(name->text);
  const auto [found, is_new] = objects_.emplace(text, text);
  if (!is_new) {
    found->second = fmt::format("{} ({})", text, scene_.objects.size());
    repeated_.say_one_of(
        "object", name->location,
        fmt::format("object `{}` is defined again: later instances show this definition", text));
  }
  open_object_ = scene_.objects.size();
  scene_.objects.push_back({found->second, name->location, {}});
}

void SceneParser::on_object_end(const Token& word) {
  const size_t open = stack_.size();
  pop(true, word);
  const bool inside_another =
      std::any_of(stack_.begin(), stack_.end(), [](const Open& o) { return o.object; });
  if (stack_.size() < open && !inside_another) open_object_.reset();
}

void SceneParser::on_object_instance(const Token& word) {
  const auto name = in_quotes("a name", word);
  if (!name) return;
  if (open_object_) {
    return repeated_.say_one_of("nested instance", word.location,
                                "an object cannot contain an instance, which is left out as in pbrt");
  }
  const std::string text = unescape(name->text);
  const auto last = objects_.find(text);
  scene_.instances.push_back({last == objects_.end() ? text : last->second, name->location, state_.ctm});
}

void SceneParser::on_include(const Token& word) {
  include(word, true);
}

void SceneParser::on_import(const Token& word) {
  include(word, false);
}

OpenedText SceneParser::open_beside(const std::string& name) const {
  const std::filesystem::path naming(diagnostics_.files.name(open_files_.back()));
  return files_.open(find_named_file(diagnostics_.files.root(), name, naming, main_file_));
}

bool SceneParser::begins_as_scene(std::string_view text) {
  DiagnosticList unsaid;
  Tokenizer tokens(kNoFile, text, unsaid);
  const auto is_directive = [](const Token& t) {
    return t.is(TokenKind::kWord) && directives().contains(t.text);
  };
  const Token first = tokens.next(), second = tokens.next();
  if (!is_directive(first)) return first.is(TokenKind::kEnd);
  return !second.is(TokenKind::kWord) || is_directive(second) || first.text == "ActiveTransform";
}

void SceneParser::include(const Token& word, bool keep_state) {
  const auto name = in_quotes("a file name", word);
  if (!name) return;
  if (open_files_.size() >= kDeepestInclude) {
    return diagnostics_.error(name->location, fmt::format("more than {} nested includes", kDeepestInclude));
  }
  const OpenedText opened = open_beside(unescape(name->text));
  if (!opened.file) return diagnostics_.error(name->location, opened.error);
  const uint32_t file = *opened.file;
  if (std::find(open_files_.begin(), open_files_.end(), file) != open_files_.end()) {
    return diagnostics_.error(name->location,
                              fmt::format("\"{}\" includes itself", diagnostics_.files.name(file)));
  }
  if (!begins_as_scene(diagnostics_.files.text(file)))
    return diagnostics_.error(name->location,
                              fmt::format("\"{}\" is not a pbrt scene: it does not begin with a directive",
                                          diagnostics_.files.name(file)));
  bytes_read_ += diagnostics_.files.text(file).size() + 1;
  if (bytes_read_ > kMostBytes || ++files_included_ > kMostIncludes) {
    if (!stopped_)
      diagnostics_.error(name->location,
                         "the included files are too many or too large in total: reading stops here");
    stopped_ = true;
    return;
  }
  const GraphicsState before = state_;
  parse_file(file);
  if (!keep_state) state_ = before;
}

void SceneParser::on_make_named_medium(const Token& word) {
  MediumDescription medium;
  if (!read_directive(word, "medium", medium)) return;
  if (!take_type("medium", "homogeneous", medium, medium.name, medium.name_location)) return;
  v3_.upgrade(word.text, medium);
  repairs_.repair(word.text, medium);
  colours_.reduce(word.text, *state_.colour_space, medium);
  medium.medium_to_world = state_.ctm;
  scene_.media.push_back(std::move(medium));
}

// One name stands for both sides.
void SceneParser::on_medium_interface(const Token& word) {
  const auto inside = in_quotes("the medium inside", word);
  if (!inside) return;
  state_.media.inside = {unescape(inside->text), inside->location};
  state_.media.outside = state_.media.inside;
  if (!tokens_->peek().is(TokenKind::kString)) return;
  const Token outside = tokens_->next();
  state_.media.outside = {unescape(outside.text), outside.location};
}

}  // namespace kaustik::pbrt
