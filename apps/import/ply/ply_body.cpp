#include "apps/import/ply/ply_body.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cstring>

namespace kaustik::pbrt {
namespace {

constexpr uint64_t kBlock = 1 << 15;  // elements

template <class T>
T load(const char* at, bool swap) {
  char bytes[sizeof(T)];
  for (size_t i = 0; i < sizeof(T); ++i) bytes[i] = at[swap ? sizeof(T) - 1 - i : i];
  return std::bit_cast<T>(bytes);
}

int64_t load_integer(const char* at, PlyType type, bool swap) {
  switch (type) {
    case PlyType::kInt8:
      return load<int8_t>(at, swap);
    case PlyType::kUint8:
      return load<uint8_t>(at, swap);
    case PlyType::kInt16:
      return load<int16_t>(at, swap);
    case PlyType::kUint16:
      return load<uint16_t>(at, swap);
    case PlyType::kInt32:
      return load<int32_t>(at, swap);
    default:
      return load<uint32_t>(at, swap);
  }
}

double load_number(const char* at, PlyType type, bool swap) {
  if (type == PlyType::kFloat) return double(load<float>(at, swap));
  if (type == PlyType::kDouble) return load<double>(at, swap);
  return static_cast<double>(load_integer(at, type, swap));
}

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

// The next word of a line, empty at its end; moves `at` behind it.
std::string_view next_word(std::string_view line, size_t& at) {
  while (at < line.size() && is_blank(line[at])) ++at;
  const size_t begin = at;
  while (at < line.size() && !is_blank(line[at])) ++at;
  return line.substr(begin, at - begin);
}

std::string ends_early(size_t position, const PlyElement& e, uint64_t i) {
  return ply_error(position,
                   fmt::format("the file ends inside element `{}` {} of {}", e.name, i + 1, e.count));
}

class Walker {
 public:
  Walker(std::string_view bytes, const PlyHeader& header, size_t element, size_t begin)
      : bytes_(bytes),
        element_(header.elements[element]),
        swap_(header.format == PlyFormat::kBig),
        text_(header.format == PlyFormat::kAscii),
        position_(begin),
        indices_(element == header.face ? element_.find_indices() : std::nullopt) {}

  std::optional<PlyExtent> walk(std::string& error) {
    if (!text_ && !element_.has_lists()) {
      step_over_records();
    } else if (!element_.properties.empty()) {
      for (uint64_t i = 0; i < element_.count && error_.empty(); ++i) {
        begin_block(i);
        text_ ? walk_line(i) : walk_record(i);
      }
    }
    error = error_;
    if (!error.empty()) return std::nullopt;
    if (!extent_.blocks.empty()) extent_.blocks.back().end = element_.count;
    extent_.end = position_;
    return std::move(extent_);
  }

 private:
  void begin_block(uint64_t i) {
    if (i % kBlock != 0) return;
    if (i > 0) extent_.blocks.back().end = i;
    extent_.blocks.push_back({i, i, position_, extent_.triangles});
  }

  void step_over_records() {
    const uint64_t size = element_.least_size();
    const uint64_t there = size == 0 ? element_.count : (bytes_.size() - position_) / size;
    if (there < element_.count) {
      error_ = ends_early(position_ + there * size, element_, there);
      return;
    }
    const size_t begin = position_;
    for (uint64_t i = 0; i < element_.count && size > 0; i += kBlock) {
      position_ = begin + i * size;
      begin_block(i);
    }
    position_ = begin + element_.count * size;
  }

  bool count_corners(uint64_t i, int64_t n) {
    if (n < 3) {
      error_ = ply_error(position_, fmt::format("face {} has {} vertices", i, n));
      return false;
    }
    extent_.triangles += static_cast<uint64_t>(n) - 2;
    return true;
  }

  bool check_length(uint64_t i, size_t property, int64_t n) {
    if (indices_ == property) return count_corners(i, n);
    if (n < 0) error_ = ply_error(position_, "a list of negative length");
    return n >= 0;
  }

  void walk_record(uint64_t i) {
    for (size_t k = 0; k < element_.properties.size(); ++k) {
      const PlyProperty& p = element_.properties[k];
      uint64_t size = size_of(p.type);
      if (p.count) {
        if (bytes_.size() - position_ < size_of(*p.count)) {
          error_ = ends_early(position_, element_, i);
          return;
        }
        const int64_t n = load_integer(bytes_.data() + position_, *p.count, swap_);
        if (!check_length(i, k, n)) return;
        position_ += size_of(*p.count);
        size *= static_cast<uint64_t>(n);
      }
      if (bytes_.size() - position_ < size) {
        error_ = ends_early(position_, element_, i);
        return;
      }
      position_ += size;
    }
  }

  // Expects one line per element, as every writer emits them; skips blank lines.
  void walk_line(uint64_t i) {
    while (position_ < bytes_.size()) {
      const size_t end = std::min(bytes_.find('\n', position_), bytes_.size());
      const std::string_view line = bytes_.substr(position_, end - position_);
      size_t at = 0;
      const bool blank = next_word(line, at).empty();
      if (!blank && indices_) count_line(i, line);
      if (!error_.empty()) return;
      position_ = std::min(end + 1, bytes_.size());
      if (!blank) return;
    }
    error_ = ends_early(position_, element_, i);
  }

  // Counts the corners of a face. Lists that stand before the corners have to be stepped over.
  void count_line(uint64_t i, std::string_view line) {
    size_t at = 0;
    for (size_t k = 0; k <= *indices_; ++k) {
      const std::string_view word = next_word(line, at);
      if (!element_.properties[k].count) continue;
      int64_t n = -1;
      std::from_chars(word.data(), word.data() + word.size(), n);
      if (!check_length(i, k, n)) return;
      // n may exceed what the line holds, so the line's end stops the loop too.
      for (int64_t j = 0; j < n && k < *indices_ && at < line.size(); ++j) next_word(line, at);
      // A line shorter than its own count would reserve memory for triangles that do not exist.
      if (k == *indices_ && static_cast<uint64_t>(n) > line.size()) {
        error_ = ply_error(position_, fmt::format("element `face` {} has too few values on its line", i));
      }
    }
  }

  std::string_view bytes_;
  const PlyElement& element_;
  bool swap_, text_;
  size_t position_;
  std::optional<size_t> indices_;
  PlyExtent extent_;
  std::string error_;
};

class BlockReader {
 public:
  BlockReader(std::string_view bytes, const PlyHeader& header, size_t element, std::optional<size_t> list)
      : bytes_(bytes),
        element_(header.elements[element]),
        swap_(header.format == PlyFormat::kBig),
        text_(header.format == PlyFormat::kAscii),
        list_(list) {
    values_.scalars.resize(element_.properties.size());
  }

  std::string read(const PlyBlock& block, const std::function<std::string(const PlyValues&)>& take) {
    position_ = block.begin;
    for (values_.number = block.first; values_.number < block.end; ++values_.number) {
      values_.indices.clear();
      std::string error = text_ ? read_line() : read_record();
      if (error.empty()) error = take(values_);
      if (!error.empty()) return error;
    }
    return {};
  }

 private:
  std::string read_record() {
    values_.position = position_;
    const char* at = bytes_.data() + position_;
    for (size_t k = 0; k < element_.properties.size(); ++k) {
      const PlyProperty& p = element_.properties[k];
      if (!p.count) {
        values_.scalars[k] = load_number(at, p.type, swap_);
        at += size_of(p.type);
        continue;
      }
      const int64_t n = load_integer(at, *p.count, swap_);
      at += size_of(*p.count);
      for (int64_t j = 0; j < n && list_ == k; ++j)
        values_.indices.push_back(load_integer(at + j * size_of(p.type), p.type, swap_));
      at += n * size_of(p.type);
    }
    position_ = static_cast<size_t>(at - bytes_.data());
    return {};
  }

  std::string fail(std::string_view message) const { return ply_error(values_.position, message); }

  template <class T>
  std::string read_word(std::string_view line, size_t& at, T* value) const {
    const std::string_view word = next_word(line, at);
    if (word.empty())
      return fail(
          fmt::format("element `{}` {} has too few values on its line", element_.name, values_.number));
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), *value);
    if (status == std::errc::invalid_argument || end != word.data() + word.size())
      return fail(fmt::format("expected a number, not `{}`", word.substr(0, 40)));
    return {};
  }

  std::string read_line() {
    size_t at = 0, end = 0;
    std::string_view line;
    for (bool blank = true; blank; position_ = end + 1) {
      values_.position = position_;
      end = std::min(bytes_.find('\n', position_), bytes_.size());
      line = bytes_.substr(position_, end - position_);
      at = 0;
      blank = next_word(line, at).empty();
    }
    at = 0;
    for (size_t k = 0; k < element_.properties.size(); ++k) {
      const PlyProperty& p = element_.properties[k];
      std::string error = p.count ? read_list(line, at, k) : read_word(line, at, &values_.scalars[k]);
      if (!error.empty()) return error;
    }
    if (!next_word(line, at).empty())
      return fail(
          fmt::format("element `{}` {} has too many values on its line", element_.name, values_.number));
    return {};
  }

  std::string read_list(std::string_view line, size_t& at, size_t k) {
    int64_t n = 0;
    std::string error = read_word(line, at, &n);
    if (error.empty() && n < 0) error = fail("a list of negative length");
    for (int64_t j = 0; j < n && error.empty(); ++j) {
      double value = 0;
      int64_t index = 0;
      error = list_ == k ? read_word(line, at, &index) : read_word(line, at, &value);
      if (list_ == k && error.empty()) values_.indices.push_back(index);
    }
    return error;
  }

  std::string_view bytes_;
  const PlyElement& element_;
  bool swap_, text_;
  std::optional<size_t> list_;
  size_t position_ = 0;
  PlyValues values_;
};

}  // namespace

std::optional<PlyExtent> walk_ply(std::string_view bytes, const PlyHeader& header, size_t element,
                                  size_t begin, std::string& error) {
  return Walker(bytes, header, element, begin).walk(error);
}

std::string read_ply_block(std::string_view bytes, const PlyHeader& header, size_t element,
                           const PlyBlock& block, std::optional<size_t> list,
                           const std::function<std::string(const PlyValues&)>& take) {
  return BlockReader(bytes, header, element, list).read(block, take);
}

}  // namespace kaustik::pbrt
