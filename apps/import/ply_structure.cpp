#include "apps/import/ply_structure.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <vector>

namespace kaustik::pbrt {
namespace {

constexpr size_t kLongestHeader = 1 << 20;

struct ScalarType {
  std::string_view name, other_name;
  uint32_t size;
  bool integer;
};
constexpr std::array<ScalarType, 8> kScalars = {{{"char", "int8", 1, true},
                                                 {"uchar", "uint8", 1, true},
                                                 {"short", "int16", 2, true},
                                                 {"ushort", "uint16", 2, true},
                                                 {"int", "int32", 4, true},
                                                 {"uint", "uint32", 4, true},
                                                 {"float", "float32", 4, false},
                                                 {"double", "float64", 8, false}}};

struct Property {
  std::string name;
  const ScalarType* type = nullptr;   // of the entries, for lists
  const ScalarType* count = nullptr;  // of lists
};
struct Element {
  std::string name;
  uint64_t count = 0;
  std::vector<Property> properties;
};
enum class Format { kAscii, kLittle, kBig };

const ScalarType* scalar(std::string_view name) {
  for (const ScalarType& t : kScalars) {
    if (t.name == name || t.other_name == name) return &t;
  }
  return nullptr;
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

class Walker {
 public:
  Walker(std::string_view bytes, std::string& error) : bytes_(bytes), error_(error) {}

  std::optional<PlyStructure> walk() {
    if (!read_header() || !check_elements() || !check_size()) return std::nullopt;
    for (const Element& e : elements_) {
      if (!(format_ == Format::kAscii ? walk_ascii(e) : walk_binary(e))) return std::nullopt;
    }
    return structure_;
  }

 private:
  bool fail(std::string message) {
    error_ = fmt::format("byte {}: {}", position_, message);
    return false;
  }

  bool next_line(std::string_view& line) {
    if (position_ >= bytes_.size()) return false;
    const size_t end = bytes_.find('\n', position_);
    line = bytes_.substr(position_, end == bytes_.npos ? end : end - position_);
    next_ = end == bytes_.npos ? bytes_.size() : end + 1;
    return true;
  }

  bool read_header() {
    std::string_view line;
    if (!next_line(line) || words(line) != std::vector<std::string_view>{"ply"}) {
      return fail("not a PLY file: it must begin with `ply`");
    }
    for (position_ = next_; next_line(line); position_ = next_) {
      if (position_ > kLongestHeader) return fail("the header does not end");
      const auto w = words(line);
      if (w.size() == 1 && w[0] == "end_header") {
        position_ = next_;
        return has_format_ || fail("the header names no format");
      }
      if (!read_header_line(w)) return false;
    }
    return fail("the header does not end");
  }

  bool read_header_line(const std::vector<std::string_view>& w) {
    if (w.empty() || w[0] == "comment" || w[0] == "obj_info") return true;
    if (w[0] == "format" && w.size() == 3) return read_format(w[1]);
    if (w[0] == "element" && w.size() == 3) {
      Element e{std::string(w[1]), 0, {}};
      const auto [end, status] = std::from_chars(w[2].data(), w[2].data() + w[2].size(), e.count);
      if (status != std::errc() || end != w[2].data() + w[2].size()) return fail("an element needs a count");
      elements_.push_back(std::move(e));
      return true;
    }
    if (w[0] == "property" && !elements_.empty()) {
      const bool list = w.size() == 5 && w[1] == "list";
      const Property p{std::string(w.back()), w.size() >= 3 ? scalar(w[w.size() - 2]) : nullptr,
                       list ? scalar(w[2]) : nullptr};
      if (p.type && (list ? p.count && p.count->integer : w.size() == 3)) {
        elements_.back().properties.push_back(p);
        return true;
      }
    }
    return fail("unknown header line");
  }

  bool read_format(std::string_view name) {
    has_format_ = true;
    if (name == "ascii") {
      format_ = Format::kAscii;
    } else if (name == "binary_little_endian") {
      format_ = Format::kLittle;
    } else if (name == "binary_big_endian") {
      format_ = Format::kBig;
    } else {
      return fail("unknown format");
    }
    return true;
  }

  bool check_elements() {
    const Element* vertex = nullptr;
    const Element* face = nullptr;
    for (const Element& e : elements_) {
      if (e.name == "vertex") vertex = &e;
      if (e.name == "face") face = &e;
    }
    if (!vertex || vertex->count == 0) return fail("there are no vertices");
    if (!face || face->count == 0) return fail("there are no faces");
    for (const std::string_view axis : {"x", "y", "z"}) {
      bool found = false;
      for (const Property& p : vertex->properties) found = found || (p.name == axis && !p.count);
      if (!found) return fail(fmt::format("vertices have no `{}`", axis));
    }
    for (const Property& p : face->properties) {
      if (is_indices(p)) return true;
    }
    return fail("faces have no list `vertex_indices`");
  }

  static bool is_indices(const Property& p) {
    return p.count && p.type->integer && (p.name == "vertex_indices" || p.name == "vertex_index");
  }

  // The least that the promised elements need, before anything of that size is walked.
  bool check_size() {
    const uint64_t rest = bytes_.size() - position_;
    uint64_t needed = 0;
    for (const Element& e : elements_) {
      uint64_t least = 0;
      for (const Property& p : e.properties) {
        least += format_ == Format::kAscii ? 2 : p.count ? p.count->size : p.type->size;
      }
      // A text may end without a blank.
      if (least > 0 && e.count > (rest + 1 - std::min(rest + 1, needed)) / least) {
        return fail(
            fmt::format("the header promises {} of element `{}`, more than the file's {} bytes can hold",
                        e.count, e.name, bytes_.size()));
      }
      needed += least * e.count;
    }
    return true;
  }

  bool ends_early(const Element& e, uint64_t i) {
    return fail(fmt::format("the file ends inside element `{}` {} of {}", e.name, i + 1, e.count));
  }

  bool count_face(const Element& e, const Property& p, uint64_t i, int64_t n) {
    if (e.name != "face" || !is_indices(p)) return n >= 0 || fail("a list of negative length");
    if (n < 3) return fail(fmt::format("face {} has {} vertices", i, n));
    structure_.triangles += static_cast<uint64_t>(n) - 2;
    structure_.polygons = structure_.polygons || n > 3;
    return true;
  }

  int64_t integer_at(const ScalarType& type) const {
    uint64_t raw = 0;
    for (uint32_t b = 0; b < type.size; ++b) {
      const uint32_t place = format_ == Format::kLittle ? b : type.size - 1 - b;
      raw |= static_cast<uint64_t>(static_cast<unsigned char>(bytes_[position_ + b])) << (8 * place);
    }
    const bool is_signed = type.name[0] != 'u';
    const uint32_t bits = 8 * type.size;
    if (is_signed && (raw >> (bits - 1)) != 0) return static_cast<int64_t>(raw) - (int64_t{1} << bits);
    return static_cast<int64_t>(raw);
  }

  bool walk_binary(const Element& e) {
    note(e);
    for (uint64_t i = 0; i < e.count && !e.properties.empty(); ++i) {
      for (const Property& p : e.properties) {
        uint64_t size = p.type->size;
        if (p.count) {
          if (bytes_.size() - position_ < p.count->size) return ends_early(e, i);
          const int64_t n = integer_at(*p.count);
          if (!count_face(e, p, i, n)) return false;
          position_ += p.count->size;
          size *= static_cast<uint64_t>(n);
        }
        if (bytes_.size() - position_ < size) return ends_early(e, i);
        position_ += size;
      }
    }
    return true;
  }

  // One line per element, as every writer does; blank ones are skipped.
  bool walk_ascii(const Element& e) {
    note(e);
    for (uint64_t i = 0; i < e.count && !e.properties.empty(); ++i) {
      std::vector<std::string_view> w;
      while (w.empty()) {
        std::string_view line;
        if (!next_line(line)) return ends_early(e, i);
        w = words(line);
        if (!w.empty() && !walk_line(e, i, w)) return false;
        position_ = next_;
      }
    }
    return true;
  }

  bool walk_line(const Element& e, uint64_t i, const std::vector<std::string_view>& w) {
    size_t at = 0;
    for (const Property& p : e.properties) {
      uint64_t n = 1;
      if (p.count) {
        int64_t count = -1;
        if (at < w.size()) std::from_chars(w[at].data(), w[at].data() + w[at].size(), count);
        if (!count_face(e, p, i, count)) return false;
        ++at;
        n = static_cast<uint64_t>(count);
      }
      for (uint64_t k = 0; k < n; ++k, ++at) {
        if (at >= w.size())
          return fail(fmt::format("element `{}` {} has too few values on its line", e.name, i));
        double value = 0;
        const auto [end, status] = std::from_chars(w[at].data(), w[at].data() + w[at].size(), value);
        if (status == std::errc::invalid_argument || end != w[at].data() + w[at].size()) {
          return fail(fmt::format("expected a number, not `{}`", w[at].substr(0, 40)));
        }
      }
    }
    return at == w.size() || fail(fmt::format("element `{}` {} has too many values on its line", e.name, i));
  }

  void note(const Element& e) {
    if (e.name == "vertex") structure_.vertices = e.count;
    if (e.name == "face") structure_.faces = e.count;
  }

  std::string_view bytes_;
  std::string& error_;
  size_t position_ = 0, next_ = 0;
  Format format_ = Format::kAscii;
  bool has_format_ = false;
  std::vector<Element> elements_;
  PlyStructure structure_;
};

}  // namespace

std::optional<PlyStructure> check_ply(std::string_view bytes, std::string& error) {
  return Walker(bytes, error).walk();
}

}  // namespace kaustik::pbrt
