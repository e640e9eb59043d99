#include "apps/import/ply/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace kaustik::pbrt {
namespace {

constexpr size_t kLongestHeader = 1 << 20;

struct Scalar {
  std::string_view name, other_name;
  uint32_t size;
};
// In the order of the enumerators of PlyType.
constexpr std::array<Scalar, 8> kScalars = {{{"char", "int8", 1},
                                             {"uchar", "uint8", 1},
                                             {"short", "int16", 2},
                                             {"ushort", "uint16", 2},
                                             {"int", "int32", 4},
                                             {"uint", "uint32", 4},
                                             {"float", "float32", 4},
                                             {"double", "float64", 8}}};

std::optional<PlyType> scalar(std::string_view name) {
  for (size_t i = 0; i < kScalars.size(); ++i)
    if (kScalars[i].name == name || kScalars[i].other_name == name) return static_cast<PlyType>(i);
  return std::nullopt;
}

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> out;
  size_t i = 0;
  while ((i = line.find_first_not_of(" \t\r", i)) != line.npos) {
    const size_t end = std::min(line.find_first_of(" \t\r", i), line.size());
    out.push_back(line.substr(i, end - i));
    i = end;
  }
  return out;
}

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, std::string& error) : bytes_(bytes), error_(error) {}

  std::optional<PlyHeader> read() {
    if (!read_lines()) return std::nullopt;
    header_.body = position_;
    if (!check_elements() || !check_size()) return std::nullopt;
    return std::move(header_);
  }

 private:
  bool fail(std::string_view message) {
    error_ = ply_error(position_, message);
    return false;
  }

  bool next_line(std::string_view& line) {
    if (position_ >= bytes_.size()) return false;
    const size_t end = bytes_.substr(0, position_ + kLongestHeader).find('\n', position_);
    line = bytes_.substr(position_, std::min(end, position_ + kLongestHeader) - position_);
    next_ = end == bytes_.npos ? bytes_.size() : end + 1;
    return true;
  }

  bool read_lines() {
    std::string_view line;
    if (!next_line(line) || words(line) != std::vector<std::string_view>{"ply"})
      return fail("not a PLY file: it must begin with `ply`");
    for (position_ = next_; next_line(line); position_ = next_) {
      if (position_ > kLongestHeader) return fail("the header does not end");
      const auto w = words(line);
      if (w.size() == 1 && w[0] == "end_header") {
        position_ = next_;
        return has_format_ || fail("the header names no format");
      }
      if (!read_line(w)) return false;
    }
    return fail("the header does not end");
  }

  bool read_line(const std::vector<std::string_view>& w) {
    if (w.empty() || w[0] == "comment" || w[0] == "obj_info") return true;
    if (w[0] == "format" && w.size() == 3) return read_format(w[1]);
    if (w[0] == "element" && w.size() == 3) {
      PlyElement e{std::string(w[1]), 0, {}};
      const auto [end, status] = std::from_chars(w[2].data(), w[2].data() + w[2].size(), e.count);
      if (status != std::errc() || end != w[2].data() + w[2].size()) return fail("an element needs a count");
      header_.elements.push_back(std::move(e));
      return true;
    }
    if (w[0] == "property" && !header_.elements.empty()) {
      const bool list = w.size() == 5 && w[1] == "list";
      const auto type = w.size() >= 3 ? scalar(w[w.size() - 2]) : std::nullopt;
      const auto count = list ? scalar(w[2]) : std::nullopt;
      if (type && (list ? count && is_integer(*count) : w.size() == 3)) {
        header_.elements.back().properties.push_back({std::string(w.back()), *type, count});
        return true;
      }
    }
    return fail("unknown header line");
  }

  bool read_format(std::string_view name) {
    has_format_ = true;
    if (name == "ascii") {
      header_.format = PlyFormat::kAscii;
    } else if (name == "binary_little_endian") {
      header_.format = PlyFormat::kLittle;
    } else if (name == "binary_big_endian") {
      header_.format = PlyFormat::kBig;
    } else {
      return fail("unknown format");
    }
    return true;
  }

  // Index of the only element with that name; the number of elements when none has it; nothing, with an
  // error, when two have it.
  std::optional<size_t> only(std::string_view name) {
    size_t found = header_.elements.size();
    for (size_t i = 0; i < header_.elements.size(); ++i) {
      if (header_.elements[i].name != name) continue;
      if (found < header_.elements.size()) {
        fail(fmt::format("there are two elements `{}`", name));
        return std::nullopt;
      }
      found = i;
    }
    return found;
  }

  bool check_elements() {
    const auto vertex = only("vertex"), face = only("face");
    if (!vertex || !face) return false;
    header_.vertex = *vertex;
    header_.face = *face;
    const size_t none = header_.elements.size();
    if (*vertex == none || header_.elements[*vertex].count == 0) return fail("there are no vertices");
    if (*face == none || header_.elements[*face].count == 0) return fail("there are no faces");
    if (header_.elements[*vertex].count > 0xffffffffu) return fail("there are more than 2^32 vertices");
    for (const std::string_view axis : {"x", "y", "z"})
      if (!header_.elements[*vertex].find(axis)) return fail(fmt::format("vertices have no `{}`", axis));
    return header_.elements[*face].find_indices() || fail("faces have no list `vertex_indices`");
  }

  // Compares the least number of bytes that the declared elements need with the size of the file.
  bool check_size() {
    const uint64_t rest = bytes_.size() - position_;
    uint64_t needed = 0;
    for (const PlyElement& e : header_.elements) {
      const uint64_t least = header_.format == PlyFormat::kAscii ? 2 * e.properties.size() : e.least_size();
      // + 1: the last value of a text file may lack the separator after it.
      if (least > 0 && e.count > (rest + 1 - std::min(rest + 1, needed)) / least) {
        return fail(
            fmt::format("the header promises {} of element `{}`, more than the file's {} bytes can hold",
                        e.count, e.name, bytes_.size()));
      }
      needed += least * e.count;
    }
    return true;
  }

  std::string_view bytes_;
  std::string& error_;
  size_t position_ = 0, next_ = 0;
  bool has_format_ = false;
  PlyHeader header_;
};

}  // namespace

uint32_t size_of(PlyType type) {
  return kScalars[static_cast<size_t>(type)].size;
}
bool is_integer(PlyType type) {
  return type < PlyType::kFloat;
}

std::optional<size_t> PlyElement::find(std::string_view property) const {
  for (size_t i = 0; i < properties.size(); ++i)
    if (properties[i].name == property && !properties[i].count) return i;
  return std::nullopt;
}

bool PlyElement::has_lists() const {
  return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& p) { return p.count; });
}

std::optional<size_t> PlyElement::find_indices() const {
  for (size_t i = 0; i < properties.size(); ++i) {
    const PlyProperty& p = properties[i];
    if (p.count && is_integer(p.type) && (p.name == "vertex_indices" || p.name == "vertex_index")) return i;
  }
  return std::nullopt;
}

uint64_t PlyElement::least_size() const {
  uint64_t size = 0;
  for (const PlyProperty& p : properties) size += size_of(p.count.value_or(p.type));
  return size;
}

std::string ply_error(size_t position, std::string_view message) {
  return fmt::format("byte {}: {}", position, message);
}

std::optional<PlyHeader> read_ply_header(std::string_view bytes, std::string& error) {
  return HeaderReader(bytes, error).read();
}

}  // namespace kaustik::pbrt
