// Photon tracing against a bare Embree walk that shades nothing.
//
// Both sides walk the same paths. The bare walk starts with the recorded first ray of each photon and goes on
// from each hit, o + t d, in the recorded next direction, with rtcIntersect1 alone, on its own Embree scene
// of the same flags, and keeps only a sum of distances. It neither samples, nor shades, nor stores. The shoot
// does all of its work: random numbers, emission, surface points, BSDFs, roulette, packing, storage, joining.
// As a second reference the recorded rays are also replayed with their recorded origins, where no ray waits
// for the one before. Rounds are interleaved; times are CPU time; each ratio, reference / shoot, is the
// median over the rounds. A scene of a few triangles, where Embree has next to nothing to do, is the worst
// case.
//
// Usage: trace_bench [photons = 500000] [rounds = 9] [threads = 1]

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_reduce.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>

#include "accel/embree_api.h"
#include "apps/import/pbrt_importer.h"
#include "photon/shoot.h"

namespace {

using namespace kaustik;

void add_quad(Scene& scene, uint32_t material, Point3 p, Vector3 a, Vector3 b) {
  TriangleMesh mesh;
  mesh.P = {p, p + a, p + a + b, p + b};
  mesh.indices = {{0, 1, 2}, {0, 2, 3}};
  Shape shape;
  shape.geometry = mesh;
  shape.material = material;
  shape.surface_group = static_cast<uint32_t>(scene.shapes.size());
  scene.shapes.push_back(std::move(shape));
}

// A wavy sheet of 2 n^2 triangles over [-0.9, 0.9]^2.
void add_sheet(Scene& scene, uint32_t material, float height, uint32_t n) {
  TriangleMesh mesh;
  for (uint32_t j = 0; j <= n; ++j) {
    for (uint32_t i = 0; i <= n; ++i) {
      const float x = -0.9f + 1.8f * float(i) / float(n), z = -0.9f + 1.8f * float(j) / float(n);
      mesh.P.push_back({x, height + 0.1f * std::sin(9 * x) * std::sin(7 * z), z});
    }
  }
  for (uint32_t j = 0; j < n; ++j) {
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t v = j * (n + 1) + i;
      mesh.indices.push_back({v, v + 1, v + n + 2});
      mesh.indices.push_back({v, v + n + 2, v + n + 1});
    }
  }
  Shape shape;
  shape.geometry = std::move(mesh);
  shape.material = material;
  shape.surface_group = static_cast<uint32_t>(scene.shapes.size());
  scene.shapes.push_back(std::move(shape));
}

// A closed box with an area lamp; with sheet > 0 also two wavy sheets, one of them of glass.
Scene room(uint32_t sheet) {
  Scene scene;
  scene.materials = {Lambertian{Rgb(0.75f)}, Lambertian{{0.75f, 0.25f, 0.25f}}, Dielectric{1.33f}};
  add_quad(scene, 0, {-1, -1, -1}, {0, 0, 2}, {2, 0, 0});
  add_quad(scene, 0, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2});
  add_quad(scene, 1, {-1, -1, -1}, {0, 2, 0}, {0, 0, 2});
  add_quad(scene, 0, {1, -1, -1}, {0, 0, 2}, {0, 2, 0});
  add_quad(scene, 0, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0});
  add_quad(scene, 0, {-1, -1, 1}, {0, 2, 0}, {2, 0, 0});
  if (sheet > 0) {
    add_sheet(scene, 2, 0.0f, sheet);
    add_sheet(scene, 1, -0.6f, sheet);
  }
  add_quad(scene, 0, {-0.25f, 0.99f, -0.25f}, {0.5f, 0, 0}, {0, 0, 0.5f});
  scene.shapes.back().light = 0;
  scene.lights.emplace_back(*DiffuseAreaLight::make(scene.shapes.back(), Rgb(10), false));
  finalize_scene(scene);
  return scene;
}

// The rays of all photons in order; paths[i] is the first of photon i.
struct Record {
  std::vector<Ray> rays;
  std::vector<size_t> paths;
};

// Passes rays on to the tree and keeps them.
struct Recorder {
  const accel::Bvh& bvh;
  Record& record;
  Hit intersect(const Ray& ray) const {
    record.rays.push_back(ray);
    return bvh.intersect(ray);
  }
};

void quadric_bounds(const RTCBoundsFunctionArguments* args) {
  const Bounds3 b = bounds_of(*static_cast<const Shape*>(args->geometryUserPtr));
  *args->bounds_o = {b.min.x, b.min.y, b.min.z, 0, b.max.x, b.max.y, b.max.z, 0};
}

void quadric_intersect(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const Shape& shape = *static_cast<const Shape*>(args->geometryUserPtr);
  auto& query = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  const RTCRay& r = query.ray;
  const Ray ray{{r.org_x, r.org_y, r.org_z}, {r.dir_x, r.dir_y, r.dir_z}, r.tfar};
  const auto* sphere = std::get_if<Sphere>(&shape.geometry);
  Point2 uv;
  const float t =
      sphere ? intersect_sphere(*sphere, ray) : intersect_disk(std::get<Disk>(shape.geometry), ray, &uv);
  if (!(t >= r.tnear && t < r.tfar)) return;
  query.ray.tfar = t;
  query.hit.geomID = args->geomID;
  query.hit.primID = args->primID;
}

// The shapes alone in a plain Embree scene, robust as the renderer's.
class BareScene {
 public:
  explicit BareScene(const Scene& scene) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    for (const Shape& shape : scene.shapes) {
      const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry);
      mesh ? add(*mesh) : add_quadric(shape);
    }
    rtcCommitScene(scene_);
  }
  ~BareScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  BareScene(const BareScene&) = delete;
  BareScene& operator=(const BareScene&) = delete;

  // Distance to the nearest hit beyond `near`, zero when there is none.
  float distance(const Ray& ray, float near) const {
    RTCRayHit query{};
    query.ray.org_x = ray.o.x;
    query.ray.org_y = ray.o.y;
    query.ray.org_z = ray.o.z;
    query.ray.dir_x = ray.d.x;
    query.ray.dir_y = ray.d.y;
    query.ray.dir_z = ray.d.z;
    query.ray.tnear = near;
    query.ray.tfar = kInfinity;
    query.ray.mask = 0xffffffffu;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    accel::embree_intersect(scene_, &query);
    return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? 0 : query.ray.tfar;
  }

 private:
  void add(const TriangleMesh& mesh) {
    RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* p = static_cast<Point3*>(rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                           sizeof(Point3), mesh.P.size()));
    std::copy(mesh.P.begin(), mesh.P.end(), p);
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices.data(), 0,
                               sizeof(mesh.indices[0]), mesh.indices.size());
    attach(g);
  }
  void add_quadric(const Shape& shape) {
    RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(g, 1);
    rtcSetGeometryUserData(g, const_cast<Shape*>(&shape));
    rtcSetGeometryBoundsFunction(g, quadric_bounds, nullptr);
    rtcSetGeometryIntersectFunction(g, quadric_intersect);
    attach(g);
  }
  void attach(RTCGeometry g) {
    rtcCommitGeometry(g);
    rtcAttachGeometry(scene_, g);
    rtcReleaseGeometry(g);
  }

  RTCDevice device_;
  RTCScene scene_;
};

// CPU time of the whole process: what the work costs, whatever else the machine runs.
double seconds(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<long>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

double walk_path(const BareScene& bare, const Record& record, size_t first, size_t end) {
  double sum = 0;
  Ray ray = record.rays[first];
  float near = 0;
  for (size_t i = first; i < end; ++i, near = 1e-4f) {
    ray.d = record.rays[i].d;
    const float t = bare.distance(ray, near);
    ray.o += t * ray.d;
    sum += static_cast<double>(t);
  }
  return sum;
}

double replay_path(const BareScene& bare, const Record& record, size_t first, size_t end) {
  double sum = 0;
  for (size_t i = first; i < end; ++i) sum += static_cast<double>(bare.distance(record.rays[i], 0));
  return sum;
}

template <class Path>
double over_paths(const Record& record, const Path& path) {
  return tbb::parallel_reduce(
      tbb::blocked_range<size_t>(0, record.paths.size() - 1, 1 << 14), 0.0,
      [&](const tbb::blocked_range<size_t>& r, double sum) {
        for (size_t i = r.begin(); i < r.end(); ++i) sum += path(record.paths[i], record.paths[i + 1]);
        return sum;
      },
      std::plus<double>());
}

void compare(const char* name, const Scene& scene, photon::TraceSettings settings, int rounds) {
  const accel::Bvh bvh(scene);
  const BareScene bare(scene);
  Record record;
  photon::TraceCounters counters;
  const Recorder recorder{bvh, record};
  const auto nothing = [](photon::PhotonKind, const photon::Photon&) {};
  for (uint64_t i = 0; i < settings.photons; ++i) {
    record.paths.push_back(record.rays.size());
    photon::trace_photon(scene, recorder, settings, i, nothing, counters);
  }
  record.paths.push_back(record.rays.size());

  volatile double sink = 0;
  const auto walk = [&] {
    sink = over_paths(record, [&](size_t first, size_t end) { return walk_path(bare, record, first, end); });
  };
  const auto replay = [&] {
    sink =
        over_paths(record, [&](size_t first, size_t end) { return replay_path(bare, record, first, end); });
  };
  const auto shoot = [&] { sink = static_cast<double>(photon::shoot(scene, bvh, settings).counters.rays); };
  std::vector<double> walks, replays, shoots, walk_ratios, replay_ratios;
  for (int round = 0; round < rounds; ++round) {
    walks.push_back(seconds(walk));
    shoots.push_back(seconds(shoot));
    replays.push_back(seconds(replay));
    walk_ratios.push_back(walks.back() / shoots.back());
    replay_ratios.push_back(replays.back() / shoots.back());
  }
  const double to_ns = 1e9 / static_cast<double>(record.rays.size());
  std::printf(
      "%-34s %9zu rays  ns/ray: walk %6.1f  replay %6.1f  shoot %6.1f   walk/shoot %.2f  replay/shoot %.2f\n",
      name, record.rays.size(), to_ns * median(walks), to_ns * median(replays), to_ns * median(shoots),
      median(walk_ratios), median(replay_ratios));
}

void compare_file(const char* name, const photon::TraceSettings& settings, int rounds) {
  Diagnostics diagnostics;
  const auto loaded = pbrt::load_scene(std::filesystem::path(KAUSTIK_SCENES_DIR) / name, diagnostics);
  if (!loaded) {
    std::fprintf(stderr, "%s: not a scene\n", name);
    std::exit(1);
  }
  compare(name, loaded->scene, settings, rounds);
}

}  // namespace

int main(int argc, char** argv) {
  photon::TraceSettings settings;
  settings.photons = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 500000;
  const int rounds = argc > 2 ? std::max(5, std::atoi(argv[2])) : 9;
  const size_t threads = argc > 3 ? static_cast<size_t>(std::max(1, std::atoi(argv[3]))) : 1;
  const tbb::global_control cap(tbb::global_control::max_allowed_parallelism, threads);
  const Scene small = room(0), large = room(300);
  settings.kinds = {true, false, true, true};
  compare("box, 14 triangles", small, settings, rounds);
  compare_file("cornell-spheres/square-lamp-2.pbrt", settings, rounds);
  compare_file("tncg15-room/tncg15-room.pbrt", settings, rounds);
  compare("sheets, 360k triangles", large, settings, rounds);
  settings.kinds = {true, false, false, false};
  compare("sheets, direct photons only", large, settings, rounds);
  return 0;
}
