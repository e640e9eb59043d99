#pragma once
// The scene as it is rendered: plain data, built once by build_scene and const from then on.

#include <memory>
#include <string>
#include <vector>

#include "core/camera/camera.h"
#include "core/camera/sensor.h"
#include "core/geometry/interaction.h"
#include "core/light/choice/light_sampler.h"
#include "core/scene/material.h"
#include "core/scene/needs.h"

namespace kaustik {

struct Scene {
  // World coordinates less this, in metres, are what everything below holds. Zero unless the scene lies far
  // from the world's origin (core/scene/build/local_origin.h).
  glm::dvec3 origin{0};
  Camera camera;
  Sensor sensor;
  std::vector<Shape> shapes;
  std::vector<Material> materials;
  std::shared_ptr<const TextureSet> textures;  // that materials and shapes name by index; may be null
  std::vector<std::string> material_names;     // for `kaustik info`
  std::vector<std::string> surface_group_names;
  std::vector<Light> lights;
  DiscreteDistribution light_power;       // probabilities of emission
  LightSampler light_sampler;             // and of next-event estimation
  std::vector<uint32_t> infinite_lights;  // indices into lights
  Bounds3 bounds;                         // of all shapes
  SceneNeeds needs;
  std::shared_ptr<const void> keeps;  // files that are read while it is rendered
};

// Fills what follows from shapes, materials and lights: bounds, scene spheres of distant and infinite lights,
// light_power, light_sampler, infinite_lights, needs. Called by build_scene, and by tests that make scenes in
// code.
void finalize_scene(Scene& scene);

}  // namespace kaustik
