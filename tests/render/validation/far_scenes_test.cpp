// Tests that scenes far from the world's origin render like copies at the origin
// (core/scene/build/local_origin.h).

#include <gtest/gtest.h>

#include <fstream>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/build/builder.h"
#include "tests/render/support/image_statistics.h"
#include "tests/render/support/scene_files.h"

namespace kaustik::render {
namespace {

using namespace test;

// How the scene is moved: by transforms, or by the coordinates of the vertices of shapes without a transform.
enum class Way { kTransforms, kCoordinates };

void move_shape(const glm::dvec3& move, Way way, ShapeDescription& shape) {
  const bool by_coordinates = way == Way::kCoordinates && shape.object_to_world == glm::dmat4(1);
  for (Parameter& p : shape.parameters) {
    if (p.name != "P" || !by_coordinates) continue;
    for (size_t i = 0; i < p.numbers.size(); ++i) p.numbers[i] += move[static_cast<int>(i % 3)];
    return;
  }
  shape.object_to_world = glm::translate(glm::dmat4(1), move) * shape.object_to_world;
}

Scene moved(SceneDescription d, const glm::dvec3& move, Way way, int side) {
  const glm::dmat4 translation = glm::translate(glm::dmat4(1), move);
  for (ShapeDescription& shape : d.shapes) move_shape(move, way, shape);
  for (LightDescription& light : d.lights) light.light_to_world = translation * light.light_to_world;
  d.camera->camera_to_world = translation * d.camera->camera_to_world;
  Diagnostics diagnostics;
  auto scene = build_scene(d, nullptr, diagnostics);
  if (!scene) throw std::runtime_error(diagnostics.format_all());
  scene->camera.width = scene->camera.height = side;
  return std::move(*scene);
}

SceneDescription imported(const std::filesystem::path& path) {
  Diagnostics diagnostics;
  auto description = pbrt::import_scene(path, diagnostics);
  if (!description) throw std::runtime_error(path.string() + " does not load");
  return std::move(*description);
}

// A closed box whose walls emit 1 and reflect half; each wall is a mesh of its own.
SceneDescription furnace_box() {
  const std::string path = output_file("furnace-box.pbrt");
  std::ofstream file(path);
  file << "LookAt 0 0 0  1 0.5 0.25  0 1 0\nCamera \"perspective\" \"float fov\" 90\nWorldBegin\n"
          "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\n"
          "Material \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5]\n";
  for (const char* P : {"-1 -1 1  1 -1 1  1 -1 -1  -1 -1 -1", "-1 1 -1  1 1 -1  1 1 1  -1 1 1",
                        "-1 -1 -1  1 -1 -1  1 1 -1  -1 1 -1", "-1 -1 1  -1 1 1  1 1 1  1 -1 1",
                        "-1 -1 1  -1 -1 -1  -1 1 -1  -1 1 1", "1 -1 1  1 1 1  1 1 -1  1 -1 -1"})
    file << "Shape \"trianglemesh\" \"point3 P\" [" << P << "] \"integer indices\" [0 1 2 0 2 3]\n";
  file.close();
  return imported(path);
}

RenderSettings settings_of(Method method, uint64_t photons) {
  RenderSettings settings;
  settings.method = method;
  settings.spp = 16;
  settings.photons = photons;
  return settings;
}

void expect_sound(const RenderResult& result) {
  EXPECT_EQ(result.statistics.dropped_samples, 0u);
  EXPECT_EQ(result.statistics.clamped_sums, 0u);
  EXPECT_EQ(result.statistics.photons.dropped_invalid, 0u);
  EXPECT_EQ(result.statistics.photons.energy.unaccounted(), 0);
}

// The scenes are 2 m in size and moved by this many of their sizes, in irregular directions and by irregular
// numbers. At the smallest number the scene is still built in the world's coordinates.
constexpr double kNear = 25;
constexpr double kMoves[] = {kNear, 1e3, 1e4, 1e5, 1e6, 1e9};
glm::dvec3 move_of(double sizes) {
  return 2 * sizes * glm::dvec3(1.1, -0.53, 0.77) + glm::dvec3(0.37, 0.71, -0.23);
}

// How far points may be displaced, in sizes. Coordinates are written and moved in double, each at most 1.1
// `sizes`: half a spacing, 2^-53, for each of the two roundings. Then they are rounded to float where they,
// including the eye, are at most 4 sizes, or 1.1 kNear + 1, from the origin, as are computed surface points:
// two roundings of 2^-24.
double displacement(double sizes) {
  const double from_origin = sizes == kNear ? 1.1 * kNear + 1 : 4;
  return 2 * 0x1p-24 * from_origin + 2 * 0x1p-53 * 1.1 * sizes;
}

// If points are displaced sideways by v, half of those within v of an edge come to lie behind the
// neighbouring wall. Each wall has four edges: 1/2 * 4 * v of its points are lost, and that share of the
// radiance. The noise is that of 32^2 pixels of 16 samples; a sample's standard deviation is below 1, so the
// tolerance is 4 of 1/128.
TEST(FarScenes, FurnaceHasNoHoles) {
  for (const Method method : {Method::kMc, Method::kPhoton})
    for (const Way way : {Way::kTransforms, Way::kCoordinates})
      for (const double sizes : kMoves) {
        SCOPED_TRACE(sizes);
        const Scene scene = moved(furnace_box(), move_of(sizes), way, 32);
        EXPECT_EQ(scene.origin == glm::dvec3(0), sizes == kNear);
        const auto result = render_with_threads(scene, settings_of(method, 50'000));
        expect_sound(result);
        EXPECT_NEAR(total_mean(result.film), 2, 2 * 2 * displacement(sizes) + 4.0 / 128);
        for (int y = 0; y < 32; ++y)
          for (int x = 0; x < 32; ++x) EXPECT_GE(result.film.at(x, y).radiance().x, 1) << x << " " << y;
        const photon::EnergyLedger& e = result.statistics.photons.energy;
        EXPECT_LE(double(e.escaped), 2 * displacement(sizes) * double(e.emitted));
      }
}

// The distance that each pixel sees is that at the origin, up to the displacements of both pictures' eye and
// point, 16 times as much where the surface is seen at a slant of 1/16. Only pixels on outlines may differ: 1
// %. A surface with holes would fail at every second pixel.
void expect_same_depth(const Film& film, const Film& reference, double sizes) {
  const double tolerance = 16 * 2 * 2 * (displacement(sizes) + displacement(0));
  int different = 0;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const double d = double(film.at(x, y).depth) - double(reference.at(x, y).depth);
      different += std::abs(d) > tolerance ? 1 : 0;
    }
  EXPECT_LE(different, film.width() * film.height() / 100);
}

// Displacements move the smallest objects, the light and spheres of a quarter of the scene's size, and so
// change their solid angles by up to 4 * 2 displacements; visible points are lost as in the furnace, at most
// 4: 12 in all, in both pictures. The random numbers are the same, so noise shows only where a path meets
// something else: 0.1 %, and 1 % of the classes whose paths have fireflies.
TEST(FarScenes, BoxWithSpheresKeepsItsLight) {
  const SceneDescription cornell =
      imported(std::filesystem::path(KAUSTIK_SCENES_DIR) / "cornell-spheres/square-lamp-2.pbrt");
  for (const Method method : {Method::kMc, Method::kPhoton}) {
    const auto settings = settings_of(method, 100'000);
    const auto reference = render_with_threads(moved(cornell, {}, Way::kTransforms, 48), settings);
    for (const Way way : {Way::kTransforms, Way::kCoordinates})
      for (const double sizes : kMoves) {
        SCOPED_TRACE(sizes);
        const auto result = render_with_threads(moved(cornell, move_of(sizes), way, 48), settings);
        expect_sound(result);
        expect_same_depth(result.film, reference.film, sizes);
        const double relative = 12 * (displacement(sizes) + displacement(0));
        for (const Layer layer : {Layer::kDirect, Layer::kCaustic, Layer::kIndirect}) {
          const double expected = layer_mean(reference.film, layer);
          const double noise = layer == Layer::kDirect ? 0.001 : 0.01;
          EXPECT_NEAR(layer_mean(result.film, layer), expected, expected * (relative + noise));
        }
        write_if_failed(result.film, "far");
      }
  }
}

// A ball of triangles whose corners are rounded to the nearest floats at `move`.
TriangleMesh rounded_ball(const Vector3& move) {
  constexpr uint32_t kRings = 8, kSectors = 16;
  TriangleMesh mesh;
  for (uint32_t ring = 0; ring <= kRings; ++ring)
    for (uint32_t sector = 0; sector < kSectors; ++sector) {
      const float theta = kPi * float(ring) / float(kRings), phi = 2 * kPi * float(sector) / float(kSectors);
      const float r = ring % kRings == 0 ? 0 : std::sin(theta);
      mesh.P.push_back(Vector3(r * std::cos(phi), r * std::sin(phi), std::cos(theta)) + move);
    }
  for (uint32_t ring = 0; ring < kRings; ++ring)
    for (uint32_t sector = 0; sector < kSectors; ++sector) {
      const uint32_t a = ring * kSectors + sector, b = ring * kSectors + (sector + 1) % kSectors;
      mesh.indices.push_back({a, a + kSectors, b + kSectors});
      mesh.indices.push_back({a, b + kSectors, b});
    }
  return mesh;
}

// At 1e5 sizes floats are 1/64 m apart: the ball is rough but closed, so it is a furnace of radiance 2. Half
// of its 32 triangles at the poles have no area. The noise is that of FurnaceHasNoHoles.
TEST(FarScenes, BallOfRoundedVerticesHasNoHoles) {
  const Vector3 move(1.1e5f, -0.53e5f, 2e5f);
  const std::string path = output_file("furnace-ball.pbrt");
  std::ofstream(path) << "LookAt 110000.2 -53000 200000  110001 -53000 200001  0 1 0\n"
                         "Camera \"perspective\" \"float fov\" 90\nWorldBegin\nReverseOrientation\n"
                         "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\n"
                         "Material \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5]\n"
                         "Shape \"plymesh\" \"string filename\" \"ball\"\n";
  Diagnostics diagnostics;  // receives the scene's warnings
  const auto description = pbrt::import_scene(path, diagnostics);
  ASSERT_TRUE(description);
  auto scene = build_scene(
      *description,
      [&](const auto&, const auto&) {
        return MeshResult{rounded_ball(move), {}};
      },
      diagnostics);
  ASSERT_TRUE(scene) << diagnostics.format_all();
  scene->camera.width = scene->camera.height = 32;
  for (const Method method : {Method::kMc, Method::kPhoton}) {
    const auto result = render_with_threads(*scene, settings_of(method, 50'000));
    expect_sound(result);
    EXPECT_NEAR(total_mean(result.film), 2, 4.0 / 128);
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x) EXPECT_GE(result.film.at(x, y).radiance().x, 1) << x << " " << y;
    EXPECT_EQ(result.statistics.photons.energy.escaped, 0u);
  }
}

}  // namespace
}  // namespace kaustik::render
