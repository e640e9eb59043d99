#include "apps/import/gltf/file/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "apps/import/common/scene_files.h"

namespace kaustik::gltf {
namespace {

constexpr uint64_t kLargestFile = uint64_t{1} << 36;
// Elements of an accessor without a buffer, which is all zeros: no file size bounds their number.
constexpr uint64_t kMostZeros = uint64_t{1} << 24;

constexpr uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

// Reads a little-endian number, as all numbers of these files are.
template <class T>
T little(const char* at) {
  std::make_unsigned_t<std::conditional_t<std::is_floating_point_v<T>, uint32_t, T>> bits = 0;
  for (size_t i = sizeof bits; i-- > 0;)
    bits = static_cast<decltype(bits)>((uint64_t(bits) << 8) | static_cast<unsigned char>(at[i]));
  T value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

struct Component {
  uint64_t bytes;
  double (*read)(const char*);
  double largest;  // the integer that stands for a normalised 1
};

Component component_of(const View& accessor) {
  const View type = accessor["componentType"];
  switch (type.count()) {
    case 5120:
      return {1, [](const char* p) { return double(little<int8_t>(p)); }, 127};
    case 5121:
      return {1, [](const char* p) { return double(little<uint8_t>(p)); }, 255};
    case 5122:
      return {2, [](const char* p) { return double(little<int16_t>(p)); }, 32767};
    case 5123:
      return {2, [](const char* p) { return double(little<uint16_t>(p)); }, 65535};
    case 5125:
      return {4, [](const char* p) { return double(little<uint32_t>(p)); }, 4294967295.0};
    case 5126:
      return {4, [](const char* p) { return double(little<float>(p)); }, 1};
    default:
      type.fail(fmt::format("is {}, which glTF does not define", type.count()));
  }
}

int components_of(const View& accessor) {
  const View type = accessor["type"];
  const std::string text = type.text();
  for (const auto& [name, n] : {std::pair{"SCALAR", 1}, std::pair{"VEC2", 2}, std::pair{"VEC3", 3},
                                std::pair{"VEC4", 4}, std::pair{"MAT4", 16}}) {
    if (text == name) return n;
  }
  type.fail(fmt::format("is \"{}\", which cannot be read", text.substr(0, 20)));
}

// The views of some compressed files name two kinds of bytes; a buffer that only readers without the
// extension need may be absent.
View meshopt_of(const View& object) {
  const View extensions = object["extensions"];
  const View own = extensions["EXT_meshopt_compression"];
  return own ? own : extensions["KHR_meshopt_compression"];
}
bool is_fallback(const View& buffer) {
  return meshopt_of(buffer)["fallback"].flag(false);
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' || c == '-' ? 62 : c == '/' || c == '_' ? 63 : -1;
}

std::string decode_base64(const View& uri, std::string_view text) {
  std::string out;
  uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    if (c == '=') break;
    const int digit = base64_digit(c);
    if (digit < 0) uri.fail("is not base64");
    bits = (bits << 6) | static_cast<uint32_t>(digit);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    out += static_cast<char>((bits >> held) & 0xffu);
  }
  return out;
}

}  // namespace

Document::Document(const ReadableFile& file, SourceFiles& files) {
  const std::filesystem::path& path = file.path();
  std::string error;
  auto bytes = pbrt::read_bytes(file, kLargestFile, error);
  if (!bytes) throw FormatError(error);
  file_ = files.add(path.string(), std::move(*bytes));
  const std::string_view text = files.text(file_);
  if (text.size() >= 4 && little<uint32_t>(text.data()) == kMagic) {
    read_container(text);
  } else {
    read_json(text);
  }
  const std::string version = root()["asset"]["version"].text();
  if (!version.starts_with("2."))
    throw FormatError("it is not glTF 2.0: `asset.version` is missing or has another value");
  read_buffers(path, files);
}

void Document::read_json(std::string_view bytes) {
  try {
    json_ = std::make_shared<const Json>(Json::parse(bytes));
  } catch (const Json::parse_error& error) {
    // The library's own message quotes the file, which may be of any kind.
    throw FormatError(fmt::format("its JSON cannot be read: there is an error at byte {}", error.byte));
  } catch (const Json::out_of_range&) {
    throw FormatError("its JSON holds a number beyond the range of doubles");
  }
  if (!json_->is_object()) throw FormatError("its JSON is not an object");
}

// Reads a .glb file: a header of 12 bytes, then chunks of length, type and bytes. The first chunk is JSON,
// the second, if any, binary.
void Document::read_container(std::string_view bytes) {
  if (bytes.size() < 20) throw FormatError("the file ends within its header");
  if (const uint32_t version = little<uint32_t>(bytes.data() + 4); version != 2)
    throw FormatError(fmt::format("it is version {} of .glb: only version 2 can be read", version));
  const uint64_t length = little<uint32_t>(bytes.data() + 8);
  if (length > bytes.size())
    throw FormatError(fmt::format("the header promises {} bytes: the file has {}", length, bytes.size()));
  bytes = bytes.substr(0, length);
  uint64_t at = 12;
  for (int chunk = 0; at + 8 <= bytes.size(); ++chunk) {
    const uint64_t size = little<uint32_t>(bytes.data() + at);
    const uint32_t type = little<uint32_t>(bytes.data() + at + 4);
    at += 8;
    if (size > bytes.size() - at)
      throw FormatError(
          fmt::format("chunk {} promises {} bytes: {} are left", chunk, size, bytes.size() - at));
    if (chunk == 0 && type != kJsonChunk) throw FormatError("its first chunk is not JSON");
    if (chunk == 0) read_json(bytes.substr(at, size));
    if (chunk == 1 && type == kBinaryChunk) {
      binary_ = bytes.substr(at, size);
      has_binary_ = true;
    }
    at += size;
  }
  if (!json_) throw FormatError("the header promises no chunk: the JSON is missing");
}

std::optional<std::string> Document::data_of_uri(const View& uri) {
  const std::string text = uri.text();
  if (!text.starts_with("data:")) return std::nullopt;
  const size_t comma = text.find(',');
  if (comma == text.npos || text.substr(0, comma).find(";base64") == text.npos)
    uri.fail("holds data that is not base64");
  return decode_base64(uri, std::string_view(text).substr(comma + 1));
}

std::string Document::file_of_uri(const std::string& uri) {
  std::string out;
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'                     ? c - '0'
           : (c | 0x20) >= 'a' && (c | 0x20) <= 'f' ? (c | 0x20) - 'a' + 10
                                                    : -1;
  };
  for (size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0) {
      out += static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2]));
      i += 2;
    } else {
      out += uri[i];
    }
  }
  return out;
}

void Document::read_buffers(const std::filesystem::path& path, SourceFiles& files) {
  for (uint64_t i = 0; i < size("buffers"); ++i) {
    const View buffer = item("buffers", i);
    const View uri = buffer["uri"];
    const uint64_t length = buffer["byteLength"].count();
    std::string_view bytes;
    if (!uri) {
      if (i == 0 && has_binary_) {
        bytes = binary_;
      } else if (is_fallback(buffer)) {
        buffers_.emplace_back();
        continue;
      } else {
        buffer.fail("has no `uri`");
      }
    } else if (auto data = data_of_uri(uri)) {
      bytes = files.text(files.add(path.string(), std::move(*data)));
    } else {
      std::string error;
      const ReadableFile file = files.root().find(path.parent_path(), file_of_uri(uri.text()));
      auto text = pbrt::read_bytes(file, kLargestFile, error);
      if (!text) buffer.fail(error);
      bytes = files.text(files.add(file.path().string(), std::move(*text)));
    }
    if (length > bytes.size())
      buffer.fail(fmt::format("has {} bytes, `byteLength` promises {}", bytes.size(), length));
    buffers_.push_back(bytes.substr(0, length));
  }
}

std::string_view Document::bytes_of_view(uint64_t i) const {
  const View view = item("bufferViews", i);
  const View compressed = meshopt_of(view);
  if (!compressed) return bytes_in_buffer(view);
  const auto found = unpacked_.find(i);
  if (found != unpacked_.end()) return found->second;
  return unpacked_[i] = decode_meshopt(compressed, bytes_in_buffer(compressed));
}

std::string_view Document::bytes_in_buffer(const View& view) const {
  const auto buffer = view["buffer"].index(buffers_.size());
  if (!buffer) view.fail("names no buffer");
  const uint64_t offset = view["byteOffset"].count(0), length = view["byteLength"].count();
  const std::string_view bytes = buffers_[*buffer];
  if (offset > bytes.size() || length > bytes.size() - offset)
    view.fail(
        fmt::format("reaches beyond its buffer: {} bytes from {}, of {}", length, offset, bytes.size()));
  return bytes.substr(offset, length);
}

// Decodes out.count elements; element i begins at offset + i * stride. A stride of 0 means that the elements
// are contiguous.
void Document::decode(std::string_view bytes, uint64_t offset, uint64_t stride, const View& accessor,
                      Elements& out) const {
  const Component component = component_of(accessor);
  const auto n = static_cast<uint64_t>(out.components);
  const uint64_t size = component.bytes * n;
  if (stride == 0) stride = size;
  if (stride < size) accessor.fail(fmt::format("has elements of {} bytes every {} bytes", size, stride));
  const uint64_t room = offset <= bytes.size() ? bytes.size() - offset : 0;
  // Divides rather than multiplies, so that nothing overflows 64 bits: counts go up to 2^53.
  if (out.count > 0 && (room < size || (room - size) / stride < out.count - 1))
    accessor.fail(fmt::format("reaches beyond its bytes: {} elements of {} bytes from {}, of {}", out.count,
                              size, offset, bytes.size()));
  const bool normalised = accessor["normalized"].flag(false);
  out.values.resize(out.count * n);
  for (uint64_t i = 0; i < out.count; ++i) {
    for (uint64_t k = 0; k < n; ++k) {
      double v = component.read(bytes.data() + offset + i * stride + k * component.bytes);
      if (normalised) v = std::max(v / component.largest, -1.0);
      out.values[i * n + k] = v;
    }
  }
}

uint64_t Document::count(uint64_t accessor) const {
  const auto found = decoded_.find(accessor);
  return found != decoded_.end() ? found->second.count : item("accessors", accessor)["count"].count();
}

int Document::components(uint64_t accessor) const {
  const auto found = decoded_.find(accessor);
  return found != decoded_.end() ? found->second.components : components_of(item("accessors", accessor));
}

Elements Document::elements(uint64_t index, int components, bool any) const {
  const View accessor = item("accessors", index);
  if (const int n = this->components(index); n != components)
    accessor.fail(fmt::format("has {} numbers per element instead of {}", n, components));
  Elements out = read(index, accessor, components);
  const auto bad =
      std::find_if_not(out.values.begin(), out.values.end(), [](double v) { return std::isfinite(v); });
  if (!any && bad != out.values.end())
    accessor.fail(fmt::format("has a number that is not finite, in element {}",
                              (bad - out.values.begin()) / std::ptrdiff_t{components}));
  return out;
}

Elements Document::read(uint64_t index, const View& accessor, int components) const {
  if (const auto found = decoded_.find(index); found != decoded_.end()) return found->second;
  Elements out;
  out.components = components;
  out.count = accessor["count"].count();
  if (const auto view = accessor["bufferView"].index(size("bufferViews"))) {
    decode(bytes_of_view(*view), accessor["byteOffset"].count(0),
           item("bufferViews", *view)["byteStride"].count(0), accessor, out);
  } else {
    if (out.count > kMostZeros) accessor.fail(fmt::format("has {} elements and no bytes", out.count));
    out.values.assign(out.count * static_cast<uint64_t>(components), 0.0);
  }
  if (accessor.has("sparse")) apply_sparse(accessor, out);
  return out;
}

void Document::decompress(const View& primitive) {
  const View extension = primitive["extensions"]["KHR_draco_mesh_compression"];
  if (!extension) return;
  const auto view = extension["bufferView"].index(size("bufferViews"));
  if (!view) extension.fail("names no bytes");
  const DracoMesh mesh(extension, bytes_of_view(*view));
  if (const auto indices = primitive["indices"].index(size("accessors"))) decoded_[*indices] = mesh.indices();
  for (const std::string& name : extension["attributes"].names()) {
    const View id = extension["attributes"][name.c_str()];
    const auto accessor = primitive["attributes"][name.c_str()].index(size("accessors"));
    if (!accessor) continue;
    Elements values = mesh.values(id, id.count());
    const View type = item("accessors", *accessor);
    const double largest = component_of(type).largest;
    if (type["normalized"].flag(false)) {
      for (double& v : values.values) v = std::max(v / largest, -1.0);
    }
    decoded_[*accessor] = std::move(values);
  }
}

// Replaces some elements by those of the accessor's `sparse` part.
void Document::apply_sparse(const View& accessor, Elements& out) const {
  const View sparse = accessor["sparse"];
  const uint64_t count = sparse["count"].count();
  if (count > out.count) sparse.fail(fmt::format("replaces {} elements: there are {}", count, out.count));
  const auto part = [&](const char* name, const View& types, int components) {
    Elements e;
    e.count = count, e.components = components;
    const View where = sparse[name];
    const auto view = where["bufferView"].index(size("bufferViews"));
    if (!view) sparse.fail(fmt::format("has no bytes for its {}", name));
    decode(bytes_of_view(*view), where["byteOffset"].count(0), 0, types, e);
    return e;
  };
  const Elements indices = part("indices", sparse["indices"], 1);
  const Elements values = part("values", accessor, out.components);
  const auto n = static_cast<uint64_t>(out.components);
  for (uint64_t i = 0; i < count; ++i) {
    const auto target = static_cast<uint64_t>(indices.values[i]);
    if (target >= out.count) sparse.fail(fmt::format("replaces element {}: there are {}", target, out.count));
    std::copy_n(values.values.begin() + static_cast<std::ptrdiff_t>(i * n), n,
                out.values.begin() + static_cast<std::ptrdiff_t>(target * n));
  }
}

}  // namespace kaustik::gltf
