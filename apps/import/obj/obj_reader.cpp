#include "apps/import/obj/obj_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "apps/import/obj/obj_text.h"
#include "core/parallel/parallel.h"
#include "core/spectrum/srgb.h"

namespace kaustik::obj {
namespace {

constexpr size_t kPartBytes = size_t{1} << 21;

// Numbers of lines, of v, vt and vn among them; those of a part or of all parts before it.
struct Counts {
  uint64_t lines = 0, v = 0, vt = 0, vn = 0;
};

// The parts end after a line end that no backslash precedes.
std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> parts;
  while (!text.empty()) {
    size_t end = std::min(kPartBytes, text.size());
    while (end < text.size()) {
      const size_t line_end = text.find('\n', end);
      if (line_end == text.npos) {
        end = text.size();
        break;
      }
      end = line_end + 1;
      const std::string_view line = trimmed(text.substr(0, line_end));
      if (line.empty() || line.back() != '\\') break;
    }
    parts.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return parts;
}

Counts count_lines(std::string_view text) {
  Counts counts;
  while (!text.empty()) {
    const size_t end = text.find('\n');
    const std::string_view keyword = Words(text.substr(0, end)).next();
    if (!keyword.empty() && keyword[0] == 'v') {
      counts.v += keyword == "v";
      counts.vt += keyword == "vt";
      counts.vn += keyword == "vn";
    }
    if (end == text.npos) break;
    ++counts.lines;
    text.remove_prefix(end + 1);
  }
  return counts;
}

struct ReadError {
  SourceLocation where;
  std::string message;
  uint64_t count = 0;
};

// Reads one part into the common arrays.
class PartReader {
 public:
  PartReader(std::string_view text, uint32_t file, const Counts& before, const Counts& all, ObjText& out,
             ObjPart& part)
      : text_(text), before_(before), all_(all), out_(out), part_(part) {
    where_ = {file, uint32_t(before.lines) + 1, 0};
  }

  ReadError read() {
    std::string joined;
    uint32_t lines = 0;
    for (; !text_.empty(); where_.line += lines) {
      const std::string_view line = take_line(text_, joined, lines);
      Words words(line);
      const std::string_view keyword = words.next();
      if (!keyword.empty()) read_line(keyword, words);
    }
    return std::move(error_);
  }

 private:
  void read_line(std::string_view keyword, Words& words) {
    if (keyword == "v") return read_position(words);
    if (keyword == "f" || keyword == "fo") return read_face(words);
    if (keyword == "vt") return read_uv(words);
    if (keyword == "vn") return read_normal(words);
    using Kind = StateChange::Kind;
    if (keyword == "o") return change(Kind::kObject, words);
    if (keyword == "g") return change(Kind::kGroup, words);
    if (keyword == "s") return change(Kind::kSmoothing, words);
    if (keyword == "usemtl") return change(Kind::kMaterial, words);
    if (keyword == "mtllib") return change(Kind::kLibrary, words);
    leave_out(keyword, words);
  }

  SourceLocation at(const Words& words) const { return {where_.file, where_.line, uint32_t(words.column())}; }
  void fail(const Words& words, const std::string& message) {
    if (error_.count++ == 0) error_.where = at(words), error_.message = message;
  }
  void warn(const Words& words, const std::string& cause) { part_.warnings.say(at(words), cause); }

  // Reads up to `count` numbers; returns how many there are.
  size_t numbers(Words& words, double* out, size_t count) {
    for (size_t n = 0; n < count; ++n) {
      const std::string_view word = words.next();
      if (word.empty()) return n;
      const auto value = number_of(word);
      if (!value) {
        fail(words, fmt::format("`{}` is not a number", word.substr(0, 40)));
        return n;
      }
      out[n] = *value;
    }
    return count;
  }

  // Three coordinates, perhaps followed by a weight, or by a colour.
  void read_position(Words& words) {
    glm::dvec3& p = out_.P[before_.v + v_++];
    p = glm::dvec3(0);
    if (numbers(words, &p.x, 3) < 3)
      return warn(words, "a vertex has fewer than three coordinates: the others are 0");
    std::array<std::optional<double>, 3> more;
    for (auto& number : more) number = number_of(words.next());
    if (more[0] && more[1] && more[2]) return add_colour({float(*more[0]), float(*more[1]), float(*more[2])});
    if (!more[1] && more[0] && std::isfinite(*more[0]) && *more[0] != 0) p /= *more[0];
  }

  // Programs write the colours that they show: sRGB.
  void add_colour(const glm::vec3& srgb) {
    part_.colours.resize(v_, glm::vec3(1));
    for (int k = 0; k < 3; ++k) {
      const float c = std::isfinite(srgb[k]) ? std::clamp(srgb[k], 0.0f, 1.0f) : 1;
      part_.colours.back()[k] = linear_from_srgb(c);
    }
  }

  void read_uv(Words& words) {
    std::array<double, 2> x{};
    numbers(words, x.data(), 2);
    const bool finite = std::isfinite(x[0] + x[1]);
    out_.uv[before_.vt + vt_++] = finite ? glm::vec2(x[0], x[1]) : glm::vec2(0);
  }

  void read_normal(Words& words) {
    std::array<double, 3> x{};
    numbers(words, x.data(), 3);
    out_.N[before_.vn + vn_++] = {float(x[0]), float(x[1]), float(x[2])};
  }

  // Reads one index at the front of `text`. Positive ones count from one, negative ones back from the last
  // element before this line.
  static std::optional<int64_t> take_index(std::string_view& text) {
    int64_t index = 0;
    if (text.size() > 1 && text[0] == '+') text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error != std::errc()) return std::nullopt;
    text.remove_prefix(size_t(end - text.data()));
    return index;
  }
  static uint32_t element(int64_t index, uint64_t so_far, uint64_t all) {
    const int64_t i = index > 0 ? index - 1 : index + int64_t(so_far);
    return index != 0 && i >= 0 && uint64_t(i) < all ? uint32_t(i) : kNone;
  }

  void read_face(Words& words) {
    face_.clear();
    bool ok = true;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      const auto corner = read_corner(word, words);
      ok = ok && corner.has_value();
      if (corner) face_.push_back(*corner);
    }
    if (!ok) return;
    if (face_.size() < 3) return warn(words, "a face has fewer than three corners and is left out");
    for (const auto& corner : face_) part_.corners.add(corner);
    part_.sizes.push_back(uint32_t(face_.size()));
  }

  // `v`, `v/vt`, `v//vn` or `v/vt/vn`.
  std::optional<std::array<uint32_t, 3>> read_corner(std::string_view word, const Words& words) {
    std::string_view left = word;
    const auto index = take_index(left);
    std::array<uint32_t, 3> corner{kNone, kNone, kNone};
    const bool well_formed = index && (left.empty() || left[0] == '/');
    if (!well_formed) {
      fail(words,
           fmt::format("`{}` is not a corner of a face, such as 7, 7/1, 7//3 or 7/1/3", word.substr(0, 40)));
      return std::nullopt;
    }
    corner[0] = element(*index, before_.v + v_, all_.v);
    if (corner[0] == kNone) {
      fail(words, out_of_range(*index));
      return std::nullopt;
    }
    for (size_t k = 1; k < 3 && !left.empty() && left[0] == '/'; ++k) {
      left.remove_prefix(1);
      const auto other = take_index(left);
      if (!other) continue;
      corner[k] =
          k == 1 ? element(*other, before_.vt + vt_, all_.vt) : element(*other, before_.vn + vn_, all_.vn);
      if (corner[k] == kNone)
        warn(words, k == 1 ? "an index of texture coordinates is out of range: the corner has none"
                           : "an index of normals is out of range: the corner has the normal of its face");
    }
    return corner;
  }

  std::string out_of_range(int64_t index) const {
    const uint64_t so_far = before_.v + v_;
    if (all_.v == 0) return fmt::format("vertex index {} is out of range: the file has no vertices", index);
    const std::string back = so_far == 0 ? "" : fmt::format(", or -1 to -{} on this line", so_far);
    return fmt::format("vertex index {} is out of range: expected 1 to {}{}", index, all_.v, back);
  }

  void change(StateChange::Kind kind, Words& words) {
    Words ahead = words;
    ahead.next();
    part_.changes.push_back({kind, std::string(words.rest()), part_.sizes.size(), at(ahead)});
  }

  void leave_out(std::string_view keyword, const Words& words) {
    const bool readable = keyword.size() <= 40 && std::all_of(keyword.begin(), keyword.end(),
                                                              [](char c) { return c > ' ' && c < 127; });
    if (keyword == "l" || keyword == "p")
      return warn(words, fmt::format("{} `{}` are left out", keyword == "l" ? "lines" : "points", keyword));
    if (!readable || other_keywords_ > 20)
      return warn(words, "a line that begins with no keyword is left out");
    const std::string cause = fmt::format("a line `{}` is left out", keyword);
    if (part_.warnings.knows(cause)) return warn(words, cause);
    ++other_keywords_;
    warn(words, cause);
  }

  std::string_view text_;
  const Counts &before_, &all_;
  ObjText& out_;
  ObjPart& part_;
  SourceLocation where_;
  uint64_t v_ = 0, vt_ = 0, vn_ = 0;  // read so far in this part
  std::vector<std::array<uint32_t, 3>> face_;
  size_t other_keywords_ = 0;
  ReadError error_;
};

// The counts of all parts before each part, then those of all parts.
std::vector<Counts> counts_before(const std::vector<std::string_view>& texts) {
  std::vector<Counts> counts(texts.size() + 1);
  parallel::for_index(size_t{0}, texts.size(), [&](size_t i) { counts[i + 1] = count_lines(texts[i]); });
  for (size_t i = 0; i < texts.size(); ++i) {
    counts[i + 1].lines += counts[i].lines;
    counts[i + 1].v += counts[i].v;
    counts[i + 1].vt += counts[i].vt;
    counts[i + 1].vn += counts[i].vn;
  }
  return counts;
}

void collect_colours(const std::vector<Counts>& before, ObjText& text) {
  for (size_t i = 0; i < text.parts.size(); ++i) {
    std::vector<glm::vec3>& of_part = text.parts[i].colours;
    if (of_part.empty()) continue;
    text.colours.resize(text.P.size(), glm::vec3(1));
    std::copy(of_part.begin(), of_part.end(), text.colours.begin() + std::ptrdiff_t(before[i].v));
    of_part = {};
  }
}

void report(const std::vector<ReadError>& errors, DiagnosticList& diagnostics) {
  const ReadError* first = nullptr;
  uint64_t count = 0;
  for (const ReadError& error : errors) {
    count += error.count;
    if (!first && error.count > 0) first = &error;
  }
  if (first)
    diagnostics.error(
        first->where,
        count == 1 ? first->message : fmt::format("{}; {} more errors follow", first->message, count - 1));
}

}  // namespace

void Corners::add(const std::array<uint32_t, 3>& corner) {
  const auto append = [&](std::vector<uint32_t>& to, uint32_t index) {
    if (to.empty() && index == kNone) return;
    to.resize(v.size(), kNone);
    to.push_back(index);
  };
  append(vt, corner[1]);
  append(vn, corner[2]);
  v.push_back(corner[0]);
}

void Corners::set_vn(size_t i, uint32_t normal) {
  if (vn.empty()) vn.resize(v.size(), kNone);
  vn[i] = normal;
}

void Corners::drop_triangle() {
  const size_t left = v.size() - 3;
  for (std::vector<uint32_t>* indices : {&v, &vt, &vn}) indices->resize(std::min(indices->size(), left));
}

std::optional<ObjText> read_obj(std::string_view text, uint32_t file, DiagnosticList& diagnostics) {
  const std::vector<std::string_view> texts = split(text);
  const std::vector<Counts> before = counts_before(texts);
  const Counts all = texts.empty() ? Counts() : before.back();
  if (std::max({all.v, all.vt, all.vn, all.lines}) >= kNone) {
    diagnostics.error({file, 0, 0},
                      "there are more than 4294967294 lines or vertices in this file, the limit");
    return std::nullopt;
  }
  ObjText out;
  out.P.resize(all.v);
  out.uv.resize(all.vt);
  out.N.resize(all.vn);
  out.parts.resize(texts.size());
  std::vector<ReadError> errors(texts.size());
  parallel::for_index(size_t{0}, texts.size(), [&](size_t i) {
    errors[i] = PartReader(texts[i], file, before[i], all, out, out.parts[i]).read();
  });
  collect_colours(before, out);
  report(errors, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  return out;
}

}  // namespace kaustik::obj
