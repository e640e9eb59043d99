#include "core/scene/build/medium_check.h"

#include <fmt/format.h>

#include <array>

namespace kaustik {

namespace {

// Media that a path can reach from one, by way of surfaces that separate two.
using ReachedMedia = std::array<bool, kMostMedia + 1>;

bool lets_light_through(const Material& material) {
  if (material.mixed()) return true;
  return std::visit(
      []<class B>(const B&) {
        return B::kTransmits || std::is_same_v<B, Dielectric> || std::is_same_v<B, ThinDielectric>;
      },
      material.typical());
}

// materials: null for interfaces.
bool join(const std::vector<Shape>& shapes, const std::vector<Material>* materials, ReachedMedia* reached) {
  bool more = false;
  for (const Shape& shape : shapes) {
    if (materials && !lets_light_through((*materials)[shape.material])) continue;
    bool& inside = (*reached)[shape.media.inside];
    bool& outside = (*reached)[shape.media.outside];
    more |= inside != outside;
    inside = outside = inside || outside;
  }
  return more;
}

ReachedMedia reached_from(const Scene& scene, MediumIndex medium) {
  ReachedMedia reached{};
  reached[medium] = true;
  for (bool more = true; more;) {
    more = join(scene.shapes, &scene.materials, &reached);
    if (scene.interfaces) more |= join(scene.interfaces->shapes, nullptr, &reached);
  }
  return reached;
}

}  // namespace

void check_camera_medium(const Scene& scene, const SourceLocation& camera, DiagnosticList& diagnostics) {
  if (scene.media.empty()) return;
  const ReachedMedia reached = reached_from(scene, scene.camera_medium);
  for (const MediumIndex medium : scene.light_media) {
    if (reached[medium]) continue;
    diagnostics.warning(camera,
                        fmt::format("the camera is in medium `{}` and light in `{}`, but no surface that "
                                    "lets light through separates them: should "
                                    "`MediumInterface` stand before `Camera`?",
                                    scene.medium_names[scene.camera_medium], scene.medium_names[medium]));
    return;
  }
}

}  // namespace kaustik
