// Builds the camera and its pixel filter from their checked directives.

#include "core/scene/build/camera_builder.h"

#include <fmt/format.h>

#include <map>

#include "core/diagnostics/nearest_name.h"

namespace kaustik {
namespace {

const TypeSpec* checked(std::string_view directive, const Directive& d, WarnedOnce& warned,
                        DiagnosticList& diagnostics) {
  const Category& kind = category(directive);
  const TypeSpec* spec = find_type(kind, d, diagnostics);
  return spec && check_parameters(kind.noun, *spec, d, warned, diagnostics) ? spec : nullptr;
}

void take_film(const Directive& film, WarnedOnce& warned, DiagnosticList& diagnostics, Camera& camera) {
  const TypeSpec* spec = checked("Film", film, warned, diagnostics);
  if (!spec) return;
  const ParameterReader reader(film, *spec);
  camera.width = static_cast<int>(reader.number("xresolution"));
  camera.height = static_cast<int>(reader.number("yresolution"));
}

void take_screen_window(const ParameterReader& reader, DiagnosticList& diagnostics, Camera& camera) {
  if (reader.has("frameaspectratio")) {
    const auto aspect = static_cast<float>(reader.number("frameaspectratio"));
    camera.screen_window =
        aspect >= 1 ? glm::vec4(-aspect, aspect, -1, 1) : glm::vec4(-1, 1, -1 / aspect, 1 / aspect);
  }
  const Parameter* window = reader.directive().find("screenwindow");
  if (!window) return;
  for (int k = 0; k < 4; ++k)
    camera.screen_window[k] = static_cast<float>(window->numbers[static_cast<size_t>(k)]);
  if (!(camera.screen_window[0] < camera.screen_window[1] &&
        camera.screen_window[2] < camera.screen_window[3])) {
    diagnostics.error(window->location, "`screenwindow` must be x min < x max, y min < y max");
  }
}

ThinLens lens_of(const ParameterReader& reader) {
  return {static_cast<float>(reader.number("lensradius")),
          static_cast<float>(reader.number("focaldistance"))};
}

Projection projection_of(const ParameterReader& reader, DiagnosticList& diagnostics) {
  const std::string& type = reader.directive().type;
  if (type == "orthographic") return OrthographicProjection{lens_of(reader)};
  if (type == "perspective")
    return PerspectiveProjection{static_cast<float>(reader.number("fov")), lens_of(reader)};
  const std::string mapping = reader.has("mapping") ? reader.text("mapping") : "equalarea";
  if (mapping == "equirectangular") return SphericalProjection{SphericalMapping::kEquirectangular};
  if (mapping != "equalarea") {
    constexpr std::array<std::string_view, 2> names = {"equalarea", "equirectangular"};
    diagnostics.error(reader.location("mapping"),
                      fmt::format("unknown mapping \"{}\"{}", mapping, name_hint(mapping, names)));
  }
  return SphericalProjection{};
}

void take_camera(const CameraDescription& description, WarnedOnce& warned, DiagnosticList& diagnostics,
                 Camera& camera) {
  if (is_usable_transform(description.camera_to_world)) {
    camera.to_world = Transform::from_matrix(description.camera_to_world);
  } else {
    diagnostics.error(description.location, "the camera's transform cannot be inverted");
  }
  const TypeSpec* spec = checked("Camera", description, warned, diagnostics);
  if (!spec) return;
  const ParameterReader reader(description, *spec);
  camera.projection = projection_of(reader, diagnostics);
  if (!std::holds_alternative<SphericalProjection>(camera.projection))
    take_screen_window(reader, diagnostics, camera);
}

FilterAxis filter_axis(const ParameterReader& reader, std::string_view radius) {
  static const std::map<std::string_view, FilterKind> kinds = {{"box", FilterKind::kBox},
                                                               {"triangle", FilterKind::kTriangle},
                                                               {"gaussian", FilterKind::kGaussian},
                                                               {"mitchell", FilterKind::kMitchell},
                                                               {"sinc", FilterKind::kSinc}};
  FilterAxis axis;
  axis.kind = kinds.at(reader.directive().type);
  const auto number = [&](std::string_view name) { return static_cast<float>(reader.number(name)); };
  axis.radius = number(radius);
  if (axis.kind == FilterKind::kGaussian) axis.sigma = number("sigma");
  if (axis.kind == FilterKind::kMitchell) axis.B = number("B"), axis.C = number("C");
  if (axis.kind == FilterKind::kSinc) axis.tau = number("tau");
  return axis;
}

void take_filter(const Directive& filter, WarnedOnce& warned, DiagnosticList& diagnostics, Camera& camera) {
  const TypeSpec* spec = checked("PixelFilter", filter, warned, diagnostics);
  if (!spec) return;
  const ParameterReader reader(filter, *spec);
  PixelFilter made(filter_axis(reader, "xradius"), filter_axis(reader, "yradius"));
  if (!(made.mean_weight() > 0)) {
    return diagnostics.error(filter.type_location, "the integral of this pixel filter is not positive");
  }
  camera.filter = std::move(made);
}

}  // namespace

Camera build_camera(const SceneDescription& description, WarnedOnce& warned, DiagnosticList& diagnostics) {
  Camera camera;
  if (description.film) take_film(*description.film, warned, diagnostics, camera);
  camera.set_default_screen_window();
  if (description.camera) take_camera(*description.camera, warned, diagnostics, camera);
  if (description.filter) take_filter(*description.filter, warned, diagnostics, camera);
  for (const auto& [name, directive] :
       {std::pair{"Sampler", &description.sampler}, std::pair{"Accelerator", &description.accelerator}}) {
    if (*directive) checked(name, **directive, warned, diagnostics);
  }
  Directive options;
  options.parameters = description.options;
  check_parameters("Option", option_type(), options, warned, diagnostics);
  return camera;
}

}  // namespace kaustik
