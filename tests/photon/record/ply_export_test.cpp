#include "photon/record/ply_export.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "tests/photon/support/photon_sets.h"
#include "tests/support/output_folder.h"

namespace kaustik::photon {
namespace {

namespace fs = std::filesystem;

fs::path output(const std::string& name) {
  return test::output_folder() / name;
}

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(PlyExport, WritesEachPhotonAsOneVertex) {
  PhotonMaker make(30);
  const std::vector<Photon> lit = {make.on_wall(), make.on_wall(), make.on_wall()}, dark = {make.on_wall()};
  const PhotonBuffer direct = make_buffer(lit), shadow = make_buffer(dark);
  const PlyPhotons parts[] = {{PhotonKind::kDirect, &direct}, {PhotonKind::kShadow, &shadow}};
  const fs::path path = output("photons.ply");
  write_photons_ply(path, parts, glm::dvec3(0));
  EXPECT_FALSE(fs::exists(path.string() + ".part"));
  for (const auto& entry : fs::directory_iterator(path.parent_path()))  // no unfinished file either
    EXPECT_FALSE(entry.path().filename().string().starts_with(".photons.")) << entry.path();

  const std::string text = read(path), end = "end_header\n";
  const size_t body = text.find(end) + end.size();
  EXPECT_EQ(text.find("ply\nformat binary_little_endian 1.0\n"), 0u);
  EXPECT_NE(text.find("element vertex 4\nproperty float x\n"), std::string::npos);
  ASSERT_EQ(text.size() - body, 4u * 28);
  for (size_t i = 0; i < 4; ++i) {
    const Photon& expected = i < 3 ? lit[i] : dark[0];
    float numbers[6];
    uint8_t tail[4];
    std::memcpy(numbers, text.data() + body + 28 * i, sizeof(numbers));
    std::memcpy(tail, text.data() + body + 28 * i + sizeof(numbers), sizeof(tail));
    EXPECT_EQ(Point3(numbers[0], numbers[1], numbers[2]), expected.p);
    EXPECT_EQ(Normal3(numbers[3], numbers[4], numbers[5]), expected.n);
    EXPECT_EQ(tail[3], i < 3 ? uint8_t(PhotonKind::kDirect) : uint8_t(PhotonKind::kShadow));
    EXPECT_EQ(glm::u8vec3(tail[0], tail[1], tail[2]) == kShadowColour, i == 3);
  }
}

// Where floats are too coarse for the world's coordinates the file holds doubles, and the sum with the origin
// is exact.
TEST(PlyExport, FarScenesAreWrittenInWorldCoordinates) {
  PhotonMaker make(31);
  const std::vector<Photon> lit = {make.on_wall(), make.on_wall()};
  const PhotonBuffer direct = make_buffer(lit);
  const PlyPhotons parts[] = {{PhotonKind::kDirect, &direct}};
  const glm::dvec3 origin(0x1p20, -0x1p21, 6);
  const fs::path path = output("far.ply");
  write_photons_ply(path, parts, origin);
  const std::string text = read(path), end = "end_header\n";
  const size_t body = text.find(end) + end.size();
  EXPECT_NE(text.find("property double x\nproperty double y\nproperty double z\nproperty float nx\n"),
            std::string::npos);
  ASSERT_EQ(text.size() - body, 2u * 40);
  for (size_t i = 0; i < 2; ++i) {
    glm::dvec3 p;
    Normal3 n;
    std::memcpy(&p, text.data() + body + 40 * i, sizeof(p));
    std::memcpy(&n, text.data() + body + 40 * i + sizeof(p), sizeof(n));
    EXPECT_EQ(p, origin + glm::dvec3(lit[i].p));
    EXPECT_EQ(n, lit[i].n);
    EXPECT_EQ(text[body + 40 * i + 39], char(PhotonKind::kDirect));
  }
}

TEST(PlyExport, EmptyCloudGivesAFileWithoutVertices) {
  const fs::path path = output("none.ply");
  write_photons_ply(path, {}, glm::dvec3(0));
  EXPECT_NE(read(path).find("element vertex 0\n"), std::string::npos);
}

TEST(PlyExport, NamesThePathThatCannotBeWritten) {
  const fs::path path = output("no such folder") / "a.ply";
  try {
    write_photons_ply(path, {}, glm::dvec3(0));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
  }
}

TEST(PlyExport, BrighterPhotonsAreBrighterPoints) {
  const glm::u8vec3 dim = photon_colour(PhotonKind::kCaustic, Rgb(0.5f, 1, 2), 1);
  EXPECT_LT(dim.x, dim.y);
  EXPECT_LT(dim.y, dim.z);
  EXPECT_EQ(photon_colour(PhotonKind::kCaustic, Rgb(1), 0), glm::u8vec3(0));
}

}  // namespace
}  // namespace kaustik::photon
