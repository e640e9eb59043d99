#include "apps/settings/scene_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "apps/settings/table/table.h"
#include "core/diagnostics/nearest_name.h"

namespace kaustik::app {

namespace {

using Names = std::span<const std::string_view>;

// The integrators of pbrt-v3 and v4 that method auto stands in for.
constexpr std::string_view kStoodInFor[] = {
    "path",      "volpath",    "bdpt",       "mlt",           "ambientocclusion", "function",
    "lightpath", "randomwalk", "simplepath", "simplevolpath", "directlighting",   "whitted"};

// Parameters of these that change how the work is done, or nothing that is rendered here.
constexpr std::string_view kWithoutMeaning[] = {"regularize",
                                                "lightsampler",
                                                "rrthreshold",
                                                "lightsamplestrategy",
                                                "pixelbounds",
                                                "strategy",
                                                "sampledirect",
                                                "samplelights",
                                                "samplebsdf",
                                                "visualizestrategies",
                                                "visualizeweights",
                                                "bootstrapsamples",
                                                "chains",
                                                "mutationsperpixel",
                                                "largestepprobability",
                                                "sigma",
                                                "cossample",
                                                "nsamples",
                                                "maxdistance",
                                                "function",
                                                "skipbad",
                                                "imagefilename"};

bool contains(Names names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Formats a number for the settings' parsers: integers without a fraction.
std::string number_text(double value) {
  constexpr double kExact = 9007199254740992.0;  // 2^53
  const bool whole = std::abs(value) <= kExact && value == std::trunc(value);
  return whole ? fmt::format("{}", static_cast<int64_t>(value)) : fmt::format("{}", value);
}

std::vector<std::string> value_texts(const Parameter& parameter) {
  std::vector<std::string> texts = parameter.strings;
  for (const double value : parameter.numbers) texts.push_back(number_text(value));
  return texts;
}

// Whether a parameter of this type can hold the setting's value.
bool type_fits(const Setting& setting, ParameterType type) {
  if (type == ParameterType::kString) return true;
  switch (setting.kind) {
    case ValueKind::kCount:
    case ValueKind::kInteger:
      return type == ParameterType::kInteger;
    case ValueKind::kNumber:
      return type == ParameterType::kInteger || type == ParameterType::kFloat;
    case ValueKind::kChoice:
    case ValueKind::kNames:
    case ValueKind::kText:
      return false;
  }
  return false;
}

std::string_view expected_type(const Setting& setting) {
  switch (setting.kind) {
    case ValueKind::kCount:
    case ValueKind::kInteger:
      return "integer";
    case ValueKind::kNumber:
      return "float";
    default:
      return "string";
  }
}

// Assigns one parameter of Integrator "photonmap" to the setting of the same name.
void assign_parameter(const Parameter& parameter, Settings& settings, DiagnosticList& diagnostics) {
  const Setting* setting = find_setting(parameter.name);
  if (!setting || !setting->in_scene_files) {
    std::vector<std::string_view> names;
    for (const Setting& s : settings_table())
      if (s.in_scene_files) names.push_back(s.name);
    diagnostics.error(parameter.location, fmt::format("integrator `photonmap` has no parameter `{}`{}",
                                                      parameter.name, name_hint(parameter.name, names)));
    return;
  }
  if (!type_fits(*setting, parameter.type)) {
    diagnostics.error(parameter.location,
                      fmt::format("`{}` is of type {}, not {}", setting->name, expected_type(*setting),
                                  parameter_type_name(parameter.type)));
    return;
  }
  const std::vector<std::string> texts = value_texts(parameter);
  const size_t expected = static_cast<size_t>(setting->values);
  if (texts.empty() || (setting->kind != ValueKind::kNames && texts.size() != expected)) {
    diagnostics.error(parameter.location, fmt::format("`{}` takes {} value{}, not {}", setting->name,
                                                      expected, expected == 1 ? "" : "s", texts.size()));
    return;
  }
  if (const std::optional<std::string> complaint = setting->assign(settings, texts)) {
    diagnostics.error(parameter.value_location(0), fmt::format("`{}` {}", setting->name, *complaint));
  }
}

// Warns of each parameter that is not read, with the nearest name where pbrt knows none like it: the picture
// would be right without it.
void check_pbrt_parameters(const Directive& integrator, Names used, Names ignored,
                           DiagnosticList& diagnostics) {
  std::vector<std::string_view> all(used.begin(), used.end());
  all.insert(all.end(), ignored.begin(), ignored.end());
  for (const Parameter& parameter : integrator.parameters) {
    if (contains(used, parameter.name)) continue;
    diagnostics.warning(parameter.location,
                        contains(ignored, parameter.name)
                            ? fmt::format("`{}` of integrator `{}` has no meaning here and is ignored",
                                          parameter.name, integrator.type)
                            : fmt::format("integrator `{}` has no parameter `{}`{}: it is ignored",
                                          integrator.type, parameter.name, name_hint(parameter.name, all)));
  }
}

// The single number of a parameter; nothing when it is absent or, with an error, when it is not one number.
std::optional<double> number_of(const Directive& directive, std::string_view name,
                                DiagnosticList& diagnostics) {
  const Parameter* parameter = directive.find(name);
  if (!parameter) return std::nullopt;
  if (parameter->numbers.size() == 1) return parameter->numbers[0];
  diagnostics.error(parameter->location, fmt::format("`{}` takes one number", name));
  return std::nullopt;
}

// Assigns a number of pbrt's directive to the equivalent setting, which checks it.
void forward(const Directive& integrator, std::string_view from, std::string_view to, Settings& settings,
             DiagnosticList& diagnostics) {
  const std::optional<double> value = number_of(integrator, from, diagnostics);
  if (!value) return;
  const std::string text = number_text(*value);
  if (const auto complaint = find_setting(to)->assign(settings, {&text, 1})) {
    diagnostics.error(integrator.find(from)->value_location(0), fmt::format("`{}` {}", from, *complaint));
  }
}

// Sets max_bounces from pbrt's maxdepth. pbrt allows 0; the least value here is 1.
void take_maxdepth(const Directive& integrator, Settings& settings, DiagnosticList& diagnostics) {
  constexpr int kPbrtDefault = 5;
  settings.render.max_bounces = kPbrtDefault;
  const std::optional<double> depth = number_of(integrator, "maxdepth", diagnostics);
  if (depth && *depth == 0) {
    settings.render.max_bounces = 1;
    return;
  }
  forward(integrator, "maxdepth", "max-bounces", settings, diagnostics);
}

void apply_sppm(const Directive& integrator, SceneSettings& out, DiagnosticList& diagnostics) {
  constexpr std::string_view kUsed[] = {"maxdepth", "photonsperiteration", "radius", "seed"};
  constexpr std::string_view kIgnored[] = {"regularize", "lightsampler", "iterations", "numiterations",
                                           "imagewritefrequency"};
  check_pbrt_parameters(integrator, kUsed, kIgnored, diagnostics);
  render::RenderSettings& settings = out.settings.render;
  settings.direct = render::DirectEstimator::kShadowRays;
  settings.caustics = render::CausticEstimator::kPhotons;
  settings.indirect = render::IndirectEstimator::kPhotons;
  take_maxdepth(integrator, out.settings, diagnostics);
  forward(integrator, "radius", "radius", out.settings, diagnostics);
  forward(integrator, "seed", "seed", out.settings, diagnostics);
  const std::optional<double> photons = number_of(integrator, "photonsperiteration", diagnostics);
  if (photons && *photons > 0) {
    settings.balance = render::Balance::kOff;
    forward(integrator, "photonsperiteration", "photons", out.settings, diagnostics);
  }
  out.notes.push_back(
      "Integrator \"sppm\": direct light by shadow rays, caustics and indirect light from photons");
}

// Method auto renders what every other integrator of pbrt renders, whichever algorithm the file names.
void apply_stand_in(const Directive& integrator, SceneSettings& out, DiagnosticList& diagnostics) {
  constexpr std::string_view kUsed[] = {"maxdepth", "seed"};
  check_pbrt_parameters(integrator, kUsed, kWithoutMeaning, diagnostics);
  take_maxdepth(integrator, out.settings, diagnostics);
  forward(integrator, "seed", "seed", out.settings, diagnostics);
  out.notes.push_back(
      fmt::format("Integrator \"{}\": rendered by method auto with at most {} bounces; --method mc traces "
                  "paths",
                  integrator.type, out.settings.render.max_bounces));
}

void warn_of_unknown(const Directive& integrator, DiagnosticList& diagnostics) {
  std::vector<std::string_view> names = {"photonmap", "sppm"};
  names.insert(names.end(), std::begin(kStoodInFor), std::end(kStoodInFor));
  diagnostics.warning(integrator.type_location,
                      fmt::format("unknown integrator `{}`{}: method auto is used; kaustik's own integrator "
                                  "is `photonmap`",
                                  integrator.type, name_hint(integrator.type, names)));
}

// Applies "quality" before the other parameters, so that explicit numbers win wherever they stand in the
// file.
void apply_quality(const Directive& integrator, SceneSettings& out, DiagnosticList& diagnostics) {
  if (integrator.type != "photonmap") return;
  if (const Parameter* quality = integrator.find("quality"))
    assign_parameter(*quality, out.settings, diagnostics);
}

void apply_integrator(const Directive& integrator, SceneSettings& out, DiagnosticList& diagnostics) {
  if (integrator.type == "photonmap") {
    if (integrator.find("photons")) out.settings.render.balance = render::Balance::kOff;
    if (integrator.find("spp")) out.settings.render.sample_balance = render::Balance::kOff;
    for (const Parameter& parameter : integrator.parameters) {
      if (parameter.name != "quality") assign_parameter(parameter, out.settings, diagnostics);
    }
  } else if (integrator.type == "sppm") {
    apply_sppm(integrator, out, diagnostics);
  } else if (contains(kStoodInFor, integrator.type)) {
    apply_stand_in(integrator, out, diagnostics);
  } else {
    warn_of_unknown(integrator, diagnostics);
  }
}

// A file that asks for more samples than the preset gets exactly these.
void apply_sampler(const Directive& sampler, Settings& settings, DiagnosticList& diagnostics) {
  const int preset = settings.render.spp;
  forward(sampler, "pixelsamples", "spp", settings, diagnostics);
  const std::optional<double> x = number_of(sampler, "xsamples", diagnostics);
  const std::optional<double> y = number_of(sampler, "ysamples", diagnostics);
  if (sampler.type == "stratified" && (x || y)) {
    const std::string text = number_text(x.value_or(4) * y.value_or(4));
    if (const auto complaint = find_setting("spp")->assign(settings, {&text, 1})) {
      diagnostics.error(sampler.type_location, fmt::format("samples {}", *complaint));
    }
  }
  if (settings.render.spp > preset) settings.render.sample_balance = render::Balance::kOff;
}

// Reads one side of the image in pixels.
void take_resolution(const Directive& film, std::string_view name, int& side, DiagnosticList& diagnostics) {
  constexpr double kMost = 65535;
  const std::optional<double> value = number_of(film, name, diagnostics);
  if (!value) return;
  if (*value >= 1 && *value <= kMost && *value == std::trunc(*value)) {
    side = static_cast<int>(*value);
  } else {
    diagnostics.error(film.find(name)->value_location(0),
                      fmt::format("`{}` must be 1 to 65535 pixels", name));
  }
}

// Reads pbrt's crop, x0 x1 y0 y1: "cropwindow" in fractions of the image, or "pixelbounds" in pixels.
void take_crop(const Directive& film, SceneSettings& out, DiagnosticList& diagnostics) {
  for (const std::string_view name : {"cropwindow", "pixelbounds"}) {
    const Parameter* parameter = film.find(name);
    if (!parameter) continue;
    std::array<double, 4> edge{};
    if (parameter->numbers.size() != edge.size()) {
      diagnostics.error(parameter->location, fmt::format("`{}` takes four numbers: x0 x1 y0 y1", name));
      continue;
    }
    for (size_t i = 0; i < edge.size(); ++i) {
      const int side = i < 2 ? out.width : out.height;
      const double pixels =
          name == "cropwindow" ? std::ceil(parameter->numbers[i] * side) : parameter->numbers[i];
      edge[i] = std::clamp(pixels, 0.0, double(side));
    }
    const render::CropWindow crop{int(edge[0]), int(edge[1]), int(edge[2]), int(edge[3])};
    if (crop.empty()) {
      diagnostics.error(parameter->value_location(0), fmt::format("`{}` leaves no pixel of the image", name));
    }
    out.settings.render.crop = crop;
  }
}

void apply_film(const Directive& film, SceneSettings& out, DiagnosticList& diagnostics) {
  take_resolution(film, "xresolution", out.width, diagnostics);
  take_resolution(film, "yresolution", out.height, diagnostics);
  take_crop(film, out, diagnostics);
  if (const Parameter* filename = film.find("filename"); filename && filename->strings.size() == 1) {
    out.output = filename->strings[0];
  }
}

}  // namespace

SceneSettings settings_from_scene(const SceneDescription& description, DiagnosticList& diagnostics) {
  SceneSettings out;
  if (description.integrator) apply_quality(*description.integrator, out, diagnostics);
  if (description.film) apply_film(*description.film, out, diagnostics);
  if (description.sampler) apply_sampler(*description.sampler, out.settings, diagnostics);
  if (description.integrator) apply_integrator(*description.integrator, out, diagnostics);
  if (description.camera) {
    out.fixed_screen_window =
        description.camera->find("screenwindow") || description.camera->find("frameaspectratio");
  }
  return out;
}

}  // namespace kaustik::app
