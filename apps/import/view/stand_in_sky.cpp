#include "apps/import/view/stand_in_sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "apps/import/common/image_files.h"
#include "apps/import/common/scene_files.h"
#include "core/math/hash.h"

namespace kaustik {
namespace {

constexpr double kLitAlready = std::numeric_limits<double>::infinity();
constexpr double kBrightEnough = 1;  // the radiance of white surfaces under the stand-in sky
constexpr size_t kReceivers = 2048, kEmitters = 128;

struct PlacedMesh {
  const ShapeDescription* shape = nullptr;
  glm::dmat4 to_world{1};
  double radiance = 0;  // luminance
  bool both_sides = false;

  const std::vector<double>* positions() const {
    const Parameter* P = shape->find("P");
    return P ? &P->numbers : nullptr;
  }
  size_t faces() const {
    const Parameter* indices = shape->find("indices");
    if (!positions()) return 0;
    return indices ? indices->numbers.size() / 3 : 1;
  }
};

// A point of a face with the face's area and unit normal on the side that emits.
struct SkySample {
  glm::dvec3 p{0}, n{0};
  double area = 0;
};

double uniform(uint64_t index, uint64_t dimension) {
  return double(hash_combine(index, dimension) >> 11) * 0x1p-53;
}

// The sample's area is 0 if the face is degenerate or not finite.
SkySample sample_of(const PlacedMesh& mesh, size_t face, uint64_t index) {
  const std::vector<double>& P = *mesh.positions();
  const Parameter* indices = mesh.shape->find("indices");
  std::array<glm::dvec3, 3> corner;
  for (size_t k = 0; k < 3; ++k) {
    const double vertex = indices ? indices->numbers[3 * face + k] : double(k);
    if (!(vertex >= 0 && 3 * vertex + 2 < double(P.size()))) return {};
    const double* const p = &P[3 * size_t(vertex)];
    corner[k] = glm::dvec3(mesh.to_world * glm::dvec4(p[0], p[1], p[2], 1));
  }
  const glm::dvec3 e1 = corner[1] - corner[0], e2 = corner[2] - corner[0], n = glm::cross(e1, e2);
  const double length = glm::length(n);
  if (!(length > 0 && std::isfinite(length))) return {};
  const bool flipped = mesh.shape->reverse_orientation != (glm::determinant(glm::dmat3(mesh.to_world)) < 0);
  const double root = std::sqrt(uniform(index, 1)), v = uniform(index, 2);
  return {corner[0] + (1 - root) * e1 + root * v * e2, (flipped ? -n : n) / length, 0.5 * length};
}

// Calls use(mesh, face, index) for `count` faces at equal distances in the list of all faces. Returns how
// many faces each of them stands for.
double for_faces(const std::vector<PlacedMesh>& meshes, size_t count,
                 const std::function<void(const PlacedMesh&, size_t, uint64_t)>& use) {
  size_t total = 0, before = 0;
  for (const PlacedMesh& mesh : meshes) total += mesh.faces();
  const double step = double(total) / double(count);
  uint64_t i = 0;
  for (const PlacedMesh& mesh : meshes) {
    const size_t faces = mesh.faces();
    for (; i < count; ++i) {
      const size_t face = std::min(size_t((double(i) + uniform(i, 0)) * step), total - 1);
      if (face >= before + faces) break;
      use(mesh, face - before, i);
    }
    before += faces;
  }
  return step;
}

class Radiances {
 public:
  Radiances(const SceneDescription& scene, const SourceFiles& files) : scene_(scene), files_(files) {}

  // The mean luminance of the radiance of an area light.
  double operator()(uint32_t area_light) {
    const auto [at, is_new] = known_.try_emplace(area_light, 0);
    if (is_new) at->second = compute(scene_.area_lights[area_light]);
    return at->second;
  }

 private:
  double compute(const Directive& light) const {
    const auto scalar = [&](const char* name, double otherwise) {
      const Parameter* p = light.find(name);
      return p && !p->numbers.empty() ? p->numbers[0] : otherwise;
    };
    double value = 1;  // also of spectra that importers of other formats do not write
    if (const Parameter* L = light.find("L"); L && L->numbers.size() == 3)
      value = luminance(Rgb(glm::dvec3(L->numbers[0], L->numbers[1], L->numbers[2])));
    if (const Parameter* file = light.find("filename"); file && !file->strings.empty())
      value = mean_of(*file);
    return std::max(value * scalar("scale", 1), 0.0);
  }

  double mean_of(const Parameter& name) const {
    const std::filesystem::path main(files_.name(scene_.location.file));
    const std::filesystem::path naming(name.location.valid() ? files_.name(name.location.file)
                                                             : main.string());
    const ReadableFile file = pbrt::find_named_file(files_.root(), name.strings[0], naming, main);
    const auto image = pbrt::load_light_image(file).image;
    double sum = 0;
    for (const Rgb& pixel : image.pixels) sum += double(luminance(pixel));
    return image.pixels.empty() ? 0 : sum / double(image.pixels.size());
  }

  const SceneDescription& scene_;
  const SourceFiles& files_;
  std::map<uint32_t, double> known_;
};

std::vector<PlacedMesh> placed_meshes(const SceneDescription& scene, Radiances& radiance_of) {
  std::vector<PlacedMesh> meshes;
  const auto add = [&](const ShapeDescription& shape, const glm::dmat4& to_world) {
    PlacedMesh mesh{&shape, to_world};
    if (shape.area_light) {
      const Parameter* sides = scene.area_lights[*shape.area_light].find("twosided");
      mesh.radiance = radiance_of(*shape.area_light);
      mesh.both_sides = sides && !sides->numbers.empty() && sides->numbers[0] != 0;
    }
    meshes.push_back(mesh);
  };
  for (const ShapeDescription& shape : scene.shapes) add(shape, shape.object_to_world);
  std::map<std::string_view, const ObjectDescription*> objects;
  for (const ObjectDescription& object : scene.objects) objects.emplace(object.name, &object);
  for (const InstanceDescription& instance : scene.instances) {
    const auto found = objects.find(instance.object);
    if (found == objects.end()) continue;
    for (const ShapeDescription& shape : found->second->shapes)
      add(shape, instance.instance_to_world * shape.object_to_world);
  }
  return meshes;
}

// An emitting point that stands for a disk of `area`.
struct EmittingPoint {
  SkySample at;
  double area = 0, radiance = 0;
  bool both_sides = false;
};

std::vector<EmittingPoint> emitting_points(const std::vector<PlacedMesh>& meshes) {
  std::vector<PlacedMesh> emitting;
  std::copy_if(meshes.begin(), meshes.end(), std::back_inserter(emitting),
               [](const PlacedMesh& mesh) { return mesh.radiance > 0; });
  std::vector<EmittingPoint> points;
  const double step =
      for_faces(emitting, kEmitters, [&](const PlacedMesh& mesh, size_t face, uint64_t index) {
        const SkySample at = sample_of(mesh, face, ~index);
        if (at.area > 0) points.push_back({at, at.area, mesh.radiance, mesh.both_sides});
      });
  for (EmittingPoint& point : points) point.area *= step;
  return points;
}

// Irradiance over pi, on the better lit side. Each emitting point is taken for a disk that faces along its
// normal, which keeps the share of near ones below their radiance.
double lit_share(const SkySample& receiver, const std::vector<EmittingPoint>& points) {
  std::array<double, 2> sides{};
  for (const EmittingPoint& point : points) {
    const glm::dvec3 towards = point.at.p - receiver.p;
    const double squared = glm::dot(towards, towards), distance = std::sqrt(squared);
    if (!(distance > 0)) continue;
    double leaving = -glm::dot(towards, point.at.n) / distance;
    if (point.both_sides) leaving = std::abs(leaving);
    const double arriving = glm::dot(towards, receiver.n) / distance;
    if (leaving > 0)
      sides[arriving > 0] +=
          point.radiance * leaving * std::abs(arriving) * point.area / (double(kPi) * squared + point.area);
  }
  return std::max(sides[0], sides[1]);
}

}  // namespace

double emitted_share(const SceneDescription& scene, const SourceFiles& files) {
  if (!scene.lights.empty()) return kLitAlready;
  const auto emits = [](const ShapeDescription& shape) { return shape.area_light.has_value(); };
  if (std::none_of(scene.shapes.begin(), scene.shapes.end(), emits)) return 0;
  Radiances radiance_of(scene, files);
  const std::vector<PlacedMesh> meshes = placed_meshes(scene, radiance_of);
  if (std::any_of(meshes.begin(), meshes.end(),
                  [](const PlacedMesh& mesh) { return mesh.radiance > 0 && mesh.faces() == 0; }))
    return kLitAlready;
  const std::vector<EmittingPoint> points = emitting_points(meshes);
  if (points.empty()) return 0;
  std::vector<PlacedMesh> dark;
  std::copy_if(meshes.begin(), meshes.end(), std::back_inserter(dark),
               [](const PlacedMesh& mesh) { return mesh.radiance < kBrightEnough; });
  double over_faces = 0, over_area = 0, faces = 0, area = 0;
  for_faces(dark, kReceivers, [&](const PlacedMesh& mesh, size_t face, uint64_t index) {
    const SkySample receiver = sample_of(mesh, face, index);
    if (!(receiver.area > 0)) return;
    const double share = lit_share(receiver, points);
    over_faces += share, faces += 1;
    over_area += receiver.area * share, area += receiver.area;
  });
  return faces > 0 ? std::max(over_faces / faces, over_area / area) : kLitAlready;
}

}  // namespace kaustik
