#pragma once
// The photon maps of a render, for the live page: what an estimate read, the cloud of all photons, the cells
// of the octree, and settings to render with again.

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
  Laboratory(const Scene& scene, const accel::Bvh& bvh) : scene_(scene), bvh_(bvh) {}

  // The settings of the picture that is shown from now on. Their photons are shot when someone first asks for
  // them.
  void use(const Settings& settings);

  // Called with the settings that a reader gives, and with all settings in place of those of the picture.
  using RenderAgain = std::function<void(const SettingOverrides& given, const Settings&)>;
  PageExtension extension(RenderAgain render_again);

 private:
  struct Maps {
    render::RenderSettings settings;
    render::EstimatorPlan plan;
    render::FirstPhotons first;
  };

  std::optional<HttpResponse> answer(const HttpRequest& request, const RenderAgain& render_again);
  HttpResponse render_with(const std::string& body, const RenderAgain& render_again) const;
  std::shared_ptr<const Maps> maps();
  nlohmann::ordered_json describe() const;
  Settings settings() const;

  const Scene& scene_;
  const accel::Bvh& bvh_;
  mutable std::mutex settings_mutex_;  // guards settings_ and made_
  Settings settings_;
  std::shared_ptr<const Maps> made_;  // null: not yet for these settings
  std::mutex shooting_;               // held while photons are shot, so that they are shot once
};

}  // namespace kaustik::app
