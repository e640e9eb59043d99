#include "apps/import/pbrt/scene_parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "apps/import/pbrt/parameter_parser.h"
#include "core/diagnostics/nearest_name.h"
#include "core/scene/schema/schema.h"

namespace kaustik::pbrt {
namespace {

// Parsing stops after this many errors: the file is not a scene.
constexpr size_t kMostErrors = 1000;
constexpr size_t kMostNestedBlocks = 10'000;
constexpr size_t kMostUnclosed = 10;  // reported at the end of the file
// Values of a default set by `Attribute`: it is copied into every shape that it applies to.
constexpr size_t kLongestDefault = 1024;

// Of several parameters with one name, keeps the last, as pbrt does, and warns.
void keep_last_ones(std::vector<Parameter>& parameters, DiagnosticList& diagnostics) {
  for (size_t i = parameters.size(); i-- > 0;) {
    const auto first = std::find_if(parameters.begin(), parameters.end(),
                                    [&](const Parameter& p) { return p.name == parameters[i].name; });
    if (first == parameters.begin() + std::ptrdiff_t(i)) continue;
    diagnostics.warning(parameters[i].location, fmt::format("this `{}` replaces an earlier one", first->name),
                        {{first->location, "the earlier one"}});
    parameters.erase(first);
  }
}

}  // namespace

const std::map<std::string_view, SceneParser::Entry>& SceneParser::directives() {
  using P = SceneParser;
  constexpr Block kOptions = Block::kOptions;
  constexpr Block kWorld = Block::kWorld;
  constexpr Block kAny = Block::kAny;
  static const std::map<std::string_view, Entry> table = {
      {"Accelerator", {&P::on_setting, kOptions}},
      {"ActiveTransform", {&P::on_active_transform, kAny}},
      {"AreaLightSource", {&P::on_area_light, kWorld}},
      {"Attribute", {&P::on_attribute, kAny}},
      {"AttributeBegin", {&P::on_attribute_begin, kWorld}},
      {"AttributeEnd", {&P::on_attribute_end, kWorld}},
      {"Camera", {&P::on_camera, kOptions}},
      {"ColorSpace", {&P::on_color_space, kAny}},
      {"ConcatTransform", {&P::on_concat_transform, kAny}},
      {"CoordSysTransform", {&P::on_coord_sys_transform, kAny}},
      {"CoordinateSystem", {&P::on_coordinate_system, kAny}},
      {"Film", {&P::on_setting, kOptions}},
      {"Identity", {&P::on_identity, kAny}},
      {"Import", {&P::on_import, kWorld}},
      {"Include", {&P::on_include, kAny}},
      {"Integrator", {&P::on_setting, kOptions}},
      {"LightSource", {&P::on_light, kWorld}},
      {"LookAt", {&P::on_look_at, kAny}},
      {"MakeNamedMaterial", {&P::on_make_named_material, kWorld}},
      {"MakeNamedMedium", {&P::on_make_named_medium, kAny}},
      {"Material", {&P::on_material, kWorld}},
      {"MediumInterface", {&P::on_medium_interface, kAny}},
      {"NamedMaterial", {&P::on_named_material, kWorld}},
      {"ObjectBegin", {&P::on_object_begin, kWorld}},
      {"ObjectEnd", {&P::on_object_end, kWorld}},
      {"ObjectInstance", {&P::on_object_instance, kWorld}},
      {"Option", {&P::on_option, kOptions}},
      {"PixelFilter", {&P::on_setting, kOptions}},
      {"Renderer", {&P::on_v2, kAny}},
      {"ReverseOrientation", {&P::on_reverse_orientation, kWorld}},
      {"Rotate", {&P::on_rotate, kAny}},
      {"Sampler", {&P::on_setting, kOptions}},
      {"Scale", {&P::on_scale, kAny}},
      {"Shape", {&P::on_shape, kWorld}},
      {"SurfaceIntegrator", {&P::on_v2, kAny}},
      {"Texture", {&P::on_texture, kWorld}},
      {"Transform", {&P::on_transform, kAny}},
      // As in pbrt, these two save and restore the whole state.
      {"TransformBegin", {&P::on_attribute_begin, kAny}},
      {"TransformEnd", {&P::on_attribute_end, kAny}},
      {"TransformTimes", {&P::on_transform_times, kOptions}},
      {"Translate", {&P::on_translate, kAny}},
      {"Volume", {&P::on_v2, kAny}},
      {"VolumeIntegrator", {&P::on_v2, kAny}},
      {"WorldBegin", {&P::on_world_begin, kAny}},
      {"WorldEnd", {&P::on_world_end, kWorld}},
  };
  return table;
}

SceneDescription SceneParser::parse(uint32_t file) {
  scene_.location = {file, 0, 0};
  parse_file(file);
  finish(scene_.location);
  return std::move(scene_);
}

void SceneParser::finish(const SourceLocation& end) {
  curves_.finish(scene_);
  repeated_.report(diagnostics_);
  if (stopped_) return;
  if (!in_world_ && !misses_world_begin_) diagnostics_.error(end, "the file ends without `WorldBegin`");
  for (const Open& open : std::span(stack_).first(std::min(stack_.size(), kMostUnclosed))) {
    diagnostics_.warning(open.location, fmt::format("this block is not closed: expected `{}`",
                                                    open.object ? "ObjectEnd" : "AttributeEnd"));
  }
}

void SceneParser::parse_file(uint32_t file) {
  Tokenizer tokens(file, diagnostics_.files.text(file), diagnostics_);
  Tokenizer* const outer = std::exchange(tokens_, &tokens);
  open_files_.push_back(file);
  while (!stopped_) {
    const Token word = tokens.next();
    if (word.is(TokenKind::kEnd)) break;
    if (word.is(TokenKind::kWord)) {
      run(word);
    } else {
      diagnostics_.error(word.location,
                         fmt::format("expected a directive, not `{}`", word.text.substr(0, 60)));
      skip_arguments();
    }
    if (diagnostics_.entries().size() > kMostErrors && diagnostics_.error_count() > kMostErrors) {
      diagnostics_.error(word.location, "too many errors: reading stops here");
      stopped_ = true;
    }
  }
  open_files_.pop_back();
  tokens_ = outer;
}

void SceneParser::run(const Token& word) {
  const auto found = directives().find(word.text);
  if (found == directives().end()) {
    report_unknown(word);
    if (!tokens_->peek().is(TokenKind::kWord)) skip_arguments();
    return;
  }
  const Entry& entry = found->second;
  if (world_ended_) {
    diagnostics_.warning(
        word.location, "what follows `WorldEnd` is another picture: only the first one of the file is read");
    stopped_ = true;
    return;
  }
  if (entry.block == Block::kOptions && in_world_ && word.text == "Camera") {
    diagnostics_.error(word.location, "`Camera` belongs before `WorldBegin`");
  } else if (entry.block == Block::kOptions && in_world_) {
    repeated_.say_one_of("before/" + std::string(word.text), word.location,
                         fmt::format("`{}` belongs before `WorldBegin`; it is read here, too", word.text));
  } else if (entry.block == Block::kWorld && !in_world_ && !misses_world_begin_) {
    // Reported once only: all later directives would repeat it.
    misses_world_begin_ = true;
    diagnostics_.error(word.location, fmt::format("`{}` belongs after `WorldBegin`", word.text));
  }
  (this->*entry.handler)(word);
}

void SceneParser::report_unknown(const Token& word) {
  const std::vector<std::string_view> names = keys_of(directives());
  diagnostics_.error(word.location, fmt::format("unknown directive `{}`{}", word.text.substr(0, 60),
                                                name_hint(word.text, names)));
}

// Skips to the next directive. If the next word is not a directive, it was meant as an argument.
void SceneParser::skip_arguments() {
  if (tokens_->peek().is(TokenKind::kWord) && !directives().contains(tokens_->peek().text)) tokens_->next();
  while (!tokens_->peek().is(TokenKind::kEnd)) {
    const Token& token = tokens_->peek();
    if (token.is(TokenKind::kWord) && token.text != "true" && token.text != "false") return;
    tokens_->next();
  }
}

std::optional<Token> SceneParser::in_quotes(std::string_view what, const Token& word) {
  if (tokens_->peek().is(TokenKind::kString)) return tokens_->next();
  diagnostics_.error(tokens_->peek().location, fmt::format("`{}` needs {} in quotes", word.text, what));
  skip_arguments();
  return std::nullopt;
}

bool SceneParser::read_directive(const Token& word, std::string_view target, Directive& out) {
  const auto type = in_quotes("a type", word);
  if (!type) return false;
  out.type = unescape(type->text);
  out.location = word.location;
  out.type_location = type->location;
  ParsedParameters parsed = parse_parameters(*tokens_, diagnostics_);
  out.parameters = std::move(parsed.parameters);
  out.incomplete = parsed.incomplete;
  keep_last_ones(out.parameters, diagnostics_);
  add_defaults(target, out.parameters);
  leave_out_unknown_textures(out);
  v3_.upgrade(word.text, out);
  if (word.text == "Material" || word.text == "Shape") resolve_names(word.text, out);
  repairs_.repair(word.text, out);
  if (!tokens_->peek().is(TokenKind::kWord) && !tokens_->peek().is(TokenKind::kEnd)) {
    diagnostics_.error(tokens_->peek().location,
                       fmt::format("expected a parameter \"type name\" or a directive, not `{}`",
                                   tokens_->peek().text.substr(0, 60)));
    skip_arguments();
  }
  return true;
}

// Adds the defaults of `target` for parameters that the directive does not set.
void SceneParser::add_defaults(std::string_view target, std::vector<Parameter>& parameters) {
  const auto found = state_.defaults.find(target);
  if (found == state_.defaults.end()) return;
  const size_t own = parameters.size();
  for (const Parameter& p : *found->second) {
    const bool given = std::any_of(parameters.begin(), parameters.begin() + static_cast<std::ptrdiff_t>(own),
                                   [&](const Parameter& q) { return q.name == p.name; });
    if (!given) parameters.push_back(p);
  }
}

void SceneParser::on_attribute(const Token& word) {
  const auto target =
      in_quotes("its target, \"shape\", \"light\", \"material\", \"medium\" or \"texture\",", word);
  if (!target) return;
  const std::string name = unescape(target->text);
  std::vector<Parameter> parameters = parse_parameters(*tokens_, diagnostics_).parameters;
  constexpr std::string_view kTargets[] = {"shape", "light", "material", "medium", "texture"};
  if (std::find(std::begin(kTargets), std::end(kTargets), name) == std::end(kTargets)) {
    diagnostics_.error(target->location, fmt::format("unknown target \"{}\" of `Attribute`{}", name,
                                                     name_hint(name, kTargets)));
    return;
  }
  auto& current = state_.defaults[name];
  auto all = current ? std::make_shared<std::vector<Parameter>>(*current)
                     : std::make_shared<std::vector<Parameter>>();
  for (Parameter& p : parameters) {
    if (p.count() > kLongestDefault) {
      diagnostics_.error(p.location, fmt::format("a default has at most {} values", kLongestDefault));
      continue;
    }
    bool known = false;
    for (const Category& c : categories()) {
      const bool fits = c.noun == name || (name == "light" && c.directive == "AreaLightSource");
      for (const TypeSpec* type : c.types) known = known || (fits && type->find(p.name));
    }
    if (!known) diagnostics_.error(p.location, fmt::format("no {} has a parameter `{}`", name, p.name));
    p.inherited = true;
    std::erase_if(*all, [&](const Parameter& q) { return q.name == p.name; });
    all->push_back(std::move(p));
  }
  current = std::move(all);
}

void SceneParser::warn_once(const Token& word, std::string message) {
  if (warned_.insert(message).second) diagnostics_.warning(word.location, std::move(message));
}

void SceneParser::push(bool object, const SourceLocation& where) {
  if (stack_.size() >= kMostNestedBlocks) {
    if (ignored_pushes_++ == 0) {
      diagnostics_.error(where, fmt::format("more than {} nested blocks", kMostNestedBlocks));
    }
    return;
  }
  stack_.push_back({object, where, state_});
}

void SceneParser::pop(bool object, const Token& word) {
  if (ignored_pushes_ > 0) {
    --ignored_pushes_;
    return;
  }
  if (stack_.empty()) {
    repeated_.say_one_of("unopened", word.location,
                         fmt::format("`{}` closes no open block and is ignored", word.text));
    return;
  }
  if (stack_.back().object != object) {
    diagnostics_.error(word.location, fmt::format("`{}` does not close this block", word.text),
                       {{stack_.back().location, "the innermost open block"}});
    return;
  }
  state_ = std::move(stack_.back().state);
  stack_.pop_back();
}

void SceneParser::on_attribute_begin(const Token& word) {
  push(false, word.location);
}
void SceneParser::on_attribute_end(const Token& word) {
  pop(false, word);
}
void SceneParser::on_reverse_orientation(const Token&) {
  state_.reverse_orientation = !state_.reverse_orientation;
}

}  // namespace kaustik::pbrt
