// Directives for transforms and for settings of the whole scene.

#include <fmt/format.h>

#include <algorithm>

#include "apps/import/pbrt/parameter_parser.h"
#include "apps/import/pbrt/realistic_camera.h"
#include "apps/import/pbrt/scene_parser.h"
#include "apps/import/pbrt/transforms.h"
#include "core/diagnostics/nearest_name.h"
#include "core/scene/schema/schema.h"

namespace kaustik::pbrt {

void SceneParser::on_identity(const Token&) {
  set_transform(glm::dmat4(1));
}

void SceneParser::on_translate(const Token& word) {
  const auto v = parse_numbers(*tokens_, 3, word.text, diagnostics_);
  v ? concat(translate(*v)) : skip_arguments();
}

void SceneParser::on_scale(const Token& word) {
  const auto v = parse_numbers(*tokens_, 3, word.text, diagnostics_);
  v ? concat(scale(*v)) : skip_arguments();
}

void SceneParser::on_rotate(const Token& word) {
  const auto v = parse_numbers(*tokens_, 4, word.text, diagnostics_);
  if (!v) return skip_arguments();
  const auto m = rotate(*v);
  if (!m) return diagnostics_.error(word.location, "the axis of `Rotate` has length zero");
  concat(*m);
}

void SceneParser::on_look_at(const Token& word) {
  const auto v = parse_numbers(*tokens_, 9, word.text, diagnostics_);
  if (!v) return skip_arguments();
  if (const auto m = look_at(*v)) return concat(*m);
  // The axis that lies farthest from the view is a valid up vector unless there is no view.
  std::vector<double> turned = *v;
  const glm::dvec3 view =
      glm::abs(glm::dvec3(turned[3] - turned[0], turned[4] - turned[1], turned[5] - turned[2]));
  const size_t axis = view.y <= view.x && view.y <= view.z ? 1 : view.z <= view.x ? 2 : 0;
  for (size_t k = 0; k < 3; ++k) turned[6 + k] = k == axis ? 1 : 0;
  const auto m = look_at(turned);
  if (!m) return diagnostics_.error(word.location, "`LookAt` needs an eye and another point to look at");
  diagnostics_.warning(
      word.location,
      fmt::format("the up vector of `LookAt` points along the view or is zero: +{} is up", "xyz"[axis]));
  concat(*m);
}

void SceneParser::on_transform(const Token& word) {
  const auto v = parse_numbers(*tokens_, 16, word.text, diagnostics_);
  v ? set_transform(matrix(*v)) : skip_arguments();
}

void SceneParser::on_concat_transform(const Token& word) {
  const auto v = parse_numbers(*tokens_, 16, word.text, diagnostics_);
  v ? concat(matrix(*v)) : skip_arguments();
}

void SceneParser::on_coordinate_system(const Token& word) {
  const auto name = in_quotes("a name", word);
  if (name) coordinate_systems_[unescape(name->text)] = state_.ctm;
}

void SceneParser::on_coord_sys_transform(const Token& word) {
  const auto name = in_quotes("a name", word);
  if (!name) return;
  const auto found = coordinate_systems_.find(name->text);
  if (found != coordinate_systems_.end()) {
    set_transform(found->second);
    return;
  }
  const auto names = [&] { return keys_of(coordinate_systems_); };
  repeated_.say_one_of(fmt::format("coordinate system/{}", name->text), name->location,
                       fmt::format("no coordinate system is named `{}`: the transform stays as it is{}",
                                   name->text, diagnostics_.hint(name->text, names)));
}

void SceneParser::on_active_transform(const Token& word) {
  const Token which = tokens_->peek();
  const bool known = which.text == "All" || which.text == "StartTime" || which.text == "EndTime";
  if (which.is(TokenKind::kWord) && known) tokens_->next();
  if (!known) {
    diagnostics_.error(word.location, "`ActiveTransform` needs All, StartTime or EndTime");
    return skip_arguments();
  }
  state_.at_end_time = which.text == "EndTime";
  if (which.text != "All")
    warn_once(word, "motion is not rendered: everything stays where it is when the shutter opens");
}

void SceneParser::on_transform_times(const Token& word) {
  if (!parse_numbers(*tokens_, 2, word.text, diagnostics_)) return skip_arguments();
  diagnostics_.warning(word.location, "`TransformTimes` is ignored: motion is not rendered");
}

void SceneParser::on_camera(const Token& word) {
  CameraDescription camera;
  if (!read_directive(word, "camera", camera)) return;
  camera.camera_to_world = inverse_transform(state_.ctm);
  camera.medium = state_.media.outside;
  coordinate_systems_["camera"] = camera.camera_to_world;
  if (scene_.camera) {
    diagnostics_.warning(word.location, "this `Camera` replaces an earlier one",
                         {{scene_.camera->location, "the earlier one"}});
  }
  scene_.camera = std::move(camera);
}

void SceneParser::on_setting(const Token& word) {
  Directive setting;
  if (!read_directive(word, word.text, setting)) return;
  std::optional<Directive>& slot = word.text == "Film"          ? scene_.film
                                   : word.text == "Sampler"     ? scene_.sampler
                                   : word.text == "PixelFilter" ? scene_.filter
                                   : word.text == "Integrator"  ? scene_.integrator
                                                                : scene_.accelerator;
  if (slot) {
    diagnostics_.warning(word.location, fmt::format("this `{}` replaces an earlier one", word.text),
                         {{slot->location, "the earlier one"}});
  }
  slot = std::move(setting);
}

// Reads `Option "seed" 3` or, with its type, `Option "integer seed" 3`. Dashes, underscores and case are
// ignored.
void SceneParser::on_option(const Token& word) {
  const auto declaration = in_quotes("a name", word);
  if (!declaration) return;
  Parameter p;
  p.location = declaration->location;
  const std::string text = unescape(declaration->text);
  const size_t blank = text.find_first_of(" \t");
  for (const char c : blank == text.npos ? text : text.substr(text.find_last_of(" \t") + 1)) {
    if (c != '-' && c != '_') p.name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  const ParameterSpec* spec = option_type().find(p.name);
  if (spec) p.type = spec->types.front();
  if (blank != text.npos) p.type = parameter_type(std::string_view(text).substr(0, blank)).value_or(p.type);
  if (!spec) {
    std::vector<std::string_view> names;
    for (const ParameterSpec& known : option_type().parameters) names.push_back(known.name);
    repeated_.say_one_of("option/" + p.name, p.location,
                         fmt::format("unknown option `{}` is ignored{}", p.name, name_hint(p.name, names)));
    return skip_arguments();
  }
  if (parse_values(*tokens_, p, diagnostics_)) scene_.options.push_back(std::move(p));
}

void SceneParser::on_color_space(const Token& word) {
  const auto name = in_quotes("a name", word);
  if (!name) return;
  if (const ColourSpace* space = find_colour_space(unescape(name->text))) {
    state_.colour_space = space;
    return;
  }
  std::vector<std::string_view> names;
  for (const ColourSpace& space : colour_spaces()) names.push_back(space.name);
  repeated_.say_one_of(fmt::format("color space/{}", name->text), name->location,
                       fmt::format("unknown color space \"{}\": \"{}\" remains{}", name->text,
                                   state_.colour_space->name, name_hint(name->text, names)));
}

void SceneParser::on_world_end(const Token& word) {
  world_ended_ = in_world_ && open_files_.size() == 1;
  if (!world_ended_)
    diagnostics_.warning(word.location, "this `WorldEnd` is ignored: it ends no `WorldBegin`");
}

// Directives of pbrt-v2 that later versions do not have. Their arguments are skipped.
void SceneParser::on_v2(const Token& word) {
  repeated_.say_one_of("v2", word.location,
                       fmt::format("`{}` makes this a file of pbrt-v2: it is read as one of pbrt-v3, without "
                                   "integrators, renderers and volumes",
                                   word.text));
  skip_arguments();
}

void SceneParser::on_world_begin(const Token& word) {
  if (in_world_) return diagnostics_.error(word.location, "this is a second `WorldBegin`");
  if (scene_.camera && scene_.camera->type == "realistic") {
    const auto open = [this](const std::string& name) { return open_beside(name); };
    replace_realistic_camera(*scene_.camera, scene_.film ? &*scene_.film : nullptr, open, diagnostics_);
  }
  in_world_ = true;
  state_.ctm = glm::dmat4(1);
  coordinate_systems_["world"] = state_.ctm;
}

}  // namespace kaustik::pbrt
