// Tests that method auto has the light of path tracing, class by class, in small rooms that have what makes
// furnished ones hard: a door ajar, crockery and thin chairs in the sun, slots, glasses, rough metal, a light
// that only the ceiling sees, stairs.

#include <fmt/format.h>

#include "tests/render/support/class_agreement.h"
#include "tests/render/support/textured_scenes.h"

namespace kaustik::render {
namespace {

using namespace test;

constexpr int kSide = 48;  // pixels

struct Point {
  double x, y, z;
};

// The sides of a box, which face outwards.
std::string box(const Point& a, const Point& b) {
  return fmt::format(
      "Shape \"trianglemesh\" \"point3 P\" [{0} {1} {2}  {3} {1} {2}  {3} {1} {5}  {0} {1} {5}  {0} {4} {2}  "
      "{3} {4} {2}  "
      "{3} {4} {5}  {0} {4} {5}] \"integer indices\" [0 1 2 0 2 3  4 6 5 4 7 6  0 5 1 0 4 5  1 6 2 1 5 6  2 "
      "7 3 2 6 7  "
      "3 4 0 3 7 4]\n",
      a.x, a.y, a.z, b.x, b.y, b.z);
}
std::string ball(const Point& at, double radius) {
  return fmt::format("AttributeBegin Translate {} {} {} Shape \"sphere\" \"float radius\" {} AttributeEnd\n",
                     at.x, at.y, at.z, radius);
}
std::string light(double radiance, const std::string& shape) {
  return fmt::format("AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [{0} {0} {1}] {2} AttributeEnd\n",
                     radiance, 0.8 * radiance, shape);
}
std::string diffuse(double r, double g, double b) {
  return fmt::format("Material \"diffuse\" \"rgb reflectance\" [{} {} {}]\n", r, g, b);
}
std::string of_material(const std::string& material, const std::string& shapes) {
  return "AttributeBegin Material " + material + "\n" + shapes + "AttributeEnd\n";
}

Scene seen_from(const std::string& look, double fov, const std::string& world) {
  return scene_of(
      fmt::format("LookAt {} 0 1 0 Camera \"perspective\" \"float fov\" {}\n"
                  "Film \"rgb\" \"integer xresolution\" {} \"integer yresolution\" {}\nWorldBegin\n",
                  look, fov, kSide, kSide) +
      world);
}

const std::string kRoom = diffuse(0.6, 0.6, 0.6) + box({-2, 0, -2}, {2, 2.5, 2});

// Light enters the seen half of the room through a gap of 20 cm beside a door, and below it.
Scene door_ajar() {
  return seen_from("1.9 1.2 1.9  0.3 0.9 -0.5", 60,
                   kRoom + light(20, ball({-1.2, 2, 0}, 0.15)) + box({-0.05, 0, -2}, {0.05, 2.5, 0.2}) +
                       diffuse(0.5, 0.3, 0.2) + box({-0.02, 0.02, 0.4}, {0.02, 2.5, 2}) +
                       diffuse(0.7, 0.7, 0.7) + box({0.8, 0, -1.2}, {1.3, 0.5, -0.7}) +
                       ball({0.6, 0.2, 0}, 0.2));
}

// A table with cups, a plate and a thin chair, lit by a low sun.
Scene table_in_the_sun() {
  std::string world =
      "LightSource \"distant\" \"point3 from\" [2 1.5 1] \"point3 to\" [0 0 0] \"rgb L\" [9 8 6]\n" +
      diffuse(0.4, 0.4, 0.45) + box({-2, -0.1, -1.5}, {2, 0, 2}) + box({-2, 0, -1.5}, {2, 2.5, -1.4}) +
      box({-2.1, 0, -1.5}, {-2, 2.5, 2}) + diffuse(0.6, 0.5, 0.4) + box({-0.6, 0.7, -0.4}, {0.6, 0.74, 0.4}) +
      diffuse(0.8, 0.8, 0.8) + box({-0.15, 0.74, 0.1}, {0.05, 0.75, 0.3}) +
      box({-0.2, 0.3, 0.6}, {0.2, 0.9, 0.62});
  for (const double x : {-0.3, 0.1, 0.35}) world += ball({x, 0.78, -0.1}, 0.04);
  for (const double x : {-0.55, 0.5})
    for (const double z : {-0.35, 0.3}) world += box({x, 0, z}, {x + 0.05, 0.7, z + 0.05});
  return seen_from("0.3 1.3 1.8  0 0.7 0", 45, world);
}

// A coated cupboard with a dark inside that is seen through slots, beside a glass ball.
Scene coated_cupboard() {
  std::string boards = box({-0.4, 0, -0.4}, {-0.38, 0.8, 0.4}) + box({0.38, 0, -0.4}, {0.4, 0.8, 0.4}) +
                       box({-0.4, 0.78, -0.4}, {0.4, 0.8, 0.4}) + box({-0.4, 0, -0.4}, {0.4, 0.8, -0.38});
  for (int i = 0; i < 6; ++i) boards += box({-0.4, 0.13 * i, 0.38}, {0.4, 0.13 * i + 0.09, 0.4});
  return seen_from(
      "0.6 0.9 1.95  0.1 0.4 0", 50,
      kRoom + light(15, box({-0.4, 2.4, 0.3}, {0.4, 2.45, 0.9})) +
          of_material("\"coateddiffuse\" \"rgb reflectance\" [0.8 0.3 0.05] \"float roughness\" [0.1]",
                      boards) +
          of_material("\"dielectric\"", ball({0.75, 0.3, 0.4}, 0.3)));
}

// A glass ball and a block of glass on a table.
Scene glasses() {
  return seen_from(
      "0 1.2 1.9  0 0.6 0", 45,
      kRoom + light(40, ball({1.2, 2, 0.5}, 0.15)) + diffuse(0.7, 0.5, 0.3) +
          box({-0.8, 0, -0.5}, {0.8, 0.5, 0.5}) +
          of_material("\"dielectric\"", ball({-0.3, 0.76, 0.1}, 0.25)) +
          of_material("\"dielectric\" \"float eta\" [1.33]", box({0.2, 0.51, -0.1}, {0.5, 0.9, 0.2})));
}

// Plates of rough metal that reflect two lights.
Scene rough_plates() {
  std::string plates;
  int i = 0;
  for (const double roughness : {0.05, 0.2, 0.4}) {
    const double z = -0.9 + 0.6 * i++;
    plates += of_material(fmt::format("\"conductor\" \"float roughness\" [{}]", roughness),
                          box({-1, 0.5 - 0.2 * i, z}, {1, 0.55 - 0.2 * i, z + 0.5}));
  }
  return seen_from(
      "0 1.6 1.9  0 0.4 -0.5", 60,
      kRoom + light(60, ball({-0.5, 1.6, -1.6}, 0.06)) + light(8, ball({0.6, 1.6, -1.5}, 0.2)) + plates);
}

// A light in a tube that is open above, and a table with a ball of glass.
Scene light_in_a_tube() {
  return seen_from(
      "1.2 1.4 1.8  -0.2 0.6 -0.2", 50,
      kRoom + light(60, box({-0.95, 1.5, -0.95}, {-0.75, 1.52, -0.75})) + diffuse(0.3, 0.3, 0.3) +
          box({-1.1, 1.3, -1.1}, {-1.05, 1.8, -0.6}) + box({-0.65, 1.3, -1.1}, {-0.6, 1.8, -0.6}) +
          box({-1.1, 1.3, -1.1}, {-0.6, 1.8, -1.05}) + box({-1.1, 1.3, -0.65}, {-0.6, 1.8, -0.6}) +
          box({-1.1, 1.3, -1.1}, {-0.6, 1.35, -0.6}) + diffuse(0.6, 0.4, 0.2) +
          box({-0.5, 0, -0.5}, {0.5, 0.5, 0.5}) + of_material("\"dielectric\"", ball({0, 0.71, 0}, 0.2)));
}

// Stairs with thin treads, and a picture in a frame.
Scene stairs() {
  std::string steps = diffuse(0.7, 0.6, 0.5);
  for (int i = 0; i < 8; ++i)
    steps += box({-0.8, 0.2 + 0.2 * i, 0.6 - 0.25 * i}, {0.4, 0.23 + 0.2 * i, 0.9 - 0.25 * i});
  return seen_from("0.8 1.3 1.9  -0.2 0.9 -0.5", 55,
                   kRoom + light(12, box({1.9, 1.2, -0.8}, {1.95, 2, 0.2})) + steps + diffuse(0.2, 0.2, 0.3) +
                       box({0.8, 1.2, -2}, {1.4, 1.7, -1.99}) + diffuse(0.8, 0.7, 0.3) +
                       box({0.77, 1.17, -2}, {0.8, 1.73, -1.97}) + box({1.4, 1.17, -2}, {1.43, 1.73, -1.97}));
}

struct Room {
  const char* name;
  Scene (*make)();
};
void PrintTo(const Room& room, std::ostream* out) {
  *out << room.name;
}

class FurnishedRooms : public ::testing::TestWithParam<Room> {};

// Beside the noise, half a per cent of a class: what the discs' kernels may blur, which is all of the bias
// that method auto may have in furnished rooms.
TEST_P(FurnishedRooms, EachClassHasTheMeanOfPaths) {
  const Scene scene = GetParam().make();
  RenderSettings paths, maps;
  paths.method = Method::kMc, paths.spp = 256, paths.seed = 1;
  maps.photons = 200'000, maps.spp = 64, maps.seed = 20;
  const auto by_paths = films(scene, paths), found = films(scene, maps);
  const double picture = total(by_paths).mean;
  EXPECT_GT(picture, 0);
  for (const Layer layer : kClasses) {
    const Estimate a = block_estimate(by_paths, layer, -1), b = block_estimate(found, layer, -1);
    if (!(a.mean > 0.02 * picture)) continue;
    const double noise = std::hypot(a.standard_error, b.standard_error);
    EXPECT_NEAR(b.mean, a.mean, kErrors * noise + 0.005 * a.mean) << kLayerNames[size_t(layer)];
    EXPECT_LT(noise, 0.01 * a.mean) << kLayerNames[size_t(layer)];  // the test can fail
  }
  write_if_failed(by_paths[0], std::string(GetParam().name) + "_paths");
  write_if_failed(found[0], std::string(GetParam().name) + "_auto");
}

INSTANTIATE_TEST_SUITE_P(Rooms, FurnishedRooms,
                         ::testing::Values(Room{"DoorAjar", door_ajar},
                                           Room{"TableInTheSun", table_in_the_sun},
                                           Room{"CoatedCupboard", coated_cupboard}, Room{"Glasses", glasses},
                                           Room{"RoughPlates", rough_plates},
                                           Room{"LightInATube", light_in_a_tube}, Room{"Stairs", stairs}),
                         [](const auto& room) { return std::string(room.param.name); });

}  // namespace
}  // namespace kaustik::render
