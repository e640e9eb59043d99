#include "apps/import/view/studio.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "apps/import/common/made_files.h"
#include "apps/import/common/make_parameter.h"
#include "apps/import/common/unique_names.h"
#include "core/sampling/equal_area.h"
#include "render/picture/image_io.h"

namespace kaustik {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFloorReflectance = 0.42;
constexpr int kImageSide = 512;  // pixels of 0.4 degrees squared

// A unit vector at an azimuth from +z towards +x, in degrees.
glm::dvec3 direction_of(double azimuth, double elevation) {
  const double a = glm::radians(azimuth), e = glm::radians(elevation);
  return {std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)};
}

// 0 below `from`, 1 above `to`, smooth between.
double step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// The light beside the model and slightly behind it, so that glass throws its caustics towards the camera.
constexpr double kLightAzimuth = -100, kLightElevation = 48, kLightRadius = 6;

// The angle between w and the middle of the light, in degrees.
double angle_from_light(const glm::dvec3& w) {
  static const glm::dvec3 kCenter = direction_of(kLightAzimuth, kLightElevation);
  return glm::degrees(std::acos(std::clamp(glm::dot(w, kCenter), -1.0, 1.0)));
}

double light_shape(const glm::dvec3& w) {
  return 1 - step(kLightRadius - 0.5, kLightRadius + 0.5, angle_from_light(w));
}

// Everything but the light: the background, a darker side behind the camera, in which mirrors and glass show
// their shape, and a wide soft panel that brightens the faces turned to the camera.
double surroundings(const glm::dvec3& w) {
  const double behind = step(0.1, 0.6, w.z);
  const double room = kStudioBackground * (1 - 0.7 * behind);
  const double azimuth = glm::degrees(std::atan2(w.x, w.z)), elevation = glm::degrees(std::asin(w.y));
  const double panel = step(15, 22, azimuth) * (1 - step(63, 70, azimuth)) * step(12, 19, elevation) *
                       (1 - step(53, 60, elevation));
  return room + 1.7 * panel;
}

// The integral of f times the cosine over the upper hemisphere.
template <class F>
double irradiance(const F& f, int steps) {
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < 2 * steps; ++j) {
      const double sin2 = (i + 0.5) / steps, phi = kPi * (j + 0.5) / steps;
      const double r = std::sqrt(sin2);
      sum += f(glm::dvec3(r * std::sin(phi), std::sqrt(1 - sin2), r * std::cos(phi)));
    }
  }
  return sum * kPi / (2.0 * steps * steps);
}

// The radiance of the light with which an open floor is as bright as the background:
// kFloorReflectance / pi times the irradiance = kStudioBackground.
double light_radiance() {
  static const double radiance =
      (kPi * kStudioBackground / kFloorReflectance - irradiance(surroundings, 128)) /
      irradiance(light_shape, 512);
  return radiance;
}

// The direction from the model to the camera. Flat models are seen from higher up, and models that are much
// deeper than wide from the side.
glm::dvec3 studio_direction(const ModelBox& box) {
  const glm::dvec3 size = box.high - box.low;
  const double wide = std::max(size.x, size.z);
  const double flat = wide > 0 ? 1 - std::min(1.0, size.y / wide) : 0;
  return direction_of(size.z > 2 * size.x ? 60 : 28, 15 + 20 * flat * flat);
}

struct CameraFrame {
  glm::dvec3 right, up, ahead;
};

CameraFrame frame_of(const glm::dvec3& ahead, const glm::dvec3& up) {
  const glm::dvec3 right = glm::normalize(glm::cross(ahead, up));
  return {right, glm::cross(right, ahead), ahead};
}

// The nearest eye from which all points lie within the picture's middle part. Each side of the picture is a
// plane through the eye that must have all points on its inner side.
glm::dvec3 fitting_eye(const SceneDescription& scene, const CameraFrame& frame, double aspect) {
  constexpr double kFilled = 0.8;  // of the picture
  const double t = kFilled * std::tan(glm::radians(kStudioFov / 2));
  const double tx = t * std::max(1.0, aspect), ty = t * std::max(1.0, 1 / aspect);
  std::array<double, 4> most;
  most.fill(-std::numeric_limits<double>::infinity());
  for_points(scene, [&](const glm::dvec3& p) {
    const double x = glm::dot(p, frame.right), y = glm::dot(p, frame.up), z = glm::dot(p, frame.ahead);
    const std::array<double, 4> sides = {x - tx * z, -x - tx * z, y - ty * z, -y - ty * z};
    for (size_t i = 0; i < sides.size(); ++i) most[i] = std::max(most[i], sides[i]);
  });
  const double z = std::min(-(most[0] + most[1]) / (2 * tx), -(most[2] + most[3]) / (2 * ty));
  return (most[0] - most[1]) / 2 * frame.right + (most[2] - most[3]) / 2 * frame.up + z * frame.ahead;
}

glm::dvec3 pixel_direction(double x, double y) {
  return glm::dvec3(equal_area_square_to_sphere(Point2(glm::dvec2(x, y) / double(kImageSide))));
}

// The mean radiance of a pixel. Only the edge of the light is sharp enough to need several samples.
double pixel_radiance(int x, int y) {
  const glm::dvec3 middle = pixel_direction(x + 0.5, y + 0.5);
  if (std::abs(angle_from_light(middle) - kLightRadius) > 2) return studio_radiance(middle);
  constexpr int kSub = 4;  // samples along each side
  double sum = 0;
  for (int s = 0; s < kSub * kSub; ++s)
    sum += studio_radiance(pixel_direction(x + (s % kSub + 0.5) / kSub, y + (s / kSub + 0.5) / kSub));
  return sum / (kSub * kSub);
}

render::Image studio_image() {
  render::Image image(kImageSide, kImageSide);
  for (int y = 0; y < kImageSide; ++y)
    for (int x = 0; x < kImageSide; ++x) image.at(x, y) = Rgb(static_cast<float>(pixel_radiance(x, y)));
  return image;
}

}  // namespace

glm::dmat4 camera_looking_along(const glm::dvec3& eye, const glm::dvec3& ahead, const glm::dvec3& up) {
  const CameraFrame frame = frame_of(ahead, up);
  return {glm::dvec4(frame.right, 0), glm::dvec4(frame.up, 0), glm::dvec4(frame.ahead, 0),
          glm::dvec4(eye, 1)};
}

void add_studio_camera(SceneDescription& scene, const ModelBox& box, double aspect,
                       const SourceLocation& where) {
  const glm::dvec3 ahead = -studio_direction(box), up(0, 1, 0);
  glm::dvec3 eye = box.empty ? -ahead : fitting_eye(scene, frame_of(ahead, up), aspect);
  // A model that is a single point has no extent to fill the picture with.
  if (!box.empty && box.low == box.high) eye = box.center() - ahead;
  DirectiveMaker<CameraDescription> camera("perspective", where);
  camera.number("fov", kStudioFov);
  camera->camera_to_world = camera_looking_along(eye, ahead, up);
  scene.camera = std::move(*camera);
}

double studio_radiance(const glm::dvec3& w) {
  return surroundings(w) + light_radiance() * light_shape(w);
}

std::optional<std::string> add_studio_light(SceneDescription& scene, const ModelBox& box, SourceFiles& files,
                                            const SourceLocation& where) {
  const MadeFiles made(files, scene);
  try {
    render::write_image(made.path("studio.exr").string(), studio_image());
  } catch (const render::ImageError& error) {
    return error.what();
  }
  DirectiveMaker<LightDescription> light("infinite", where);
  light.add(make_parameter(ParameterType::kString, "filename", std::string("studio.exr"), made.where()));
  const glm::dvec3 to_camera = studio_direction(box);
  const glm::dvec3 up(0, 1, 0), z = glm::normalize(glm::dvec3(to_camera.x, 0, to_camera.z));
  light->light_to_world = glm::dmat4(glm::dvec4(glm::cross(up, z), 0), glm::dvec4(up, 0), glm::dvec4(z, 0),
                                     glm::dvec4(0, 0, 0, 1));
  scene.lights.push_back(std::move(*light));
  return std::nullopt;
}

void add_studio_floor(SceneDescription& scene, const ModelBox& box, const SourceLocation& where) {
  // Faces that lie on the ground and the floor must not share a plane.
  constexpr double kGap = 1e-3, kRadius = 8;
  UniqueNames names;
  for (const MaterialDescription& m : scene.materials) names.take(m.name);
  const std::string name = names.take("studio floor");
  DirectiveMaker<MaterialDescription> material("diffuse", where);
  material.rgb("reflectance", glm::dvec3(kFloorReflectance));
  material->name = name;
  material->name_location = where;
  scene.materials.push_back(std::move(*material));
  DirectiveMaker<ShapeDescription> disk("disk", where);
  disk.number("radius", kRadius * box.radius());
  disk->name = "studio floor";
  disk->material = {std::nullopt, name, where};
  const glm::dvec3 c = box.center();
  // The disk's normal +z becomes +y.
  disk->object_to_world = glm::dmat4(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 1, 0, 0),
                                     glm::dvec4(c.x, box.low.y - kGap * box.radius(), c.z, 1));
  scene.shapes.push_back(std::move(*disk));
}

}  // namespace kaustik
