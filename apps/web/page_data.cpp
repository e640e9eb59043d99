#include "apps/web/page_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>

#include "apps/web/json_text.h"
#include "core/version.h"
#include "render/film/media_sums.h"

namespace kaustik::app {

namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "the page reads numbers as they lie in memory");

std::string_view unit_of(render::LayerUnit unit) {
  switch (unit) {
    case render::LayerUnit::kRadiance:
      return "W/(m^2 sr)";
    case render::LayerUnit::kDepth:
      return "m";
    default:
      return "";
  }
}

// The layers that the page offers: those for denoisers alone are left out, and those of media, which live
// pictures do not hold.
Json layers_json() {
  Json out = Json::array();
  out.push_back({{"name", ""}, {"label", "all light"}, {"channels", 3}, {"unit", "W/(m^2 sr)"}});
  for (const render::LayerRow& row : render::kLayerTable)
    if (!row.name.starts_with("denoising") && !is_of_media(row))
      out.push_back({{"name", row.name},
                     {"label", row.name},
                     {"channels", row.channels.size()},
                     {"unit", unit_of(row.unit)}});
  return out;
}

std::string_view name_of(LiveState state) {
  switch (state) {
    case LiveState::kPaused:
      return "paused";
    case LiveState::kFinished:
      return "finished";
    case LiveState::kRunning:
      break;
  }
  return "running";
}

void append(uint32_t value, std::string* out) {
  char bytes[sizeof(value)];
  std::memcpy(bytes, &value, sizeof(value));
  out->append(bytes, sizeof(value));
}

}  // namespace

std::string info_json(const LiveRender& live, const ToneChoice& tone, const Json& more) {
  const render::PixelRange& range = live.picture.range();
  Json out = {{"title", live.title()},
              {"program", fmt::format("kaustik {}", version())},
              {"full_width", live.picture.full_width()},
              {"full_height", live.picture.full_height()},
              {"x0", range.x0},
              {"y0", range.y0},
              {"x1", range.x1},
              {"y1", range.y1},
              {"layers", layers_json()},
              {"exposure", tone.exposure ? Json(*tone.exposure) : Json(nullptr)},
              {"tonemap", render::name_of(tone.tonemap)}};
  out.update(more);
  return json_text(out);
}

std::string status_event(const LiveRender& live, uint64_t number, uint64_t version) {
  const LiveStatus status = live.status();
  Json errors = Json::array();
  for (const ErrorPoint& e : status.errors) errors.push_back({e.seconds, e.passes, e.error});
  const Json out = {{"render", number},
                    {"state", name_of(status.state)},
                    {"phase", status.phase},
                    {"pass", status.pass + 1},
                    {"passes", status.passes},
                    {"fraction", status.fraction},
                    {"seconds_left", status.seconds_left ? Json(*status.seconds_left) : Json(nullptr)},
                    {"seconds", status.seconds},
                    {"stopped", status.stopped},
                    {"trouble", status.trouble},
                    {"version", version},
                    {"errors", std::move(errors)}};
  return fmt::format("event: status\ndata: {}\n\n", json_text(out));
}

std::optional<std::string> pixels_since(const LiveRender& live, uint64_t number, const std::string& layer,
                                        uint64_t version) {
  const auto& names = render::kLayerNames;
  if (!layer.empty() && std::find(names.begin(), names.end(), layer) == names.end()) return std::nullopt;
  std::vector<LiveChannel> channels =
      live_channels(layer.empty() ? std::vector<std::string>{} : std::vector{layer});
  if (!layer.empty()) channels.erase(channels.begin(), channels.begin() + 3);  // all light
  const LivePicture::Changes changes = live.picture.changed_since(version);
  std::string out;
  append(uint32_t(changes.version), &out);
  append(uint32_t(changes.version >> 32), &out);
  append(uint32_t(number), &out);
  append(uint32_t(changes.tiles.size()), &out);
  std::vector<float> values;
  for (const render::PixelRange& tile : changes.tiles) {
    for (const int number_of : {tile.x0, tile.y0, tile.width(), tile.height()})
      append(uint32_t(number_of), &out);
    values.resize(tile.pixels() * channels.size());
    live.picture.read(tile, channels, values.data());
    out.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  }
  return out;
}

}  // namespace kaustik::app
