// Tests PLY files, as text and in both byte orders.
#include <algorithm>
#include <bit>
#include <cstring>

#include <fmt/format.h>

#include "apps/import/common/gzip.h"
#include "apps/import/ply/ply.h"
#include "core/memory/process_memory.h"
#include "tests/apps/import/gzipped.h"
#include "tests/apps/import/import_support.h"

namespace kaustik::pbrt {
namespace {

class ImportPly : public ImportTest {
 protected:
  MeshResult read(const std::string& bytes) const {
    return load_ply(ReadableFile::trusted(write("mesh.ply", bytes)));
  }
  std::string error(const std::string& bytes) const {
    std::string text = read(bytes).error;
    const std::string prefix = "cannot read \"" + (folder_ / "mesh.ply").string() + "\": ";
    return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
  }
};

enum class Order { kAscii, kLittle, kBig };

// Appends a value as text or bytes.
template <class T>
void put(std::string& out, Order order, T value) {
  if (order == Order::kAscii) {
    out += std::to_string(value) + ' ';
    return;
  }
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  if ((order == Order::kBig) == (std::endian::native == std::endian::little))
    std::reverse(bytes, bytes + sizeof(T));
  out.append(bytes, sizeof(T));
}

std::string format_line(Order order) {
  switch (order) {
    case Order::kAscii:
      return "ply\nformat ascii 1.0\ncomment a test\n";
    case Order::kLittle:
      return "ply\nformat binary_little_endian 1.0\ncomment a test\n";
    default:
      return "ply\nformat binary_big_endian 1.0\ncomment a test\n";
  }
}

// Triangulation may begin a triangle at another corner; the winding stays.
std::array<uint32_t, 3> from_least(std::array<uint32_t, 3> triangle) {
  std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  return triangle;
}

// The five corners of a pyramid with normals and texture coordinates; a quad and four triangles.
std::string pyramid(Order order, const std::string& u, const std::string& v) {
  std::string out = format_line(order);
  out += "element vertex 5\n";
  for (const std::string& name : {std::string("x"), std::string("y"), std::string("z"), std::string("nx"),
                                  std::string("ny"), std::string("nz"), u, v}) {
    out += "property float " + name + "\n";
  }
  out += "property uchar red\nelement face 5\nproperty list uchar int vertex_indices\nend_header\n";
  for (int i = 0; i < 5; ++i) {
    for (int k = 0; k < 8; ++k) put(out, order, static_cast<float>(i * i + 0.25 * k));
    put(out, order, static_cast<uint8_t>(i));
    if (order == Order::kAscii) out += '\n';
  }
  const std::vector<std::vector<int32_t>> faces = {{0, 1, 2, 3}, {0, 4, 1}, {1, 4, 2}, {2, 4, 3}, {3, 4, 0}};
  for (const auto& face : faces) {
    put(out, order, static_cast<uint8_t>(face.size()));
    for (const int32_t i : face) put(out, order, i);
    if (order == Order::kAscii) out += '\n';
  }
  return out;
}

TEST_F(ImportPly, KeepsVerticesNormalsAndTextureCoordinatesInEveryByteOrder) {
  for (const Order order : {Order::kAscii, Order::kLittle, Order::kBig}) {
    for (const auto& [u, v] :
         {std::pair{"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}}) {
      const MeshResult result = read(pyramid(order, u, v));
      ASSERT_EQ(result.error, "");
      const TriangleMesh& m = result.mesh;
      ASSERT_EQ(m.P.size(), 5u);
      ASSERT_EQ(m.N.size(), 5u);
      ASSERT_EQ(m.uv.size(), 5u);
      for (int i = 0; i < 5; ++i) {
        const auto f = static_cast<float>(i * i);
        EXPECT_EQ(m.P[i], Point3(f, f + 0.25f, f + 0.5f));
        EXPECT_EQ(m.N[i], Normal3(f + 0.75f, f + 1, f + 1.25f));
        EXPECT_EQ(m.uv[i], Point2(f + 1.5f, f + 1.75f));
      }
      ASSERT_EQ(m.indices.size(), 6u);  // the quad gives two triangles
      EXPECT_EQ(from_least(m.indices[2]), (std::array<uint32_t, 3>{0, 4, 1}));
      EXPECT_EQ(from_least(m.indices[5]), (std::array<uint32_t, 3>{0, 3, 4}));
    }
  }
}

TEST_F(ImportPly, ReadsOtherTypesAndPositionsAlone) {
  for (const Order order : {Order::kAscii, Order::kLittle, Order::kBig}) {
    std::string out = format_line(order);
    out +=
        "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
        "element face 1\nproperty list ushort uint vertex_index\nend_header\n";
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) put(out, order, i == k ? 0.5 : 0.0);
      if (order == Order::kAscii) out += '\n';
    }
    put(out, order, uint16_t{3});
    for (uint32_t i = 0; i < 3; ++i) put(out, order, 2 - i);
    const MeshResult result = read(out + (order == Order::kAscii ? "\n" : ""));
    ASSERT_EQ(result.error, "");
    EXPECT_EQ(result.mesh.P, (std::vector<Point3>{{.5f, 0, 0}, {0, .5f, 0}, {0, 0, .5f}}));
    EXPECT_EQ(result.mesh.indices, (std::vector<std::array<uint32_t, 3>>{{2, 1, 0}}));
    EXPECT_TRUE(result.mesh.N.empty());
    EXPECT_TRUE(result.mesh.uv.empty());
  }
}

constexpr std::string_view kTriangle =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::string replaced(std::string_view from, std::string_view to) {
  std::string text(kTriangle);
  return text.replace(text.find(from), from.size(), to);
}

// pbrt makes patches of quads: the parameters of a patch become the uv of quads that share no corner.
TEST_F(ImportPly, QuadsHaveTheUvOfPatches) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 7\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n3 0 0\n3 1 0\n";
  const MeshResult apart = read(head + "4 3 0 1 2\n3 4 5 6\n");
  ASSERT_EQ(apart.error, "");
  const std::vector<Point2> uv{{1, 0}, {1, 1}, {0, 1}, {0, 0}, {0, 0}, {1, 0}, {1, 1}};
  EXPECT_EQ(apart.mesh.uv, uv);
  EXPECT_TRUE(read(head + "4 3 0 1 2\n3 2 5 6\n").mesh.uv.empty());
  EXPECT_TRUE(read(head + "3 0 1 2\n3 0 1 2\n").mesh.uv.empty());
}

// Whole numbers are sRGB: 188 / 255 decodes to 0.5029 (IEC 61966-2-1); alpha is linear, and so are floats.
TEST_F(ImportPly, ReadsColoursWhereTheyAreShown) {
  const std::string face = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string xyz =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string bytes =
      xyz + "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n" + face +
      "0 0 0 255 0 188 51\n1 0 0 0 0 0 0\n0 1 0 0 0 0 0\n3 0 1 2\n";
  EXPECT_TRUE(read(bytes).mesh.colours.empty());
  const TriangleMesh mesh = load_ply(ReadableFile::trusted(write("mesh.ply", bytes)), nullptr, true).mesh;
  ASSERT_EQ(mesh.colours.size(), 3u);
  EXPECT_EQ(mesh.colours[0].x, 1);
  EXPECT_NEAR(mesh.colours[0].z, 0.5029f, 1e-4f);
  EXPECT_NEAR(mesh.colours[0].w, 0.2f, 1e-6f);
  const std::string floats = xyz + "property float red\nproperty float green\nproperty float blue\n" + face +
                             "0 0 0 0.25 0 1\n1 0 0 0 0 0\n0 1 0 0 0 0\n3 0 1 2\n";
  EXPECT_EQ(load_ply(ReadableFile::trusted(write("mesh.ply", floats)), nullptr, true).mesh.colours.at(0),
            glm::vec4(0.25f, 0, 1, 1));
}

TEST_F(ImportPly, ReadsCarriageReturns) {
  std::string text;
  for (const char c : kTriangle) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const MeshResult result = read(text);
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.mesh.P, (std::vector<Point3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(result.mesh.indices.size(), 1u);
}

// "byte N: message" with N the place of `needle` in the text.
std::string at(const std::string& text, std::string_view needle, std::string_view message) {
  return fmt::format("byte {}: {}", text.find(needle), message);
}

struct BadMesh {
  std::string_view from, to;  // the change of kTriangle
  std::string_view place;     // the text at the reported byte
  std::string_view message;
};

TEST_F(ImportPly, RefusesMalformedFiles) {
  EXPECT_EQ(error("solid cube\n"), "byte 0: not a PLY file: it must begin with `ply`");
  EXPECT_EQ(error(""), "byte 0: not a PLY file: it must begin with `ply`");
  const BadMesh cases[] = {
      {"format ascii 1.0\n", "", "0 0 0\n", "the header names no format"},
      {"ascii", "asci", "format", "unknown format"},
      {"float y", "flaot y", "property flaot", "unknown header line"},
      {"float y", "float w", "0 0 0\n", "vertices have no `y`"},
      {"vertex_indices", "corners", "0 0 0\n", "faces have no list `vertex_indices`"},
      {"element face 1", "element face 0", "0 0 0\n", "there are no faces"},
      {"1 0 0", "1 x 0", "1 x 0", "expected a number, not `x`"},
      {"1 0 0", "1 0", "1 0\n0", "element `vertex` 1 has too few values on its line"},
      {"1 0 0", "1 0 0 0", "1 0 0 0", "element `vertex` 1 has too many values on its line"},
      {"3 0 1 2", "2 0 1", "2 0 1", "face 0 has 2 vertices"},
      {"3 0 1 2\n", "\n\n\n\n", "\n\n\n", "the file ends inside element `face` 1 of 1"},
  };
  for (const BadMesh& bad : cases) {
    const std::string text = replaced(bad.from, bad.to);
    // The last case is reported past the end of the text.
    const std::string expected = bad.place == "\n\n\n" ? fmt::format("byte {}: {}", text.size(), bad.message)
                                                       : at(text, bad.place, bad.message);
    EXPECT_EQ(error(text), expected);
  }
  const auto misread = [&](std::string_view from, std::string_view to, std::string_view message) {
    const std::string text = replaced(from, to);
    EXPECT_EQ(error(text), at(text, to, message));
  };
  misread("3 0 1 2", "3 0 1 3", "face 0 has vertex 3: there are 3 vertices");
  misread("3 0 1 2", "3 0 1 -1", "face 0 has vertex -1: there are 3 vertices");
  misread("3 0 1 2", "3 0 1", "element `face` 0 has too few values on its line");
  misread("3 0 1 2", "3 0 1 x", "expected a number, not `x`");
  EXPECT_NE(error(replaced("end_header\n", "")), "");
}

TEST_F(ImportPly, RefusesCountsThatTheFileCannotHold) {
  const std::string text = replaced("element face 1", "element face 1000000000000");
  EXPECT_EQ(error(text),
            at(text, "0 0 0\n",
               fmt::format("the header promises 1000000000000 of element `face`, more than the file's {} "
                           "bytes can hold",
                           text.size())));
  EXPECT_NE(error(replaced("element vertex 3", "element vertex 18446744073709551615")), "");
  EXPECT_EQ(error(replaced("element vertex 3", "element vertex 18446744073709551616")),
            "byte 21: an element needs a count");
  EXPECT_EQ(error(replaced("element vertex 3", "element vertex -3")), "byte 21: an element needs a count");
}

// The polygons have concave corners; no triangle may lie outside the polygon.
TEST_F(ImportPly, ConcavePolygonsKeepTheirArea) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 7\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 1\n4 0 1\n4 4 1\n2 1 1\n0 4 1\n-1 2 1\n1 2 1\n"
      "5 0 1 2 3 4\n4 5 0 6 4\n";
  const MeshResult result = read(text);
  ASSERT_EQ(result.error, "");
  ASSERT_EQ(result.mesh.indices.size(), 5u);
  double area = 0;
  for (const auto& [a, b, c] : result.mesh.indices) {
    const auto& P = result.mesh.P;
    const double twice = glm::cross(glm::dvec3(P[b] - P[a]), glm::dvec3(P[c] - P[a])).z;
    EXPECT_GE(twice, 0);
    area += 0.5 * twice;
  }
  // By the shoelace formula: 16 - (4 x 3) / 2 = 10 for the first, (1 x 4) / 2 + (1 x 4) / 2 = 4 for the kite.
  EXPECT_NEAR(area, 10 + 4, 1e-12);
}

// The mesh takes many blocks, which are read in parallel, in every byte order, with polygons among the
// triangles.
TEST_F(ImportPly, LargeMeshesAreReadWhole) {
  constexpr uint32_t kCount = 100'000;
  for (const Order order : {Order::kAscii, Order::kLittle, Order::kBig}) {
    std::string text = format_line(order) + fmt::format("element face {}\n", kCount) +
                       "property list uchar int vertex_indices\nproperty int face_indices\n" +
                       fmt::format("element vertex {}\n", kCount) +
                       "property float x\nproperty double y\nproperty float z\nend_header\n";
    for (uint32_t i = 0; i < kCount; ++i) {
      const bool quad = i % 1000 == 7;
      put(text, order, uint8_t(quad ? 4 : 3));
      for (uint32_t k = 0; k < (quad ? 4u : 3u); ++k) put(text, order, int32_t((i + k) % kCount));
      put(text, order, int32_t(i));
      if (order == Order::kAscii) text += '\n';
    }
    for (uint32_t i = 0; i < kCount; ++i) {
      put(text, order, float(i));
      put(text, order, 0.5 * i);
      put(text, order, float(i % 7));
      if (order == Order::kAscii) text += '\n';
    }
    const MeshResult result = read(text);
    ASSERT_EQ(result.error, "");
    ASSERT_EQ(result.mesh.P.size(), kCount);
    ASSERT_EQ(result.mesh.indices.size(), kCount + kCount / 1000);
    for (uint32_t i = 0; i < kCount; i += 37)
      ASSERT_EQ(result.mesh.P[i], Point3(float(i), 0.5f * float(i), float(i % 7)));
    EXPECT_EQ(result.mesh.indices[6], (std::array<uint32_t, 3>{6, 7, 8}));
    EXPECT_EQ(result.mesh.indices[kCount - 1 + 100][0], kCount - 1);
  }
}

TEST_F(ImportPly, ReadsGzip) {
  const std::string packed = gzipped(pyramid(Order::kLittle, "u", "v"));
  const MeshResult result = read(packed);
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.mesh.P.size(), 5u);
  EXPECT_EQ(result.mesh.indices.size(), 6u);
  for (size_t n = 2; n < packed.size(); ++n) {
    EXPECT_NE(error(packed.substr(0, n)).find("of the gzip file: "), std::string::npos) << n;
    std::string damaged = packed;
    damaged[n] = static_cast<char>(~damaged[n]);
    read(damaged);  // must not crash
  }
}

TEST_F(ImportPly, GzipBombsAreRefused) {
  const std::string bomb = gzipped(std::string(kFreeGzipBytes + 1, ' '));
  ASSERT_LT(bomb.size() * kMostGzipRatio, kFreeGzipBytes);
  EXPECT_NE(error(bomb).find(fmt::format("it unpacks to more than {} bytes", kFreeGzipBytes)),
            std::string::npos);
}

// 40 MB must be held twice while the last of them are unpacked: in what has become too small, and in what is
// larger.
TEST_F(ImportPly, GzipMustFitUnpacked) {
  const std::string packed = gzipped(std::string(40'000'000, ' '));
  std::string why;
  const MemoryRoom small(held_memory() + 50'000'000, "--memory");
  EXPECT_EQ(unpack_gzip(packed, small, why), std::nullopt);
  EXPECT_NE(why.find("of memory, but --memory leaves"), std::string::npos) << why;
  const MemoryRoom large(held_memory() + 200'000'000, "--memory");
  EXPECT_TRUE(unpack_gzip(packed, large, why)) << why;
}

TEST_F(ImportPly, EveryTruncationIsRefusedOrComplete) {
  for (const Order order : {Order::kAscii, Order::kLittle, Order::kBig}) {
    const std::string whole = pyramid(order, "u", "v");
    for (size_t n = 0; n < whole.size(); ++n) {
      const MeshResult result = read(whole.substr(0, n));
      // A text without its last digits or blank may still be complete.
      const bool may_be_complete = order == Order::kAscii && n + 3 > whole.size();
      EXPECT_TRUE(may_be_complete || !result.error.empty()) << n;
    }
  }
}

TEST_F(ImportPly, EveryChangedByteIsHandled) {
  const std::string whole = pyramid(Order::kBig, "u", "v");
  for (size_t n = 0; n < whole.size(); ++n) {
    std::string bytes = whole;
    bytes[n] = static_cast<char>(~bytes[n]);
    const MeshResult result = read(bytes);
    for (const auto& triangle : result.mesh.indices) {
      for (const uint32_t i : triangle) ASSERT_LT(i, result.mesh.P.size());
    }
  }
}

TEST_F(ImportPly, ErrorsAreLocatedInTheScene) {
  write("meshes/bad.ply", "plx\n");
  EXPECT_EQ(messages("WorldBegin\nShape \"plymesh\" \"string filename\" [ \"meshes/bad.ply\" ]\n"),
            "scene.pbrt:2:37: error: cannot read \"meshes/bad.ply\": byte 0: not a PLY file: it must begin "
            "with `ply`\n"
            "Shape \"plymesh\" \"string filename\" [ \"meshes/bad.ply\" ]\n"
            "                                    ^\n");
}

TEST_F(ImportPly, MeshesOfObjectsAreReadOnceAndCopied) {
  write("a.ply", std::string(kTriangle));
  const Scene s = world(
      "ObjectBegin \"a\" Shape \"plymesh\" \"string filename\" \"a.ply\" ObjectEnd\n"
      "ObjectInstance \"a\" Translate 0 0 1 ObjectInstance \"a\"");
  ASSERT_EQ(s.shapes.size(), 2u);
  EXPECT_EQ(std::get<TriangleMesh>(s.shapes[0].geometry).P[1], Point3(1, 0, 0));
  EXPECT_EQ(std::get<TriangleMesh>(s.shapes[1].geometry).P[1], Point3(1, 0, 1));
}

}  // namespace
}  // namespace kaustik::pbrt
