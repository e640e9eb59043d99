#include "core/scene/camera_builder.h"

namespace kaustik {
namespace {

const TypeSpec* checked(std::string_view directive, const Directive& d, WarnedOnce& warned,
                        DiagnosticList& diagnostics) {
  const Category& kind = category(directive);
  const TypeSpec* spec = find_type(kind, d, diagnostics);
  return spec && check_parameters(kind.noun, *spec, d, warned, diagnostics) ? spec : nullptr;
}

void take_film(const Directive& film, WarnedOnce& warned, DiagnosticList& diagnostics,
               PerspectiveCamera& camera) {
  const TypeSpec* spec = checked("Film", film, warned, diagnostics);
  if (!spec) return;
  const ParameterReader reader(film, *spec);
  camera.width = static_cast<int>(reader.number("xresolution"));
  camera.height = static_cast<int>(reader.number("yresolution"));
}

void take_screen_window(const ParameterReader& reader, DiagnosticList& diagnostics,
                        PerspectiveCamera& camera) {
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

void take_camera(const CameraDescription& description, WarnedOnce& warned, DiagnosticList& diagnostics,
                 PerspectiveCamera& camera) {
  if (is_usable_transform(description.camera_to_world)) {
    camera.to_world = Transform::from_matrix(description.camera_to_world);
  } else {
    diagnostics.error(description.location, "the camera's transform cannot be inverted");
  }
  const TypeSpec* spec = checked("Camera", description, warned, diagnostics);
  if (!spec) return;
  const ParameterReader reader(description, *spec);
  camera.fov_degrees = static_cast<float>(reader.number("fov"));
  take_screen_window(reader, diagnostics, camera);
}

}  // namespace

bool is_usable_transform(const glm::dmat4& m) {
  return m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1 &&
         Transform::from_matrix(m).invertible();
}

PerspectiveCamera build_camera(const SceneDescription& description, WarnedOnce& warned,
                               DiagnosticList& diagnostics) {
  PerspectiveCamera camera;
  if (description.film) take_film(*description.film, warned, diagnostics, camera);
  camera.set_default_screen_window();
  if (description.camera) take_camera(*description.camera, warned, diagnostics, camera);
  for (const auto& [name, directive] :
       {std::pair{"Sampler", &description.sampler}, std::pair{"PixelFilter", &description.filter},
        std::pair{"Accelerator", &description.accelerator}}) {
    if (*directive) checked(name, **directive, warned, diagnostics);
  }
  Directive options;
  options.parameters = description.options;
  check_parameters("Option", option_type(), options, warned, diagnostics);
  return camera;
}

}  // namespace kaustik
