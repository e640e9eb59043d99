#include "apps/sequence/camera_path.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>
#include <ostream>

#include "apps/console/exit_error.h"
#include "apps/import/gltf/file/json_view.h"
#include "core/diagnostics/diagnostics.h"
#include "core/diagnostics/nearest_name.h"
#include "core/files/input_file.h"

namespace kaustik::app {

namespace {

using View = gltf::View;  // checked access to JSON

constexpr uint64_t kLargestPath = 1 << 28;  // bytes

std::string read_text(const std::string& file) {
  try {
    return read_file(file, kLargestPath);
  } catch (const FileError& error) {
    refuse(fmt::format("cannot read the camera path {}: {}", file, error.what()));
  }
}

// Line and column of a byte, counted from 1.
LineColumn place_of(std::string_view text, size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  const size_t line = size_t(std::ranges::count(before, '\n'));
  const size_t start = before.rfind('\n') == before.npos ? 0 : before.rfind('\n') + 1;
  return {uint32_t(line + 1), uint32_t(before.size() - start + 1)};
}

nlohmann::json parse(const std::string& file, const std::string& text, std::ostream& err) {
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    Diagnostics diagnostics;
    const uint32_t source = diagnostics.files.add(file, text);
    const LineColumn place = place_of(text, error.byte > 0 ? error.byte - 1 : 0);
    diagnostics.error({source, place.line, place.column},
                      "this is not JSON: expected an object with `keys` or `turntable`");
    err << diagnostics.format_all();
    refuse(fmt::format("{}: 1 error", file));
  } catch (const nlohmann::json::out_of_range&) {
    refuse(fmt::format("{}: it holds a number beyond the range of doubles", file));
  }
}

void check_names(const View& object, const std::vector<std::string_view>& known) {
  for (const std::string& name : object.names())
    if (std::ranges::find(known, name) == known.end())
      object.fail(fmt::format("has an unknown member `{}`{}", name, name_hint(name, known)));
}

uint64_t frame_count(const View& number) {
  const uint64_t frames = number.count();
  if (frames < 1 || frames > kMostFrames) number.fail(fmt::format("must be 1 to {}", kMostFrames));
  return frames;
}

}  // namespace

class PathReader {
 public:
  static CameraPath read(const View& root) {
    CameraPath path;
    check_names(root, {"keys", "interpolation", "turntable"});
    if (root.has("keys") == root.has("turntable"))
      throw gltf::FormatError("expected either `keys` or `turntable`");
    if (root.has("turntable"))
      read_turntable(root["turntable"], &path);
    else
      read_keys(root, &path);
    return path;
  }

 private:
  static void read_turntable(const View& json, CameraPath* path) {
    check_names(json, {"frames", "center", "axis", "degrees"});
    const auto vector = [&](const char* name, const glm::dvec3& otherwise) {
      const std::vector<double> v = json[name].numbers(3, {otherwise.x, otherwise.y, otherwise.z});
      return glm::dvec3(v[0], v[1], v[2]);
    };
    path->frames_ = frame_count(json["frames"]);
    path->turntable_ = {vector("center", {0, 0, 0}), vector("axis", {0, 1, 0}), json["degrees"].number(360)};
    if (!(glm::length(path->turntable_.axis) > 0)) json["axis"].fail("must not be zero");
  }

  static void read_keys(const View& root, CameraPath* path) {
    const std::string interpolation = root["interpolation"].text("smooth");
    if (interpolation != "smooth" && interpolation != "linear")
      root["interpolation"].fail("must be \"smooth\" or \"linear\"");
    path->smooth_ = interpolation == "smooth";
    const View keys = root["keys"];
    if (keys.size() == 0) keys.fail("must have at least one key");
    path->has_fov_ = keys.at(0).has("fov");
    for (uint64_t i = 0; i < keys.size(); ++i) read_key(keys.at(i), path);
    path->frames_ = uint64_t(path->keys_.back().frame) + 1;
  }

  static void read_key(const View& json, CameraPath* path) {
    check_names(json, {"frame", "eye", "target", "up", "fov"});
    CameraPath::Key key{double(json["frame"].count())};
    if (!(key.frame < double(kMostFrames))) json["frame"].fail(fmt::format("must be below {}", kMostFrames));
    if (!path->keys_.empty() && !(key.frame > path->keys_.back().frame))
      json["frame"].fail("must be greater than that of the key before");
    size_t at = 0;
    for (const char* name : {"eye", "target", "up"}) {
      if (at < 6 && !json.has(name)) json.fail(fmt::format("must have `{}`, three numbers", name));
      for (const double v : json[name].numbers(3, {0, 1, 0})) key.numbers[at++] = v;
    }
    if (json.has("fov") != path->has_fov_) json.fail("must have `fov` as the other keys do, or none may");
    key.numbers[at] = json["fov"].number(0);
    if (path->has_fov_ && !(key.numbers[at] > 0 && key.numbers[at] < 180))
      json["fov"].fail("must be between 0 and 180 degrees");
    path->keys_.push_back(key);
  }
};

CameraPath CameraPath::read(const std::string& file, std::ostream& err) {
  const nlohmann::json json = parse(file, read_text(file), err);
  if (!json.is_object()) refuse(fmt::format("{}: expected an object with `keys` or `turntable`", file));
  try {
    return PathReader::read(View(json, ""));
  } catch (const gltf::FormatError& error) {
    refuse(fmt::format("{}: {}", file, error.what()));
  }
}

// Cubic Hermite curves through the keys, whose tangents are those of the chord between their neighbours.
std::array<double, CameraPath::kNumbers> CameraPath::between(double frame) const {
  if (frame <= keys_.front().frame) return keys_.front().numbers;
  const auto after = std::ranges::find_if(keys_, [&](const Key& key) { return key.frame >= frame; });
  const size_t j = size_t(after - keys_.begin()), i = j - 1;
  const Key &a = keys_[i], &b = keys_[j];
  if (b.frame == frame) return b.numbers;
  const double span = b.frame - a.frame, t = (frame - a.frame) / span;
  const auto slope = [&](size_t key, size_t k) {
    const Key &from = keys_[key == 0 ? 0 : key - 1], &to = keys_[std::min(key + 1, keys_.size() - 1)];
    return (to.numbers[k] - from.numbers[k]) / (to.frame - from.frame);
  };
  std::array<double, kNumbers> out{};
  for (size_t k = 0; k < kNumbers; ++k) {
    const double p = a.numbers[k], q = b.numbers[k];
    out[k] = p + (q - p) * t;
    if (!smooth_) continue;
    const double m = slope(i, k) * span, n = slope(j, k) * span;
    out[k] = p + (q - p) * (3 - 2 * t) * t * t + m * t * (1 - t) * (1 - t) - n * t * t * (1 - t);
  }
  return out;
}

FrameView CameraPath::at(uint64_t frame, const std::optional<CameraDescription>& camera) const {
  FrameView view;
  std::array<double, kNumbers> numbers{};
  if (!keys_.empty()) {
    numbers = between(double(frame));
  } else {
    const glm::dmat4 m = camera ? camera->camera_to_world : glm::dmat4(1);
    const glm::dvec3 eye(m[3]), ahead = glm::normalize(glm::dvec3(m[2])), up(m[1]);
    const double angle = glm::radians(turntable_.degrees) * double(frame) / double(frames_);
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1), angle, turntable_.axis));
    const glm::dvec3 from_center = eye - turntable_.center, e = turntable_.center + turn * from_center;
    const double distance = glm::length(from_center);
    const glm::dvec3 t = e + turn * ahead * (distance > 0 ? distance : 1), u = turn * up;
    numbers = {e.x, e.y, e.z, t.x, t.y, t.z, u.x, u.y, u.z, 0};
  }
  for (size_t k = 0; k < view.look_at.size(); ++k) view.look_at[k] = double(float(numbers[k]));
  // A curve may run beyond its keys.
  if (has_fov_) view.fov = double(float(std::clamp(numbers[kNumbers - 1], 0.01, 179.9)));
  return view;
}

std::vector<std::string> FrameView::look_at_texts() const {
  std::vector<std::string> texts;
  for (const double v : look_at) texts.push_back(fmt::format("{}", float(v)));
  return texts;
}

std::vector<std::string> FrameView::fov_texts() const {
  return fov ? std::vector{fmt::format("{}", float(*fov))} : std::vector<std::string>{};
}

std::string FrameView::options() const {
  return fmt::format("--look-at {}{}{}", fmt::join(look_at_texts(), " "), fov ? " --fov " : "",
                     fmt::join(fov_texts(), ""));
}

}  // namespace kaustik::app
