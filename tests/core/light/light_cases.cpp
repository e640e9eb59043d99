#include "tests/core/light/light_cases.h"

#include "core/sampling/warp.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"

namespace kaustik::test {
namespace {

LightCase area_case(const std::string& name, const Shape& shape, bool twosided, std::vector<Point3> refs) {
  LightCase c;
  c.name = name + (twosided ? " two-sided" : "");
  c.shapes = {shape};
  c.light = *DiffuseAreaLight::make(shape, Rgb(1, 2, 3), twosided);
  c.refs = std::move(refs);
  return c;
}

// A bent strip of two triangles of unequal size, facing down.
Shape bent_mesh() {
  Shape shape;
  shape.geometry =
      TriangleMesh{{{-1, -1, 3}, {-1, 1, 3}, {1, 1, 3.2f}, {2, -1, 3.5f}}, {}, {}, {{0, 1, 2}, {0, 2, 3}}};
  return shape;
}

Shape disk_shape(float inner, bool flip) {
  Shape shape;
  // A tilted ellipse whose +z side faces up; `flip` turns it down.
  const glm::dmat3 linear(1, 0, 0.2, 0, 0.5, 0.1, 0, 0, 1);
  shape.geometry = Disk{Transform::from_matrix(affine(linear, {0.3, 0, 2})), inner};
  shape.flip_normal = flip;
  return shape;
}

// Pixels of random colour, some of them black and one very bright.
std::shared_ptr<const LightImage> random_image(int width, int height) {
  LightImage image{width, height, {}};
  Random random(77);
  for (int i = 0; i < width * height; ++i) {
    const Rgb c(random.uniform(), random.uniform(), random.uniform());
    image.pixels.push_back(i % 7 == 3 ? Rgb(0) : c);
  }
  image.pixels[static_cast<size_t>(width * height / 3)] = Rgb(20, 30, 10);
  return std::make_shared<const LightImage>(std::move(image));
}

// A light that shows an image, with the uv of `shape`.
LightCase image_case(const std::string& name, const Shape& shape, bool twosided, std::vector<Point3> refs,
                     const EmitterAlpha& alpha = {}) {
  LightCase c = area_case(name, shape, twosided, std::move(refs));
  auto light = *DiffuseAreaLight::make(shape, Rgb(1, 2, 3), twosided, random_image(4, 3));
  if (alpha.constant < 1) light.alpha = std::make_shared<const EmitterAlpha>(alpha);
  c.light = light;
  return c;
}

// The two triangles show different parts of the image, one of them mirrored.
Shape mapped_mesh() {
  Shape shape = bent_mesh();
  std::get<TriangleMesh>(shape.geometry).uv = {{0, 0}, {0, 1}, {1, 0.8f}, {0.7f, -0.2f}};
  return shape;
}

// A rotation with mirroring.
glm::mat3 some_axes() {
  const Frame f = Frame::from_z(glm::normalize(Vector3(0.3f, -0.8f, 0.5f)));
  return {f.y, f.x, f.z};
}

std::vector<LightCase> image_cases(const std::vector<Point3>& below) {
  std::vector<LightCase> cases;
  const auto add = [&](const std::string& name, const Light& light) {
    cases.push_back({name, light, {}, below});
  };
  constexpr auto kSampled = DirectionMap::Excess::kSampled;
  const auto square =
      std::make_shared<const DirectionMap>(random_image(8, 8), DirectionMap::Layout::kEqualArea, kSampled);
  const auto wide =
      std::make_shared<const DirectionMap>(random_image(12, 6), DirectionMap::Layout::kLatLong, kSampled);
  add("equal-area sky", ImageInfiniteLight{square, some_axes(), 1.5f, Point3(0), 2.5f});
  add("latitude-longitude sky", ImageInfiniteLight{wide, some_axes(), 1.5f, Point3(0), 2.5f});
  const PortalInfiniteLight portal{{-1, -1, 2.2f},
                                   {0, 2, 0},
                                   {1.5f, 0, 0},
                                   glm::mat3(0, 1, 0, 1, 0, 0, 0, 0, 1),
                                   std::make_shared<const PortalSky>(*wide, some_axes()),
                                   1.5f};
  add("portal", portal);
  cases.back().subdivisions = 160;
  add("goniometric", GoniometricLight{{0, 0, 2}, some_axes(), wide, Rgb(1, 2, 3)});
  const auto slide = std::make_shared<const ProjectedImage>(random_image(5, 3), 70);
  const Frame down = Frame::from_z(glm::normalize(Vector3(0.1f, 0.2f, -1)));
  add("projection", ProjectionLight{{0, 0, 2}, glm::mat3(down.x, down.y, down.z), slide, 2});
  return cases;
}

// Parts of quadrics of radius 0.6 about (0.3, 0, 2.5), tilted; the cylinder is twice as long as wide.
Shape quadric_shape(QuadricKind kind, bool flip) {
  Quadric q;
  q.kind = kind;
  q.z_min = -0.7f;
  q.z_max = 0.4f;
  q.inner = kind == QuadricKind::kDisk ? 0.3f : 0.0f;
  q.phi_max = 4;
  glm::dmat3 m = glm::dmat3(0.8, 0, -0.6, 0, 1, 0, 0.6, 0, 0.8) * 0.6;
  if (kind == QuadricKind::kCylinder) m[2] *= 2;
  if (kind == QuadricKind::kDisk) m[1] *= 0.5;
  q.to_world = Transform::from_matrix(affine(m, {0.3, 0, 2.5}));
  Shape shape;
  shape.geometry = q;
  shape.flip_normal = flip;
  return shape;
}

std::vector<LightCase> make_cases() {
  std::vector<LightCase> cases;
  const std::vector<Point3> below = {{0.2f, 0.1f, 0}, {1.5f, -1, 1}};
  LightCase point{"point", PointLight{Point3(0, 0, 2), Rgb(1, 2, 3)}, {}, below};
  LightCase spot{"spot", SpotLight{}, {}, below};
  auto& s = std::get<SpotLight>(spot.light);
  s.position = Point3(0, 0, 2);
  s.frame = Frame::from_z(glm::normalize(Vector3(0.1f, 0, -1)));
  s.cos_falloff_start = 0.97f;
  s.cos_total_width = 0.9f;
  spot.receiver_radius = 0.9f;
  LightCase distant{
      "distant", DistantLight{glm::normalize(Vector3(1, 0, 2)), Rgb(1, 2, 3), Point3(0), 3}, {}, below};
  LightCase infinite{"infinite", InfiniteLight{Rgb(1, 2, 3), Point3(0), 2.5f}, {}, below};
  cases = {point, spot, distant, infinite};
  for (LightCase& c : image_cases(below)) cases.push_back(std::move(c));

  cases.push_back(area_case("triangle", triangle({0, 0, 2}, {0, 1, 2}, {1, 0, 2}), false, below));
  cases.push_back(area_case("bent mesh", bent_mesh(), false, below));
  cases.push_back(area_case("bent mesh", bent_mesh(), true, {{0, 0, 0}, {1, 0.5f, 6}}));
  const Point3 center(0.5f, 0, 3);
  cases.push_back(area_case("sphere", sphere(center, 0.8f), false, {{0, 0, 0}, {0.5f, 0.1f, 2.1f}}));
  cases.push_back(area_case("distant sphere", sphere({0, 0, 300}, 0.8f), false, {{0, 0, 0}}));
  cases.back().receiver_radius = 150;
  cases.push_back(area_case("inward sphere", sphere(center, 4, 0, true), false, {{0.1f, 0, 2}, center}));
  cases.push_back(area_case("sphere", sphere(center, 4), true, {{0.1f, 0.2f, 2}, {8, 1, 1}}));
  cases.push_back(area_case("disk", disk_shape(0, true), false, below));
  cases.push_back(area_case("annulus", disk_shape(0.6f, false), true, {{0, 0, 0}, {0.5f, 0.5f, 4}}));
  // The receivers are inside: from outside, the density of a light that is sampled by area is unbounded at
  // its silhouette.
  for (const auto& [name, kind] :
       {std::pair{"part of a sphere", QuadricKind::kSphere}, {"cylinder", QuadricKind::kCylinder}}) {
    for (const bool twosided : {false, true}) {
      cases.push_back(area_case(name, quadric_shape(kind, true), twosided, {{0.3f, 0.05f, 2.45f}}));
      cases.back().receiver_radius = 0.2f;
    }
  }
  cases.push_back(area_case("part of a disk", quadric_shape(QuadricKind::kDisk, true), true, below));
  cases.back().subdivisions = 160;
  cases.push_back(image_case("image on a mesh", mapped_mesh(), false, below));
  cases.push_back(image_case("image on a mesh", mapped_mesh(), true, {{0, 0, 0}, {1, 0.5f, 6}}));
  cases.push_back(image_case("image on bare triangles", bent_mesh(), false, below));
  cases.push_back(image_case("image on a disk", disk_shape(0.2f, true), false, below));
  cases.push_back(image_case("image in a sphere", sphere(center, 4, 0, true), false, {{0.1f, 0, 2}}));
  const Shape drum = quadric_shape(QuadricKind::kCylinder, true);
  cases.push_back(image_case("image in a cylinder", drum, true, {{0.3f, 0.05f, 2.45f}}));
  cases.back().receiver_radius = 0.2f;
  return cases;
}

// A cone about `frame.z` that holds every direction to the light.
struct Cone {
  Frame frame;
  double z_min = -1;
};
Cone cone_of(const LightCase& c, const Point3& ref) {
  if (!std::holds_alternative<DiffuseAreaLight>(c.light)) return {};
  const Bounds3 b = bounds_of(c.shapes[0]);
  const Vector3 to_center = b.center() - ref;
  const double distance = glm::length(to_center);
  if (distance <= b.radius()) return {};
  const double sin_max = b.radius() / distance;
  return {Frame::from_z(glm::normalize(to_center)), std::sqrt(1 - sin_max * sin_max)};
}

double density(const LightCase& c, const LightReceiver& x, const Vector3& wi) {
  if (is_infinite(c.light)) return escaped_pdf(c.light, x, wi);
  // Every part of the light along the ray counts, because sample_Li ignores visibility.
  const auto& area = std::get<DiffuseAreaLight>(c.light);
  double sum = 0;
  Ray ray{x.p, wi};
  for (int i = 0; i < 4; ++i) {
    const Hit hit = brute_force(c.shapes, ray);
    if (!hit.valid()) break;
    const SurfaceInteraction on_light = make_interaction(c.shapes, ray, hit);
    sum += area.pdf_Li(x.p, wi, on_light);
    const auto* sphere = std::get_if<SphereEmitter>(&area.surface);
    if (sphere) break;  // spheres are sampled by their visible cone, or seen from inside
    ray = on_light.spawn(wi);
  }
  return sum;
}

}  // namespace

const std::vector<LightCase>& light_cases() {
  static const std::vector<LightCase> cases = make_cases();
  return cases;
}

Point3 Receiver::point(const Point2& u) const {
  const Point2 d = sample_uniform_disk_concentric(u);
  return center + radius * Frame::from_z(normal).to_world({d.x, d.y, 0});
}

bool Receiver::meets(const Ray& ray) const {
  const float cosine = -glm::dot(ray.d, normal);
  if (!(cosine > 0)) return false;
  const float t = glm::dot(ray.o - center, normal) / cosine;
  return t > 0 && glm::distance(ray.at(t), center) <= radius;
}

Receiver receiver_of(const LightCase& c) {
  return {c.refs[0], c.receiver_normal, c.receiver_radius};
}

SquareCase direction_square(const LightCase& c, const LightReceiver& x) {
  const Cone cone = cone_of(c, x.p);
  SquareCase square;
  square.name = c.name;
  square.subdivisions = c.subdivisions;
  square.sample = [=](Random& random, Point2* p) {
    const auto s = sample_Li(c.light, x, random);
    if (!s) return false;
    *p = direction_to_square(cone.frame.to_local(s->wi), cone.z_min);
    return true;
  };
  square.density = [=](double p, double q) {
    const Vector3 wi = cone.frame.to_world(square_to_direction(p, q, cone.z_min));
    return density(c, x, wi) * square_solid_angle(cone.z_min);
  };
  return square;
}

}  // namespace kaustik::test
