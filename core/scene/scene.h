#pragma once
// The scene in the form that is rendered: plain data, built once by build_scene and const from then on.

#include <memory>
#include <string>
#include <vector>

#include "core/camera/camera.h"
#include "core/camera/sensor.h"
#include "core/geometry/interaction.h"
#include "core/light/choice/light_sampler.h"
#include "core/medium/emissive_bodies.h"
#include "core/scene/material.h"
#include "core/scene/needs.h"

namespace kaustik {

// Enough for the lights that matter along a ray through fog; each takes a few arc tangents.
inline constexpr size_t kMostStrongLights = 8;

struct Scene {
  // World coordinates minus this origin (metres) are the coordinates of everything below. Zero unless the
  // scene lies far from the world's origin (core/scene/build/local_origin.h).
  glm::dvec3 origin{0};
  Camera camera;
  Sensor sensor;
  std::vector<Shape> shapes;
  std::vector<Material> materials;
  std::shared_ptr<const TextureSet> textures;  // named by materials and shapes by index; may be null
  std::vector<std::string> material_names;     // for `kaustik info`
  std::vector<std::string> surface_group_names;
  std::vector<Medium> media;  // by MediumIndex; the first is the vacuum. Empty where there are no others
  std::vector<std::string> medium_names;  // by MediumIndex, for messages and `kaustik info`
  MediumIndex camera_medium = kVacuum;
  // Surfaces that rays do not meet, and that separate media: a scene of their shapes and bounds alone. Null
  // if there are none.
  std::shared_ptr<const Scene> interfaces;
  std::vector<Light> lights;
  std::vector<MediumIndex> light_media;   // where each light shines; empty where all do so in the vacuum
  DiscreteDistribution light_power;       // probabilities for photon emission
  LightSampler light_sampler;             // for next-event estimation
  std::vector<uint32_t> infinite_lights;  // indices into lights
  // The lights with a place and most power, at most kMostStrongLights; empty where no medium scatters.
  std::vector<uint32_t> strongest_lights;
  EmissiveBodies emissive_bodies;  // what interfaces bound of media that emit
  Bounds3 bounds;                  // of all shapes
  SceneNeeds needs;
  std::shared_ptr<const void> keeps;  // temporary files that must exist while the scene is rendered
};

// Computes what follows from shapes, materials and lights: bounds, the scene spheres of distant and infinite
// lights, light_power, light_sampler, infinite_lights and needs. Called by build_scene, and by tests that
// make scenes in code.
void finalize_scene(Scene& scene);

}  // namespace kaustik
