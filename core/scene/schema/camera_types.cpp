// Schema rows of cameras and pixel filters.

#include "core/scene/schema/parameter_spec.h"

namespace kaustik {
namespace {

using namespace spec;
using Type = ParameterType;

// Adds the parameters that all cameras of pbrt have.
std::vector<ParameterSpec> camera(std::vector<ParameterSpec> own) {
  own.push_back(number("shutteropen", 0, "s", kAnyNumber, "start of the exposure; nothing moves"));
  own.push_back(number("shutterclose", 1, "s", kAnyNumber,
                       "end of the exposure; radiance is multiplied by its duration"));
  return own;
}

std::vector<ParameterSpec> window_and_lens(std::string_view window_doc) {
  ParameterSpec window =
      list(Type::kFloat, "screenwindow", 4, "shape of the film, shorter side from -1 to 1", "", window_doc);
  window.max_items = 4;
  return {
      without_default(number("frameaspectratio", 0, "", kPositive, "width over height"), "that of the film"),
      window, number("lensradius", 0, "m", kNotNegative, "radius of the lens; 0: everything is sharp"),
      number("focaldistance", 1e6, "m", kPositive, "distance along +z at which points are in focus")};
}

std::vector<TypeSpec> make_camera_types() {
  std::vector<ParameterSpec> perspective = {
      number("fov", 90, "degrees", {0, 180, true, true}, "full angle of the shorter image side")};
  for (ParameterSpec& p : window_and_lens("x min, x max, y min, y max of the image plane"))
    perspective.push_back(std::move(p));
  const std::string_view no_lens = "a spherical camera has no lens";
  return {{"perspective", "Pinhole or thin lens at the origin of camera space: +x right, +y up, +z forward.",
           camera(std::move(perspective))},
          {"orthographic", "Parallel rays along +z. The screen window is in metres.",
           camera(window_and_lens("x min, x max, y min, y max, metres"))},
          {"spherical",
           "All directions, +y up. The image's middle looks along -x (`equirectangular`) or along +y "
           "(`equalarea`), as in pbrt.",
           camera({text("mapping", "equalarea",
                        "`equirectangular`: rows are latitudes, columns longitudes; `equalarea`: Clarberg's "
                        "square map, in which all pixels have the same solid angle"),
                   ignored("lensradius", {Type::kFloat}, no_lens, 0),
                   ignored("focaldistance", {Type::kFloat}, no_lens),
                   ignored("frameaspectratio", {Type::kFloat}, "the image holds the whole sphere"),
                   ignored("screenwindow", {Type::kFloat}, "the image holds the whole sphere")})}};
}

TypeSpec filter(std::string_view name, std::string_view doc, double radius,
                std::vector<ParameterSpec> more = {}) {
  const Range range{0, 1024, true, false};
  TypeSpec type{
      name,
      doc,
      {number("xradius", radius, "pixels", range, "half width along a row, from the centre of the pixel"),
       number("yradius", radius, "pixels", range, "half width along a column")}};
  for (ParameterSpec& p : more) type.parameters.push_back(std::move(p));
  return type;
}

std::vector<TypeSpec> make_filter_types() {
  return {
      filter("box", "The mean over a rectangle. With radius 0.5, the default, it is the pixel's own square.",
             0.5),
      filter("triangle", "Falls off linearly.", 2),
      filter("gaussian", "A normal distribution minus its value at the radius.", 1.5,
             {number("sigma", 0.5, "pixels", kPositive, "standard deviation")}),
      filter("mitchell", "Mitchell and Netravali 1988. Negative in places.", 2,
             {number("B", 1.0 / 3, "", kAnyNumber, "blur"), number("C", 1.0 / 3, "", kAnyNumber, "ringing")}),
      filter("sinc", "sin(pi x) / (pi x), windowed (Lanczos). Negative in places.", 4,
             {number("tau", 3, "pixels", kPositive, "width of the window's first lobe")}),
  };
}

}  // namespace

const std::vector<TypeSpec>& camera_types() {
  static const std::vector<TypeSpec> types = make_camera_types();
  return types;
}
const std::vector<TypeSpec>& filter_types() {
  static const std::vector<TypeSpec> types = make_filter_types();
  return types;
}

}  // namespace kaustik
