#include "apps/import/view/view.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "apps/command_line/values.h"
#include "apps/import/common/make_parameter.h"
#include "apps/import/view/stand_in_sky.h"
#include "apps/import/view/studio.h"

namespace kaustik {
namespace {

class ViewMaker {
 public:
  ViewMaker(SceneDescription& scene, const ViewOptions& options, Convention convention,
            Diagnostics& diagnostics)
      : scene_(scene), options_(options), convention_(convention), diagnostics_(diagnostics) {}

  void apply() {
    const bool had_camera = scene_.camera.has_value(), sky_given = !options_.sky.empty();
    // The command line's sky replaces every one that the file has.
    if (sky_given)
      std::erase_if(scene_.lights, [](const LightDescription& light) { return light.type == "infinite"; });
    if (convention_ == Convention::kRightHanded) {
      const double share = emitted_share(scene_, diagnostics_.files);
      const bool dark = share < kLeastEmittedShare;
      if (!had_camera) add_camera();
      if (dark && !sky_given) add_light(share, had_camera);
      const bool alone = dark && !had_camera && options_.sky != "off";
      if (options_.floor == Floor::kOn || (options_.floor == Floor::kAuto && alone)) add_floor();
    } else if (options_.floor == Floor::kOn) {
      complain("--floor on is for glTF and OBJ files: a pbrt file says itself where its ground is");
    }
    if (sky_given && options_.sky != "off") add_sky();
    place_camera();
  }

  void place_camera() {
    if (options_.look_at) look_at();
    if (options_.fov) set_fov();
  }

 private:
  const SourceLocation& where() const { return scene_.location; }
  void complain(const std::string& message) { diagnostics_.error({}, message); }
  // Of the triangles of the file, over which one pass is enough.
  const ModelBox& box() {
    if (!box_) box_ = box_of(scene_);
    return *box_;
  }

  void add_camera() {
    add_studio_camera(scene_, box(), options_.aspect, where());
    if (!options_.look_at)
      diagnostics_.warning(where(), "the file has no camera: one that sees the whole scene is used");
  }

  // A model alone is lit as in a studio. A file with a camera is a scene, whose surroundings are not for us
  // to furnish.
  void add_light(double share, bool had_camera) {
    const std::string_view reach = share > 0 ? " that reaches its surfaces" : "";
    if (had_camera) {
      add_even_sky(glm::dvec3(1));
      return diagnostics_.warning(
          where(), fmt::format("the file has no light{}: a white sky of radiance 1 is used", reach));
    }
    if (const auto error = add_studio_light(scene_, box(), diagnostics_.files, where()))
      return complain(fmt::format("cannot make the studio's light: {}", *error));
    diagnostics_.warning(where(), fmt::format("the file has no light{}: it is shown in a studio; --sky sets "
                                              "another light, --floor off leaves the floor out",
                                              reach));
  }

  void add_floor() {
    if (box().empty) return complain("--floor on: the file has no triangles to stand on a floor");
    add_studio_floor(scene_, box(), where());
  }

  void add_even_sky(const glm::dvec3& radiance) {
    DirectiveMaker<LightDescription> sky("infinite", where());
    sky.rgb("L", radiance);
    scene_.lights.push_back(std::move(*sky));
  }

  void add_sky() {
    if (const auto colour = app::parse_colour(options_.sky)) return add_even_sky(glm::dvec3(*colour));
    add_sky_image();
  }

  void add_sky_image() {
    std::error_code ignored;
    const std::filesystem::path path = std::filesystem::absolute(options_.sky, ignored);
    // A file that may not be read is refused when the light is made: a partial result may have named it.
    const ReadableFile file = diagnostics_.files.root().find(path);
    if (!file.refused() && !file.exists())
      return complain(fmt::format("--sky: there is no file \"{}\"", options_.sky));
    DirectiveMaker<LightDescription> sky("infinite", where());
    sky.text("filename", (file.refused() ? path : file.place()).string());
    // The map's axis +z is up: in the world that is +y. The middle of the map lies ahead of a camera at +z
    // that looks along -z.
    sky->light_to_world = glm::dmat4(glm::dvec4(0, 0, 1, 0), glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 1, 0, 0),
                                     glm::dvec4(0, 0, 0, 1));
    scene_.lights.push_back(std::move(*sky));
  }

  // The scene's camera, or pbrt's default where there is none.
  CameraDescription& camera() {
    if (!scene_.camera) scene_.camera = std::move(*DirectiveMaker<CameraDescription>("perspective", where()));
    return *scene_.camera;
  }

  void look_at() {
    const auto& v = *options_.look_at;
    const glm::dvec3 eye(v[0], v[1], v[2]), target(v[3], v[4], v[5]), up(v[6], v[7], v[8]);
    const glm::dvec3 ahead = target - eye;
    const double sine = glm::length(glm::cross(ahead, up)) / (glm::length(ahead) * glm::length(up));
    if (!(sine > 1e-9))
      return complain("--look-at: eye and target must differ, and up must not point along the line of sight");
    glm::dmat4 to_world = camera_looking_along(eye, glm::normalize(ahead), glm::normalize(up));
    if (!is_right_handed()) to_world[0] = -to_world[0];
    camera().camera_to_world = to_world;
  }

  // Whether the scene's world, as its camera shows it, is right-handed: pbrt's is not, unless the file
  // mirrors it.
  bool is_right_handed() const {
    if (!scene_.camera) return convention_ == Convention::kRightHanded;
    return glm::determinant(glm::dmat3(scene_.camera->camera_to_world)) < 0;
  }

  void set_fov() {
    CameraDescription& camera = this->camera();
    if (camera.type != "perspective")
      return complain(fmt::format("--fov is for perspective cameras: this one is {}", camera.type));
    std::erase_if(camera.parameters, [](const Parameter& p) { return p.name == "fov"; });
    camera.parameters.push_back(
        make_parameter(ParameterType::kFloat, "fov", std::vector<double>{*options_.fov}, where()));
  }

  SceneDescription& scene_;
  const ViewOptions& options_;
  Convention convention_;
  Diagnostics& diagnostics_;
  std::optional<ModelBox> box_;
};

}  // namespace

void apply_view(SceneDescription& scene, const ViewOptions& options, Convention convention,
                Diagnostics& diagnostics) {
  ViewMaker(scene, options, convention, diagnostics).apply();
}

void apply_camera(SceneDescription& scene, const ViewOptions& options, Convention convention,
                  Diagnostics& diagnostics) {
  ViewMaker(scene, options, convention, diagnostics).place_camera();
}

}  // namespace kaustik
