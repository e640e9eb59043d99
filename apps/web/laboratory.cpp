#include "apps/web/laboratory.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "apps/settings/table/table.h"
#include "apps/web/map_data.h"
#include "apps/web/request_check.h"
#include "core/memory/memory_pages.h"
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

// Sets the default. That of the estimators is unset: the method chooses them.
void reset(const std::string& name, Settings* settings, SettingOverrides* overrides) {
  if (name == "direct") settings->render.direct.reset();
  if (name == "caustics") settings->render.caustics.reset();
  if (name == "indirect") settings->render.indirect.reset();
  const Setting& setting = *find_setting(name);
  if (std::vector<std::string> texts = setting.show(Settings{}); !texts.empty())
    overrides->add(setting, std::move(texts));
}

std::string text_of(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

uint64_t most_of(const HttpRequest& request, uint64_t usual, uint64_t limit) {
  return std::min(request.number("most").value_or(usual), limit);
}

HttpResponse bytes(std::string body) {
  return {200, "application/octet-stream", std::move(body)};
}

}  // namespace

void Laboratory::begin() {
  {
    const std::lock_guard lock(settings_mutex_);
    settled_.reset();
    made_.reset();
    ++turn_;
  }
  // The C library keeps a heap for each of the threads that answer, and in each what one photon map took.
  give_back_freed();
}

void Laboratory::settle(const Settings& settled) {
  const std::lock_guard lock(settings_mutex_);
  settled_ = settled;
  changed_.notify_all();
}

void Laboratory::end() {
  const std::lock_guard lock(settings_mutex_);
  ended_ = true;
  ++turn_;
  changed_.notify_all();
}

PageExtension Laboratory::extension(RenderAgain render_again) {
  return {[this, render_again = std::move(render_again)](const HttpRequest& request) {
            return answer(request, render_again);
          },
          [this] { return describe(); }};
}

std::shared_ptr<const Laboratory::Maps> Laboratory::shoot(const Settings& settings, uint64_t turn) const {
  auto made = std::make_shared<Maps>();
  made->settings = settings.render;
  const auto go_on = [&](const render::Progress&) { return turn_ == turn; };
  bool complete = true;
  tbb::task_arena arena(made->settings.threads > 0 ? made->settings.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    made->plan = render::make_plan(made->settings, scene_.needs);
    const uint64_t shares = render::choose_passes(scene_, bvh_, made->settings, &made->plan);
    const render::RenderInput input{scene_, bvh_, made->settings, made->plan};
    if (render::kinds_needed(made->plan).any())
      complete = made->first.photons.make(
          input, render::pass_share(0, shares, made->settings.photons, made->settings.spp), go_on,
          &made->first.statistics);
  });
  return complete ? made : nullptr;
}

std::shared_ptr<const Laboratory::Maps> Laboratory::maps() {
  const std::lock_guard shooting(shooting_);
  while (true) {
    std::unique_lock lock(settings_mutex_);
    changed_.wait(lock, [&] { return settled_ || ended_; });
    if (ended_) throw std::runtime_error("the program ends");
    if (made_) return made_;
    const Settings settings = *settled_;
    const uint64_t turn = turn_;
    lock.unlock();
    std::shared_ptr<const Maps> made = shoot(settings, turn);
    lock.lock();
    if (!made || turn_ != turn) continue;
    made_ = made;
    return made;
  }
}

std::optional<HttpResponse> Laboratory::answer(const HttpRequest& request, const RenderAgain& render_again) {
  if (request.method == "POST")
    return request.path == "/render" ? std::optional(render_with(request.body, render_again)) : std::nullopt;
  if (request.path == "/photons")
    return bytes(cloud_bytes(maps()->first.photons.maps(), most_of(request, 200'000, 5'000'000)));
  if (request.path == "/cells")
    return bytes(cell_bytes(maps()->first.photons.maps(), most_of(request, 20'000, 500'000)));
  return request.path == "/estimate" ? std::optional(estimate(request)) : std::nullopt;
}

HttpResponse Laboratory::estimate(const HttpRequest& request) {
  const std::optional<uint64_t> x = request.number("x"), y = request.number("y");
  if (!x || !y || *x >= uint64_t(scene_.camera.width) || *y >= uint64_t(scene_.camera.height))
    return error_response(400, "x and y: expected a pixel of the picture");
  const auto made = maps();
  const render::RenderInput input{scene_, bvh_, made->settings, made->plan};
  const render::Probe probe = render::probe_pixel(input, made->first.photons.maps(), int(*x), int(*y));
  return {200, "application/json", probe_json(probe, scene_)};
}

void Laboratory::check(const Settings& settings) const {
  if (settings.render.passes > settings.render.photons)
    throw std::invalid_argument("there are fewer photons than passes");
  render::EstimatorPlan plan = render::make_plan(settings.render, scene_.needs);
  render::choose_passes(scene_, bvh_, settings.render, &plan);
}

HttpResponse Laboratory::render_with(const std::string& body, const RenderAgain& render_again) {
  const Json wanted = Json::parse(body, nullptr, false);
  if (!wanted.is_object()) return error_response(400, "expected a JSON object of settings");
  const std::lock_guard lock(settings_mutex_);
  Settings settings = asked_;
  SettingOverrides overrides;
  try {
    for (const auto& [name, value] : wanted.items()) {
      if (!is_offered(name)) return error_response(400, fmt::format("there is no setting {} here", name));
      if (const std::string text = text_of(value); !text.empty())
        overrides.add(*find_setting(name), {text});
      else
        reset(name, &settings, &overrides);
    }
    overrides.apply(settings);
    check(settings);
  } catch (const std::exception& error) {
    return error_response(400, error.what());
  }
  asked_ = settings;
  render_again(overrides, settings);
  return {202, "application/json", "{}"};
}

Json Laboratory::describe() const {
  Settings now;
  {
    const std::lock_guard lock(settings_mutex_);
    now = settled_.value_or(asked_);
  }
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
