// Exposure and white balance from the Film and Camera lines.

#include "core/scene/build/sensor_builder.h"

#include <fmt/format.h>

#include "core/diagnostics/nearest_name.h"
#include "core/spectrum/colour_space.h"
#include "core/spectrum/spectrum.h"

namespace kaustik {
namespace {

// The sensors of pbrt-v4 other than "cie1931".
constexpr std::string_view kMeasured[] = {
    "canon_eos_100d",     "canon_eos_1dx_mkii", "canon_eos_200d",    "canon_eos_200d_mkii", "canon_eos_5d",
    "canon_eos_5d_mkii",  "canon_eos_5d_mkiii", "canon_eos_5d_mkiv", "canon_eos_5ds",       "canon_eos_m",
    "hasselblad_l1d_20c", "nikon_d810",         "nikon_d850",        "sony_ilce_6400",      "sony_ilce_7m3",
    "sony_ilce_7rm3",     "sony_ilce_9"};

double number(const Directive* directive, std::string_view name, double otherwise) {
  const Parameter* p = directive ? directive->find(name) : nullptr;
  return p && p->numbers.size() == 1 ? p->numbers[0] : otherwise;
}

void check_name(const Directive& film, DiagnosticList& diagnostics) {
  const Parameter* p = film.find("sensor");
  if (!p || p->strings.size() != 1 || p->strings[0] == "cie1931") return;
  const std::string& name = p->strings[0];
  if (std::find(std::begin(kMeasured), std::end(kMeasured), name) != std::end(kMeasured)) {
    diagnostics.warning(
        p->value_location(0),
        fmt::format("sensor \"{}\" is replaced by \"cie1931\": its measurements are not available", name));
    return;
  }
  std::vector<std::string_view> names(std::begin(kMeasured), std::end(kMeasured));
  names.insert(names.begin(), "cie1931");
  diagnostics.warning(p->value_location(0), fmt::format("unknown sensor \"{}\": \"cie1931\" stands in{}",
                                                        name, name_hint(name, names)));
}

double exposure_time(const Directive* film, const Directive* camera, DiagnosticList& diagnostics) {
  if (film && film->find("exposuretime")) return number(film, "exposuretime", 1);
  const double time = number(camera, "shutterclose", 1) - number(camera, "shutteropen", 0);
  if (time > 0) return time;
  const Parameter* close = camera->find("shutterclose");
  diagnostics.warning((close ? close : camera->find("shutteropen"))->value_location(0),
                      "the shutter opens for no time: one second is taken");
  return 1;
}

// Bradford adaptation from the white of a colour temperature to the white of Rec. 709.
glm::dmat3 white_balance(double kelvin) {
  if (!(kelvin > 0)) return glm::dmat3(1);
  const glm::dvec3 white = tristimulus(daylight(kelvin));
  const glm::dmat3& ours = xyz_to_ours();
  const glm::dmat3 back = glm::inverse(ours);
  return ours * adaptation(white / white.y, back * glm::dvec3(1)) * back;
}

}  // namespace

Sensor build_sensor(const SceneDescription& description, DiagnosticList& diagnostics) {
  const Directive* film = description.film ? &*description.film : nullptr;
  const Directive* camera = description.camera ? &*description.camera : nullptr;
  if (film) check_name(*film, diagnostics);
  const double exposure = exposure_time(film, camera, diagnostics) * number(film, "iso", 100) / 100;
  const double kelvin = number(film, "whitebalance", 0);
  Sensor sensor;
  if (exposure == 1 && !(kelvin > 0)) return sensor;
  sensor.neutral = false;
  sensor.response = glm::mat3(exposure * white_balance(kelvin));
  return sensor;
}

}  // namespace kaustik
