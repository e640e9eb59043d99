#include "apps/import/gltf/file/compression.h"

#include <draco/compression/decode.h>
#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>

namespace kaustik::gltf {
namespace {

// Numbers that a compressed part may decode to. The sizes of compressed files do not bound it.
constexpr uint64_t kMostDecoded = uint64_t{1} << 32;

constexpr const char* kInstead = "`gltf-transform copy` or `gltfpack -noq` write files without compression";

const unsigned char* bytes_of(std::string_view text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

int decode_elements(const std::string& mode, std::string& out, uint64_t count, uint64_t stride,
                    std::string_view bytes) {
  if (mode == "ATTRIBUTES")
    return meshopt_decodeVertexBuffer(out.data(), count, stride, bytes_of(bytes), bytes.size());
  if (mode == "TRIANGLES")
    return meshopt_decodeIndexBuffer(out.data(), count, stride, bytes_of(bytes), bytes.size());
  return meshopt_decodeIndexSequence(out.data(), count, stride, bytes_of(bytes), bytes.size());
}

// Throws unless the numbers are those that meshoptimizer's functions accept: others end the program.
void check_layout(const View& extension, const std::string& mode, uint64_t count, uint64_t stride) {
  const bool attributes = mode == "ATTRIBUTES";
  if (!attributes && mode != "TRIANGLES" && mode != "INDICES")
    extension["mode"].fail(fmt::format("is \"{}\", which is not a mode", mode.substr(0, 20)));
  const bool stride_fits =
      attributes ? stride > 0 && stride <= 256 && stride % 4 == 0 : stride == 2 || stride == 4;
  if (!stride_fits)
    extension["byteStride"].fail(fmt::format("is {}, which mode {} does not have", stride, mode));
  if (mode == "TRIANGLES" && count % 3 != 0)
    extension["count"].fail(fmt::format("is {}, which is not a multiple of 3", count));
  if (count > kMostDecoded / stride) extension["count"].fail(fmt::format("is {}, which is too large", count));
}

void apply_filter(const View& extension, std::string& out, uint64_t count, uint64_t stride) {
  const std::string filter = extension["filter"].text("NONE");
  if (filter == "NONE") return;
  const auto check = [&](bool fits) {
    if (!fits)
      extension["filter"].fail(fmt::format("is {}, which elements of {} bytes do not have", filter, stride));
  };
  if (filter == "OCTAHEDRAL") {
    check(stride == 4 || stride == 8);
    meshopt_decodeFilterOct(out.data(), count, stride);
  } else if (filter == "QUATERNION") {
    check(stride == 8);
    meshopt_decodeFilterQuat(out.data(), count, stride);
  } else if (filter == "EXPONENTIAL") {
    meshopt_decodeFilterExp(out.data(), count, stride);
  } else {
    extension["filter"].fail(fmt::format("is \"{}\", which is not a filter", filter.substr(0, 20)));
  }
}

}  // namespace

std::string decode_meshopt(const View& extension, std::string_view bytes) {
  const std::string mode = extension["mode"].text();
  const uint64_t count = extension["count"].count(), stride = extension["byteStride"].count();
  check_layout(extension, mode, count, stride);
  // The filters work on whole groups of four elements.
  std::string out((count + 3) / 4 * 4 * stride, '\0');
  if (decode_elements(mode, out, count, stride, bytes) != 0)
    extension.fail(fmt::format("is damaged or of a newer version of meshoptimizer: {}", kInstead));
  apply_filter(extension, out, count, stride);
  out.resize(count * stride);
  return out;
}

struct DracoMesh::Decoded {
  std::unique_ptr<draco::Mesh> mesh;
};

DracoMesh::DracoMesh(const View& extension, std::string_view bytes) : decoded_(std::make_unique<Decoded>()) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  auto result = decoder.DecodeMeshFromBuffer(&buffer);
  if (!result.ok())
    extension.fail(
        fmt::format("cannot be decoded by Draco ({}): {}", result.status().error_msg_string(), kInstead));
  decoded_->mesh = std::move(result).value();
}

DracoMesh::~DracoMesh() = default;

Elements DracoMesh::indices() const {
  const draco::Mesh& mesh = *decoded_->mesh;
  Elements out;
  out.components = 1;
  out.count = uint64_t{3} * mesh.num_faces();
  out.values.reserve(out.count);
  for (uint32_t f = 0; f < mesh.num_faces(); ++f) {
    for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(f)))
      out.values.push_back(corner.value());
  }
  return out;
}

Elements DracoMesh::values(const View& attribute, uint64_t id) const {
  draco::Mesh& mesh = *decoded_->mesh;
  const int place = id <= 0xffffffffu ? mesh.GetAttributeIdByUniqueId(static_cast<uint32_t>(id)) : -1;
  if (place < 0) attribute.fail(fmt::format("is {}, which the compressed mesh does not have", id));
  draco::PointAttribute* found = mesh.attribute(place);
  // Draco would read any byte as a bool, which is undefined for those above 1.
  if (found->data_type() == draco::DT_BOOL) attribute.fail("has truth values: expected numbers");
  found->set_normalized(false);  // the accessor says whether it is
  const int n = found->num_components();
  if (n < 1 || n > 16) attribute.fail(fmt::format("has {} numbers per vertex", n));
  Elements out;
  out.components = n;
  out.count = mesh.num_points();
  out.values.resize(out.count * static_cast<uint64_t>(n));
  std::array<double, 16> value{};
  for (uint32_t i = 0; i < mesh.num_points(); ++i) {
    const draco::AttributeValueIndex at = found->mapped_index(draco::PointIndex(i));
    if (at.value() >= found->size() || !found->ConvertValue<double>(at, static_cast<int8_t>(n), value.data()))
      attribute.fail("cannot be decoded");
    std::copy_n(value.begin(), n, out.values.begin() + static_cast<std::ptrdiff_t>(i) * n);
  }
  return out;
}

}  // namespace kaustik::gltf
