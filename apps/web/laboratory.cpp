#include "apps/web/laboratory.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include "apps/settings/table/table.h"
#include "apps/web/map_data.h"
#include "apps/web/request_check.h"
#include "render/maps/probe.h"
#include "render/passes/pass_trials.h"
#include "render/passes/passes.h"
#include "render/plan/pass_share.h"

namespace kaustik::app {

namespace {

using Json = nlohmann::ordered_json;

// The settings that the page offers, in this order.
constexpr std::string_view kOffered[] = {"photons",     "radius", "nearest",  "kernel",   "cone-k",
                                         "method",      "direct", "caustics", "indirect", "node-photons",
                                         "min-photons", "spp",    "seed"};

bool is_offered(const std::string& name) {
  return std::find(std::begin(kOffered), std::end(kOffered), name) != std::end(kOffered);
}

// Forgets an estimator that was chosen, so that the method chooses it. Nothing for other settings.
void leave_to_method(const std::string& name, render::RenderSettings* settings) {
  if (name == "direct") settings->direct.reset();
  if (name == "caustics") settings->caustics.reset();
  if (name == "indirect") settings->indirect.reset();
}

std::string text_of(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

uint64_t most_of(const HttpRequest& request, uint64_t usual, uint64_t limit) {
  const uint64_t most = std::strtoull(request.value("most").c_str(), nullptr, 10);
  return std::min(most > 0 ? most : usual, limit);
}

HttpResponse bytes(std::string body) {
  return {200, "application/octet-stream", std::move(body)};
}

}  // namespace

void Laboratory::use(const Settings& settings) {
  const std::lock_guard lock(settings_mutex_);
  settings_ = settings;
  made_.reset();
}

Settings Laboratory::settings() const {
  const std::lock_guard lock(settings_mutex_);
  return settings_;
}

PageExtension Laboratory::extension(RenderAgain render_again) {
  return {[this, render_again = std::move(render_again)](const HttpRequest& request) {
            return answer(request, render_again);
          },
          [this] { return describe(); }};
}

std::shared_ptr<const Laboratory::Maps> Laboratory::maps() {
  const std::lock_guard shooting(shooting_);
  Settings now;
  {
    const std::lock_guard lock(settings_mutex_);
    if (made_) return made_;
    now = settings_;
  }
  auto made = std::make_shared<Maps>();
  made->settings = now.render;
  tbb::task_arena arena(now.render.threads > 0 ? now.render.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    made->plan = render::make_plan(made->settings, scene_.needs);
    const uint64_t shares = render::choose_passes(scene_, bvh_, made->settings, &made->plan);
    const render::RenderInput input{scene_, bvh_, made->settings, made->plan};
    if (render::kinds_needed(made->plan).any())
      made->first.photons.make(input,
                               render::pass_share(0, shares, made->settings.photons, made->settings.spp), {},
                               &made->first.statistics);
  });
  const std::lock_guard lock(settings_mutex_);
  made_ = made;
  return made;
}

std::optional<HttpResponse> Laboratory::answer(const HttpRequest& request, const RenderAgain& render_again) {
  if (request.method == "POST")
    return request.path == "/render" ? std::optional(render_with(request.body, render_again)) : std::nullopt;
  if (request.path == "/photons")
    return bytes(cloud_bytes(maps()->first.photons.maps(), most_of(request, 200'000, 5'000'000)));
  if (request.path == "/cells")
    return bytes(cell_bytes(maps()->first.photons.maps(), most_of(request, 20'000, 500'000)));
  if (request.path != "/estimate") return std::nullopt;
  const int x = std::atoi(request.value("x", "-1").c_str()), y = std::atoi(request.value("y", "-1").c_str());
  if (x < 0 || y < 0 || x >= scene_.camera.width || y >= scene_.camera.height)
    return error_response(400, "x and y: expected a pixel of the picture");
  const auto made = maps();
  const render::RenderInput input{scene_, bvh_, made->settings, made->plan};
  const render::Probe probe = render::probe_pixel(input, made->first.photons.maps(), x, y);
  return HttpResponse{200, "application/json", probe_json(probe, scene_)};
}

HttpResponse Laboratory::render_with(const std::string& body, const RenderAgain& render_again) const {
  const Json wanted = Json::parse(body, nullptr, false);
  if (!wanted.is_object()) return error_response(400, "expected a JSON object of settings");
  Settings settings = this->settings();
  SettingOverrides overrides;
  try {
    for (const auto& [name, value] : wanted.items()) {
      if (!is_offered(name)) return error_response(400, fmt::format("there is no setting {} here", name));
      if (const std::string text = text_of(value); !text.empty())
        overrides.add(*find_setting(name), {text});
      else
        leave_to_method(name, &settings.render);
    }
  } catch (const std::exception& error) {
    return error_response(400, error.what());
  }
  overrides.apply(settings);
  if (settings.render.passes > settings.render.photons)
    return error_response(400, "there are fewer photons than passes");
  render_again(overrides, settings);
  return {202, "application/json", "{}"};
}

Json Laboratory::describe() const {
  const Settings now = settings();
  Json offered = Json::array();
  for (const std::string_view name : kOffered) {
    const Setting& setting = *find_setting(name);
    const std::vector<std::string> texts = setting.show(now);
    offered.push_back({{"name", name},
                       {"value", texts.empty() ? std::string() : texts.front()},
                       {"default", setting.default_text},
                       {"choices", setting.choices},
                       {"range", setting.range},
                       {"unit", setting.unit},
                       {"doc", setting.doc}});
  }
  return {{"settings", std::move(offered)}};
}

}  // namespace kaustik::app
