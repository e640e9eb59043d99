#pragma once
// The area lights of a description, and the lights that they make of shapes.

#include <optional>
#include <vector>

#include "core/scene/build/light_images.h"
#include "core/scene/build/texture_table.h"

namespace kaustik {

// False, with an error: a light of infinite power would emit nothing, since no photon can carry its share.
bool is_power(const Rgb& power, const SourceLocation& where, DiagnosticList& diagnostics);

class LightTable {
 public:
  // Checks every area light and reads its image. All must outlive the table.
  LightTable(const SceneDescription& description, LightImages& images, const TextureTable& textures,
             WarnedOnce& warned, DiagnosticList& diagnostics);

  // Adds the light that the described shape is and notes it in `shape`, which is placed and has its alpha.
  // False, with an error added, where it cannot shine.
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
