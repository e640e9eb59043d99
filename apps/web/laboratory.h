#pragma once
// The photon maps of a render, for the live page: what an estimate read, the cloud of all photons, the cells
// of the octree, and settings to render with again.

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "accel/bvh.h"
#include "apps/settings/setting_options.h"
#include "apps/web/http_server.h"
#include "apps/web/page_server.h"
#include "core/scene/scene.h"
#include "render/maps/pass_photons.h"

namespace kaustik::app {

// Thread-safe. scene and bvh must outlive it.
class Laboratory {
 public:
  // asked: the settings of the first render. Readers change them for the next one.
  Laboratory(const Scene& scene, const accel::Bvh& bvh, Settings asked)
      : scene_(scene), bvh_(bvh), asked_(std::move(asked)) {}

  // A render begins, whose photons are not known yet: those who ask for them wait.
  void begin();
  // What the render has made of the settings that were asked for: from now on the photons are those of
  // `settled`. They are shot when someone first asks for them.
  void settle(const Settings& settled);
  // Ends what is being shot, so that nobody waits for it any more.
  void end();

  // Called with the settings that a reader gives, and with all settings of the next render.
  using RenderAgain = std::function<void(const SettingOverrides& given, const Settings&)>;
  PageExtension extension(RenderAgain render_again);

 private:
  struct Maps {
    render::RenderSettings settings;
    render::EstimatorPlan plan;
    render::FirstPhotons first;
  };

  std::optional<HttpResponse> answer(const HttpRequest& request, const RenderAgain& render_again);
  HttpResponse estimate(const HttpRequest& request);
  HttpResponse render_with(const std::string& body, const RenderAgain& render_again);
  // Throws std::invalid_argument where these settings cannot be rendered.
  void check(const Settings& settings) const;
  // Throws std::runtime_error at the end.
  std::shared_ptr<const Maps> maps();
  // Null if other settings are there before it is done.
  std::shared_ptr<const Maps> shoot(const Settings& settings, uint64_t turn) const;
  nlohmann::ordered_json describe() const;

  const Scene& scene_;
  const accel::Bvh& bvh_;
  mutable std::mutex settings_mutex_;  // guards what follows, up to ended_
  std::condition_variable changed_;
  Settings asked_;                    // by the command line, and since then by readers
  std::optional<Settings> settled_;   // of the picture that is shown; unset until they are known
  std::shared_ptr<const Maps> made_;  // null: not yet for these settings
  bool ended_ = false;
  std::atomic<uint64_t> turn_{0};  // grows when photons that are being shot are those of nothing any more
  std::mutex shooting_;            // held while photons are shot, so that they are shot once
};

}  // namespace kaustik::app
