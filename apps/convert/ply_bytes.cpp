#include "apps/convert/ply_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace kaustik::app {
namespace {

void append_little(std::string& out, uint32_t bits) {
  for (int i = 0; i < 4; ++i) out += static_cast<char>((bits >> (8 * i)) & 0xffu);
}
void append_float(std::string& out, double v) {
  append_little(out, std::bit_cast<uint32_t>(static_cast<float>(v)));
}

bool are_floats(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) {
    return std::abs(v) <= double(std::numeric_limits<float>::max()) && double(static_cast<float>(v)) == v;
  });
}

// The values of a mesh's parameter; null when absent.
const std::vector<double>* values_of(const ShapeDescription& mesh, std::string_view name) {
  const Parameter* p = mesh.find(name);
  return p ? &p->numbers : nullptr;
}

struct Parts {
  const std::vector<double>*P, *N, *uv, *colours, *indices;
  size_t vertices = 0;

  bool sound() const {
    const bool lists =
        P && !P->empty() && P->size() % 3 == 0 && indices && !indices->empty() && indices->size() % 3 == 0;
    if (!lists || (N && N->size() != P->size()) || (uv && uv->size() != 2 * (P->size() / 3)) ||
        (colours && colours->size() != 4 * (P->size() / 3)))
      return false;
    for (const auto* values : {P, N, uv, colours}) {
      if (values && !are_floats(*values)) return false;
    }
    return std::all_of(indices->begin(), indices->end(),
                       [&](double i) { return i >= 0 && i < double(vertices); }) &&
           vertices < (uint64_t{1} << 31);
  }
};

std::string header(const Parts& parts) {
  std::string out = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", parts.vertices);
  for (const char* name : {"x", "y", "z"}) out += fmt::format("property float {}\n", name);
  for (const char* name : {"nx", "ny", "nz"}) {
    if (parts.N) out += fmt::format("property float {}\n", name);
  }
  for (const char* name : {"u", "v"}) {
    if (parts.uv) out += fmt::format("property float {}\n", name);
  }
  for (const char* name : {"red", "green", "blue", "alpha"}) {
    if (parts.colours) out += fmt::format("property float {}\n", name);
  }
  return out + fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                           parts.indices->size() / 3);
}

}  // namespace

std::optional<std::string> ply_bytes(const ShapeDescription& mesh) {
  Parts parts{values_of(mesh, "P"), values_of(mesh, "N"), values_of(mesh, "uv"), values_of(mesh, "Cd"),
              values_of(mesh, "indices")};
  parts.vertices = parts.P ? parts.P->size() / 3 : 0;
  if (mesh.find("faceIndices") || mesh.find("S") || !parts.sound()) return std::nullopt;
  std::string out = header(parts);
  for (size_t i = 0; i < parts.vertices; ++i) {
    for (size_t k = 0; k < 3; ++k) append_float(out, (*parts.P)[3 * i + k]);
    for (size_t k = 0; parts.N && k < 3; ++k) append_float(out, (*parts.N)[3 * i + k]);
    for (size_t k = 0; parts.uv && k < 2; ++k) append_float(out, (*parts.uv)[2 * i + k]);
    for (size_t k = 0; parts.colours && k < 4; ++k) append_float(out, (*parts.colours)[4 * i + k]);
  }
  for (size_t i = 0; i < parts.indices->size(); ++i) {
    if (i % 3 == 0) out += '\x03';
    append_little(out, static_cast<uint32_t>((*parts.indices)[i]));
  }
  return out;
}

}  // namespace kaustik::app
