#include "apps/import/pbrt/realistic_camera.h"

#include <fmt/format.h>

#include <glm/glm.hpp>

#include "apps/import/common/make_parameter.h"
#include "apps/import/pbrt/parameter_parser.h"

namespace kaustik::pbrt {
namespace {

// One surface of a lens file, in mm, listed from the front. A radius of zero is a plane or the aperture stop.
struct Element {
  double radius, thickness, eta;
};

std::optional<std::vector<Element>> read_lens(uint32_t file, const SourceLocation& where,
                                              Diagnostics& diagnostics) {
  const auto numbers = read_numbers(file, where, diagnostics);
  if (!numbers) return std::nullopt;
  if (numbers->empty() || numbers->size() % 4 != 0) {
    diagnostics.error(where,
                      fmt::format("a lens has rows of radius, thickness, index and diameter, not {} numbers",
                                  numbers->size()));
    return std::nullopt;
  }
  std::vector<Element> lens;
  for (size_t i = 0; i < numbers->size(); i += 4)
    lens.push_back({(*numbers)[i].value, (*numbers)[i + 1].value, (*numbers)[i + 2].value});
  return lens;
}

// The paraxial focal length in mm: traces a ray that enters parallel to the axis and divides its height by
// its slope behind the lens (Hecht 2016, section 6.2).
double focal_length(const std::vector<Element>& lens) {
  double y = 1, slope = 0, eta = 1;  // `slope` is multiplied by the index of refraction
  for (const Element& e : lens) {
    const double behind = e.eta > 0 ? e.eta : 1;
    if (e.radius != 0) {
      slope -= y * (behind - eta) / e.radius;
      eta = behind;
    }
    y += e.thickness * slope / eta;
  }
  return -1 / slope;
}

double number(const Directive* d, std::string_view name, double otherwise) {
  const Parameter* p = d ? d->find(name) : nullptr;
  return p && p->numbers.size() == 1 && p->numbers[0] > 0 ? p->numbers[0] : otherwise;
}

// The angle in degrees that the film's shorter side subtends at `distance` (mm) from the lens.
double field_of_view(const Directive* film, double distance) {
  const double x = number(film, "xresolution", 1280), y = number(film, "yresolution", 720);
  const double shorter = number(film, "diagonal", 35) * std::min(x, y) / std::hypot(x, y);
  return glm::degrees(2 * std::atan(shorter / 2 / distance));
}

}  // namespace

void replace_realistic_camera(CameraDescription& replaced, const Directive* film, const TextOpener& open,
                              Diagnostics& diagnostics) {
  const CameraDescription camera = replaced;
  replaced.type = "perspective";
  replaced.parameters.clear();
  const Parameter* name = camera.find("lensfile");
  if (!name || name->strings.size() != 1)
    return diagnostics.error(camera.type_location, "camera \"realistic\" needs `lensfile`");
  const OpenedText opened = open(name->strings[0]);
  if (!opened.file) return diagnostics.error(name->value_location(0), opened.error);
  const auto lens = read_lens(*opened.file, name->value_location(0), diagnostics);
  if (!lens) return;
  const double focus = number(&camera, "focusdistance", 10), f = focal_length(*lens);
  const double distance = 1 / (1 / f - 1 / (1000 * focus));
  if (!(f > 0 && distance > 0 && std::isfinite(distance)))
    return diagnostics.error(name->value_location(0),
                             "this lens forms no image: its focal length is not positive or "
                             "exceeds `focusdistance`");
  const double radius = number(&camera, "aperturediameter", 1) / 2000, fov = field_of_view(film, distance);
  diagnostics.warning(
      camera.type_location,
      fmt::format("camera \"realistic\" becomes \"perspective\" with a thin lens of the same focal "
                  "length, {:.4g} mm: fov {:.4g}, lensradius {:.4g}, focaldistance {:.4g}",
                  f, fov, radius, focus));
  for (const auto& [to, value] : {std::pair{"fov", fov}, {"lensradius", radius}, {"focaldistance", focus}})
    replaced.parameters.push_back(
        make_parameter(ParameterType::kFloat, to, std::vector<double>{value}, camera.type_location));
  for (const char* kept : {"shutteropen", "shutterclose"}) {
    if (const Parameter* p = camera.find(kept)) replaced.parameters.push_back(*p);
  }
}

}  // namespace kaustik::pbrt
