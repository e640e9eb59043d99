#pragma once
// The area lights of a description, and the Light values made from them.

#include <optional>
#include <vector>

#include "core/scene/build/texture_table.h"
#include "core/scene/schema/light_images.h"

namespace kaustik {

// Returns false, with an error, if the power is not finite: no photon could carry its share.
bool is_power(const Rgb& power, const SourceLocation& where, DiagnosticList& diagnostics);

class LightTable {
 public:
  // Checks every area light and reads its image. The arguments must outlive the table.
  LightTable(const SceneDescription& description, LightImages& images, const TextureTable& textures,
             WarnedOnce& warned, DiagnosticList& diagnostics);

  // Makes the described shape a light: adds it to `lights` and sets shape.light. The shape must be placed and
  // have its alpha; it becomes triangles if it cannot emit otherwise. Returns false, with an error added, if
  // the shape cannot emit.
  bool make(const ShapeDescription& description, Shape& shape, std::vector<Light>& lights) const;

 private:
  struct AreaLight {
    const TypeSpec* spec = nullptr;  // null after an error
    std::shared_ptr<const LightImage> image;
  };
  AreaLight check(const Directive& directive, LightImages& images, WarnedOnce& warned);
  bool scale(const ParameterReader& parameters, DiffuseAreaLight& light) const;

  const SceneDescription& description_;
  const TextureTable& textures_;
  DiagnosticList& diagnostics_;
  std::vector<AreaLight> area_lights_;
};

}  // namespace kaustik
