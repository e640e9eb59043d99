#include "apps/bench/bench_json.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "apps/bench/span.h"
#include "render/passes/json_numbers.h"

namespace kaustik::app {

namespace {

constexpr int kMostLevels = 64;  // of a JSON text: our files have six
constexpr int kFormat = 1;       // incremented when readers of the old format would misread the new one

// Brackets within strings do not count.
bool nests_deeply(std::string_view text) {
  int level = 0;
  bool in_string = false;
  for (size_t i = 0; i < text.size() && level <= kMostLevels; ++i) {
    const char c = text[i];
    if (in_string && c == '\\') {
      ++i;
    } else if (c == '"') {
      in_string = !in_string;
    } else if (!in_string) {
      level += c == '[' || c == '{' ? 1 : 0;
      level -= c == ']' || c == '}' ? 1 : 0;
    }
  }
  return level > kMostLevels;
}

template <size_t N>
Json spreads_json(const std::array<Spread, N>& spreads, const std::array<std::string_view, N>& names) {
  Json out;
  for (size_t i = 0; i < N; ++i) out[std::string(names[i])] = spread_json(spreads[i]);
  return out;
}

template <class Value>
Json by_phase(Value&& value) {
  Json out;
  for (size_t i = 0; i < kPhases; ++i) {
    const std::optional<double> v = value(static_cast<Phase>(i));
    out[std::string(kPhaseNames[i])] = v ? Json(*v) : Json(nullptr);
  }
  return out;
}

Json point_json(const BenchResult& result, const BenchPoint& point) {
  Json out;
  out["photons"] = point.photons;
  out["threads"] = point.threads;
  if (point.photons_per_thread > 0) out["photons_per_thread"] = point.photons_per_thread;
  out["seconds"] = spreads_json(point.seconds, kPhaseNames);
  out["per_second"] = spreads_json(point.per_second, kRateNames);
  out["busy_cores"] = spread_json(point.busy_cores);
  out["waiting"] = point.waiting ? spread_json(*point.waiting) : Json(nullptr);
  out["joules"] = point.joules ? spread_json(*point.joules) : Json(nullptr);
  out["peak_memory_bytes"] = spread_json(point.peak_memory_bytes);
  out["speed_up"] = by_phase([&](Phase phase) -> std::optional<double> {
    const std::optional<Spread> gain = speed_up(result, point, phase);
    return gain ? std::optional(gain->median) : std::nullopt;
  });
  out["efficiency"] = by_phase([&](Phase phase) { return efficiency(result, point, phase); });
  out["counters"] = point.counters;
  return out;
}

Json span_json(const SpanPoint& point) {
  Json phases = Json::object();
  for (const auto& [name, phase] : point.phases) {
    Json places = Json::object();
    for (const auto& [where, place] : phase.places)
      places[where] = {
          {"serial", place.serial}, {"work", place.work}, {"span", place.span}, {"tasks", place.tasks}};
    Json speed_up = Json::object();
    for (const int cores : kSpanCores) speed_up[std::to_string(cores)] = phase.speed_up(cores);
    phases[name] = {{"seconds", phase.seconds},
                    {"serial", phase.serial()},
                    {"span", phase.span()},
                    {"speed_up", std::move(speed_up)},
                    {"places", std::move(places)}};
  }
  return {{"photons", point.photons}, {"phases", std::move(phases)}};
}

[[noreturn]] void refuse(std::string_view key, std::string_view expected) {
  throw std::runtime_error(fmt::format("\"{}\": expected {}", key, expected));
}

const Json& field(const Json& object, std::string_view key) {
  const auto found = object.is_object() ? object.find(std::string(key)) : object.end();
  if (found == object.end()) throw std::runtime_error(fmt::format("\"{}\" is missing", key));
  return *found;
}

uint64_t whole(const Json& object, std::string_view key, uint64_t least, uint64_t most) {
  return render::whole_number(field(object, key), key, least, most);
}

std::string text_of(const Json& object, std::string_view key) {
  const Json& value = field(object, key);
  if (!value.is_string()) refuse(key, "a string");
  return value.get<std::string>();
}

const Json& object_of(const Json& object, std::string_view key) {
  const Json& value = field(object, key);
  if (!value.is_object()) refuse(key, "an object");
  return value;
}

double measure_of(const Json& object, std::string_view key) {
  const Json& value = field(object, key);
  if (!value.is_number() || !(value.get<double>() >= 0) || !std::isfinite(value.get<double>()))
    refuse(key, "a finite number, 0 or more");
  return value.get<double>();
}

template <size_t N>
std::array<Spread, N> read_spreads(const Json& object, const std::array<std::string_view, N>& names) {
  std::array<Spread, N> out;
  for (size_t i = 0; i < N; ++i) out[i] = read_spread(object, names[i]);
  return out;
}

BenchPoint read_point(const Json& in) {
  BenchPoint point;
  point.photons = whole(in, "photons", 1, std::numeric_limits<uint64_t>::max());
  point.threads = static_cast<int>(whole(in, "threads", 1, 65535));
  point.seconds = read_spreads(object_of(in, "seconds"), kPhaseNames);
  point.per_second = read_spreads(object_of(in, "per_second"), kRateNames);
  point.busy_cores = read_spread(in, "busy_cores");
  point.peak_memory_bytes = read_spread(in, "peak_memory_bytes");
  if (in.contains("photons_per_thread"))
    point.photons_per_thread = whole(in, "photons_per_thread", 1, point.photons);
  // Older results do not have them.
  const auto read_if_known = [&](std::string_view key) -> std::optional<Spread> {
    if (!in.contains(key) || in[std::string(key)].is_null()) return std::nullopt;
    return read_spread(in, key);
  };
  point.waiting = read_if_known("waiting");
  point.joules = read_if_known("joules");
  point.counters = object_of(in, "counters");
  return point;
}

SpanPoint read_span(const Json& in) {
  constexpr uint64_t kMost = std::numeric_limits<uint64_t>::max();
  SpanPoint point{whole(in, "photons", 1, kMost), {}};
  for (const auto& [name, phase] : object_of(in, "phases").items()) {
    PhaseSpan& to = point.phases[name];
    to.seconds = measure_of(phase, "seconds");
    for (const auto& [where, place] : object_of(phase, "places").items())
      to.places[where] = {measure_of(place, "serial"), measure_of(place, "work"), measure_of(place, "span"),
                          whole(place, "tasks", 0, kMost)};
  }
  return point;
}

}  // namespace

std::string utf8(const std::string& text) {
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

Json spread_json(const Spread& s) {
  return {{"median", s.median}, {"min", s.min}, {"max", s.max}};
}

Spread read_spread(const Json& object, std::string_view key) {
  const Json& in = field(object, key);
  const Spread s{measure_of(in, "median"), measure_of(in, "min"), measure_of(in, "max")};
  if (!(s.min <= s.median && s.median <= s.max)) refuse(key, "min <= median <= max");
  return s;
}

std::string bench_json(const BenchResult& result) {
  Json out;
  out["kaustik_bench"] = kFormat;
  out["version"] = result.version;
  out["build"] = result.build;
  out["scene"] = result.scene;
  out["machine"] = result.machine;
  out["settings"] = result.settings;
  out["repeat"] = result.repeat;
  out["disturbed"] = is_disturbed(result);
  out["points"] = Json::array();
  for (const BenchPoint& point : result.points) out["points"].push_back(point_json(result, point));
  for (const SpanPoint& span : result.spans) out["spans"].push_back(span_json(span));
  return out.dump(2) + "\n";
}

Json parse_json(const std::string& text) {
  if (nests_deeply(text))
    throw std::runtime_error(fmt::format("it is nested deeper than {} levels", kMostLevels));
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) throw std::runtime_error("it is not valid JSON");
  return json;
}

BenchResult bench_from_json(const std::string& text) {
  const Json in = parse_json(text);
  whole(in, "kaustik_bench", kFormat, kFormat);
  BenchResult result;
  result.version = text_of(in, "version");
  result.build = text_of(in, "build");
  result.scene = text_of(in, "scene");
  result.machine = object_of(in, "machine");
  result.settings = object_of(in, "settings");
  result.repeat = whole(in, "repeat", 1, std::numeric_limits<uint64_t>::max());
  const Json& points = field(in, "points");
  if (!points.is_array() || points.empty()) refuse("points", "an array of at least one point");
  for (const Json& point : points) result.points.push_back(read_point(point));
  if (const auto spans = in.find("spans"); spans != in.end())
    for (const Json& span : *spans) result.spans.push_back(read_span(span));
  return result;
}

}  // namespace kaustik::app
