// Makes textures from their directives, loads their images, and finds them by name.

#include "core/scene/build/texture_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/diagnostics/nearest_name.h"
#include "core/math/transform.h"
#include "core/parallel/parallel.h"

namespace kaustik {

namespace {

// Limit on the lookups of nested textures; more are a mistake. It also bounds their depth.
constexpr uint64_t kMostLookups = 256;

// One allowed word of a text parameter, and its meaning.
template <class Value>
struct Choice {
  std::string_view name;
  Value value;
};

template <class Value, size_t kCount>
Value choose(const ParameterReader& p, std::string_view name, const Choice<Value> (&choices)[kCount],
             bool* ok, DiagnosticList& diagnostics) {
  if (!p.has(name)) return choices[0].value;
  const std::string text = p.text(name);
  std::vector<std::string_view> known;
  for (const auto& choice : choices) {
    if (choice.name == text) return choice.value;
    known.push_back(choice.name);
  }
  diagnostics.error(p.location(name), fmt::format("unknown {} \"{}\"{}", name, text, name_hint(text, known)));
  *ok = false;
  return choices[0].value;
}

std::optional<ImageEncoding> parse_encoding(std::string_view text) {
  using Kind = ImageEncoding::Kind;
  if (text.empty()) return ImageEncoding{};
  if (text == "sRGB") return ImageEncoding{Kind::kSrgb};
  if (text == "linear") return ImageEncoding{Kind::kLinear};
  constexpr std::string_view kGamma = "gamma ";
  if (!text.starts_with(kGamma)) return std::nullopt;
  text.remove_prefix(kGamma.size());
  float gamma = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), gamma);
  if (error != std::errc() || end != text.data() + text.size() || !(gamma > 0 && gamma <= 100))
    return std::nullopt;
  return ImageEncoding{Kind::kGamma, gamma};
}

}  // namespace

// Makes one texture from its directive.
class TextureTable::Maker {
 public:
  Maker(TextureTable& table, const TextureDescription& texture, const TypeSpec& spec, TextureValue value,
        DiagnosticList& diagnostics)
      : table_(table), texture_(texture), p_(texture, spec), value_(value), diagnostics_(diagnostics) {}

  // Returns nothing after an error.
  std::optional<Texture> make() {
    Texture made = make_type();
    if (cost_ > kMostLookups) {
      error(texture_.name_location,
            fmt::format("texture `{}` takes {} or more lookups of textures: at most {} are supported",
                        texture_.name, cost_, kMostLookups));
    }
    if (!ok_) return std::nullopt;
    return made;
  }
  uint64_t cost() const { return cost_; }
  std::optional<ImageRequest> request;

 private:
  Texture make_type() {
    const std::string& type = texture_.type;
    if (type == "constant") return ConstantTexture{operand("value")};
    if (type == "scale") return ScaleTexture{operand("tex"), operand("scale", factor_value())};
    if (type == "mix")
      return MixTexture{operand("tex1"), operand("tex2"), operand("amount", TextureValue::kFloat)};
    if (type == "directionmix") return DirectionMixTexture{operand("tex1"), operand("tex2"), direction()};
    if (type == "checkerboard")
      return CheckerboardTexture{mapping(), p_.number("dimension") == 3, operand("tex1"), operand("tex2")};
    if (type == "dots") return DotsTexture{mapping(), operand("outside"), operand("inside")};
    if (type == "bilerp")
      return BilerpTexture{mapping(), value("v00"), value("v01"), value("v10"), value("v11")};
    if (type == "fbm") return FbmTexture{octaves()};
    if (type == "wrinkled") return WrinkledTexture{octaves()};
    if (type == "windy") return WindyTexture{};
    if (type == "marble")
      return MarbleTexture{octaves(), float(p_.number("scale")), float(p_.number("variation"))};
    if (type == "vertexcolor") return VertexColourTexture{value_ == TextureValue::kFloat};
    return image();
  }

  void error(const SourceLocation& where, std::string message) {
    diagnostics_.error(where, std::move(message));
    ok_ = false;
  }

  // The value of a parameter that is no texture. In float textures colours count as their mean.
  Rgb value(std::string_view name) { return value(name, value_); }
  Rgb value(std::string_view name, TextureValue kind) {
    const Rgb given = p_.rgb(name);
    const Parameter* p = texture_.find(name);
    if (kind == TextureValue::kSpectrum || !p || p->type == ParameterType::kFloat) return given;
    diagnostics_.warning(p->location,
                         fmt::format("`{}` must be a number in a float texture: \"float {}\"; the "
                                     "mean of the colour is taken",
                                     name, name));
    return Rgb((given.x + given.y + given.z) / 3);
  }
  TextureOperand operand(std::string_view name) { return operand(name, value_); }
  TextureOperand operand(std::string_view name, TextureValue kind) {
    const Parameter* given = texture_.find(name);
    if (!given || given->type != ParameterType::kTexture) return TextureOperand{value(name, kind)};
    TextureOperand found{Rgb(0), table_.find(*given, kind, diagnostics_)};
    if (found.texture == kNoIndex) {
      ok_ = false;
    } else {
      cost_ += table_.cost_[found.texture];
    }
    return found;
  }

  // pbrt-v4 accepts only floats; pbrt-v3 also accepted colours for spectrum textures.
  TextureValue factor_value() const {
    const Parameter* given = texture_.find("scale");
    if (!given || value_ == TextureValue::kFloat) return TextureValue::kFloat;
    const bool names_float = given->type == ParameterType::kTexture &&
                             table_.names(TextureValue::kFloat).contains(given->strings[0]);
    return names_float ? TextureValue::kFloat : TextureValue::kSpectrum;
  }

  Vector3 direction() {
    const glm::dvec3 d = glm::dmat3(texture_.texture_to_world) * p_.vec3("dir");
    const double length = glm::length(d);
    if (length > 0 && std::isfinite(length)) return Vector3(d / length);
    error(p_.location("dir"), "`dir` must be a vector of finite length above zero");
    return {};
  }

  Octaves octaves() const { return {float(p_.number("roughness")), int(p_.number("octaves"))}; }
  Vector2 pair(std::string_view a, std::string_view b) {
    return {static_cast<float>(p_.number(a)), static_cast<float>(p_.number(b))};
  }
  TextureMapping mapping() {
    enum Kind { kUv, kSpherical, kCylindrical, kPlanar };
    static constexpr Choice<Kind> kMappings[] = {
        {"uv", kUv}, {"spherical", kSpherical}, {"cylindrical", kCylindrical}, {"planar", kPlanar}};
    switch (choose(p_, "mapping", kMappings, &ok_, diagnostics_)) {
      case kUv:
        return UvMapping{pair("uscale", "vscale"), pair("udelta", "vdelta"), pair("ushear", "vshear")};
      case kSpherical:
        return SphereMapping{};
      case kCylindrical:
        return CylinderMapping{};
      case kPlanar:
        break;
    }
    return PlanarMapping{Vector3(p_.vec3("v1")), Vector3(p_.vec3("v2")), pair("udelta", "vdelta")};
  }

  Texture image() {
    static constexpr Choice<ImageWrap> kWraps[] = {{"repeat", ImageWrap::kRepeat},
                                                   {"black", ImageWrap::kBlack},
                                                   {"clamp", ImageWrap::kClamp},
                                                   {"mirror", ImageWrap::kMirror}};
    static constexpr Choice<ImageFilter> kFilters[] = {{"bilinear", ImageFilter::kBilinear},
                                                       {"point", ImageFilter::kPoint},
                                                       {"trilinear", ImageFilter::kTrilinear},
                                                       {"EWA", ImageFilter::kEwa}};
    ImageTexture t;
    t.mapping = mapping();
    t.sampling.wrap = choose(p_, "wrap", kWraps, &ok_, diagnostics_);
    t.sampling.vwrap = p_.has("vwrap") ? choose(p_, "vwrap", kWraps, &ok_, diagnostics_) : t.sampling.wrap;
    t.sampling.filter = choose(p_, "filter", kFilters, &ok_, diagnostics_);
    t.sampling.max_anisotropy = static_cast<float>(p_.number("maxanisotropy"));
    t.scale = static_cast<float>(p_.number("scale"));
    t.invert = p_.flag("invert");
    t.grey = value_ == TextureValue::kFloat;
    const auto encoding = parse_encoding(p_.text("encoding"));
    if (!encoding) error(p_.location("encoding"), "an encoding is \"sRGB\", \"linear\" or \"gamma 2.2\"");
    if (!p_.has("filename")) error(texture_.type_location, "texture \"imagemap\" needs `filename`");
    if (ok_) request = ImageRequest{0, p_.text("filename"), p_.location("filename"), *encoding, {}};
    return t;
  }

  TextureTable& table_;
  const TextureDescription& texture_;
  ParameterReader p_;
  TextureValue value_;
  DiagnosticList& diagnostics_;
  uint64_t cost_ = 1;
  bool ok_ = true;
};

TextureTable::TextureTable(const SceneDescription& description, const ImageLoader& images, WarnedOnce& warned,
                           DiagnosticList& diagnostics)
    : description_(description), images_(images) {
  for (const TextureDescription& t : description.textures)
    first_.try_emplace({t.value_type, t.name}, t.name_location);
  for (const TextureDescription& texture : description.textures) add(texture, warned, diagnostics);
  load_images(diagnostics);
  share_library();
}

void TextureTable::add(const TextureDescription& texture, WarnedOnce& warned, DiagnosticList& diagnostics) {
  const bool is_float = texture.value_type == "float";
  if (!is_float && texture.value_type != "spectrum") {
    constexpr std::string_view kTypes[] = {"float", "spectrum"};
    return diagnostics.error(texture.value_type_location,
                             fmt::format("a texture is \"float\" or \"spectrum\", not \"{}\"{}",
                                         texture.value_type, name_hint(texture.value_type, kTypes)));
  }
  const TypeSpec* spec = find_type(category("Texture"), texture, diagnostics);
  bool ok = spec && check_parameters("texture", *spec, texture, warned, diagnostics);
  if (!is_usable_transform(texture.texture_to_world)) {
    diagnostics.error(texture.location, "the transform of this texture cannot be inverted");
    ok = false;
  }
  const TextureValue value = is_float ? TextureValue::kFloat : TextureValue::kSpectrum;
  Texture made = ConstantTexture{};  // replaces a texture with errors, so that its name is known
  uint64_t cost = 1;
  if (ok) {
    Maker maker(*this, texture, *spec, value, diagnostics);
    if (auto texture_made = maker.make()) {
      made = std::move(*texture_made);
      cost = maker.cost();
      if (maker.request) {
        maker.request->texture = static_cast<uint32_t>(set_->size());
        requests_.push_back(std::move(*maker.request));
      }
    }
  }
  const auto [known, is_new] = names(value).emplace(texture.name, static_cast<uint32_t>(set_->size()));
  if (!is_new) {
    diagnostics.error(texture.name_location,
                      fmt::format("{} texture `{}` is defined twice", texture.value_type, texture.name),
                      {{first_.at({texture.value_type, texture.name}), "first defined here"}});
  }
  set_->add(std::move(made), Transform::from_matrix(texture.texture_to_world));
  to_world_.push_back(texture.texture_to_world);
  cost_.push_back(cost);
}

ImageResult TextureTable::load_image(const std::string& filename, const SourceLocation& where,
                                     const ImageEncoding& encoding) const {
  if (!images_.load) return {0, "image files cannot be read here"};
  return images_.load(filename, where, encoding);
}

void TextureTable::report_unreadable(const SourceLocation& where, const std::string& error,
                                     DiagnosticList& diagnostics) const {
  if (description_.grey_for_unreadable_images)
    diagnostics.warning(where, error + ": grey is shown in its place");
  else
    diagnostics.error(where, error);
}

void TextureTable::share_library() const {
  if (images_.library) set_->set_images(images_.library());
}

void TextureTable::load_images(DiagnosticList& diagnostics) {
  parallel::for_index(size_t{0}, requests_.size(), [&](size_t i) {
    ImageRequest& request = requests_[i];
    request.result = load_image(request.filename, request.where, request.encoding);
  });
  for (const ImageRequest& request : requests_) {
    Texture& texture = set_->texture(request.texture);
    if (request.result.error.empty()) {
      std::get<ImageTexture>(texture).image = request.result.image;
    } else {
      report_unreadable(request.where, request.result.error, diagnostics);
      texture = ConstantTexture{{Rgb(0.5f)}};  // materials that are checked later may refer to it
    }
  }
}

uint32_t TextureTable::find(const Parameter& parameter, TextureValue value,
                            DiagnosticList& diagnostics) const {
  const std::string& name = parameter.strings.at(0);
  const auto& known = names(value);
  if (const auto found = known.find(name); found != known.end()) return found->second;
  const std::string_view kind = value == TextureValue::kFloat ? "float" : "spectrum";
  const SourceLocation where = parameter.value_location(0);
  if (const auto later = first_.find({kind, name}); later != first_.end()) {
    diagnostics.error(where, fmt::format("texture `{}` is used before it is defined", name),
                      {{later->second, "defined here"}});
    return kNoIndex;
  }
  const bool is_float = value == TextureValue::kFloat;
  const auto& other = names(is_float ? TextureValue::kSpectrum : TextureValue::kFloat);
  if (const auto found = other.find(name); found != other.end()) {
    diagnostics.warning(where, fmt::format("`{}` takes a {} texture, which `{}` is not: {} is taken",
                                           parameter.name, kind, name, is_float ? "its red" : "its grey"));
    return found->second;
  }
  const auto candidates = [&] { return keys_of(known); };
  diagnostics.error(
      where, fmt::format("no {} texture is named `{}`{}", kind, name, diagnostics.hint(name, candidates)));
  return kNoIndex;
}

std::optional<uint32_t> TextureTable::load_linear_image(const std::string& filename,
                                                        const SourceLocation& where,
                                                        DiagnosticList& diagnostics) const {
  const ImageResult result = load_image(filename, where, {ImageEncoding::Kind::kLinear});
  share_library();
  if (result.error.empty()) return result.image;
  report_unreadable(where, result.error, diagnostics);
  return std::nullopt;
}

std::shared_ptr<const TextureSet> TextureTable::finish(const glm::dvec3& origin) {
  if (origin != glm::dvec3(0)) {
    for (uint32_t i = 0; i < to_world_.size(); ++i)
      set_->set_transform(i, Transform::from_matrix(relative_to(origin, to_world_[i])));
  }
  return std::move(set_);
}

}  // namespace kaustik
