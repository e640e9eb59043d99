#include "apps/web/page_server.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "apps/console/exit_error.h"
#include "apps/html/html.h"
#include "apps/live/viewer_pace.h"
#include "apps/web/open_browser.h"
#include "apps/web/page_data.h"
#include "apps/web/reference_picture.h"
#include "apps/web/saved_picture.h"
#include "live_page_assets.h"

namespace kaustik::app {

namespace {

constexpr std::chrono::milliseconds kBetweenLooks{100};
constexpr int kLooks = 10;  // of which the last one sends an event in any case
// Pages get the first pictures faster than by viewer_pace.h: as if no pixels had been sent for so long.
constexpr std::chrono::milliseconds kCredit{1500};

std::string page_html() {
  std::string script;
  for (const std::string_view part :
       {assets::live_base, assets::live_canvas, assets::live_cloud, assets::live_compare, assets::live_curve,
        assets::live_disc, assets::live_estimate, assets::live_gpu, assets::live_lab, assets::live_layers,
        assets::live_picture, assets::live_settings, assets::live_status, assets::live_tone,
        assets::live_view})
    script += std::string(part) + "\n";
  return filled(assets::live_page, {{"style", std::string(assets::live_style)}, {"script", script}});
}

}  // namespace

PageServer::PageServer(const PageOptions& options, std::shared_ptr<LiveRender> live, PageExtension extension,
                       const Console& console)
    : options_(options), extension_(std::move(extension)), shown_{std::move(live), 1} {
  const LivePicture& picture = shown_.render->picture;
  if (!options.reference.empty())
    reference_ =
        read_reference(options.reference, picture.range(), picture.full_width(), picture.full_height());
  if (!options.listen.empty()) address_.host = options.listen, address_.token = random_token();
  try {
    server_ = start_http_server(address_.host, options.port, *this);
  } catch (const std::runtime_error& error) {
    throw ExitError(kFailed, error.what());
  }
  address_.port = server_->port();
  console.out << url() << std::endl;
  if (options.open && !open_browser(url())) console.warning("no browser could be opened: xdg-open failed");
}

PageServer::~PageServer() {
  wait_for_readers();
  ending_ = true;
  server_.reset();
}

void PageServer::show(std::shared_ptr<LiveRender> live) {
  const std::lock_guard lock(mutex_);
  shown_ = {std::move(live), shown_.number + 1};
}

PageServer::Shown PageServer::shown() const {
  const std::lock_guard lock(mutex_);
  return shown_;
}

void PageServer::wait_for_readers() const {
  constexpr std::chrono::milliseconds kLongest{2000}, kQuiet{400};
  const auto begin = Clock::now();
  const auto is_busy = [&] {
    const std::lock_guard lock(mutex_);
    return in_flight_ > 0 || Clock::now() < std::max(begin, last_sent_) + kQuiet;
  };
  while (readers_ > 0 && Clock::now() < begin + kLongest && is_busy())
    std::this_thread::sleep_for(kBetweenLooks / 10);
}

HttpResponse PageServer::answer(const HttpRequest& request) {
  HttpRequest inner = request;
  HttpResponse response;
  try {
    if (auto refused = refusal(&inner, address_))
      response = std::move(*refused);
    else
      response = inner.method == "POST" ? post(inner) : get(inner);
  } catch (const std::bad_alloc&) {
    response = error_response(503, "out of memory");
  } catch (const std::exception& error) {
    response = error_response(500, error.what());
  }
  response.headers.insert(response.headers.end(), {{"Cache-Control", "no-store"},
                                                   {"X-Content-Type-Options", "nosniff"},
                                                   {"X-Frame-Options", "DENY"},
                                                   {"Referrer-Policy", "no-referrer"},
                                                   {"Cross-Origin-Resource-Policy", "same-origin"}});
  return response;
}

HttpResponse PageServer::get(const HttpRequest& request) {
  const Shown now = shown();
  if (request.path == "/") return {200, "text/html; charset=utf-8", page_html()};
  if (request.path == "/info") {
    nlohmann::ordered_json more = {
        {"lab", bool(extension_.answer)},
        {"reference", std::filesystem::path(options_.reference).filename().string()}};
    if (extension_.describe) more.update(extension_.describe());
    return {200, "application/json", info_json(*now.render, options_.tone, more)};
  }
  if (request.path == "/events") return {.type = {}, .body = {}, .events = true};
  if (request.path == "/pixels") return pixels(request);
  if (request.path == "/save") return save(request);
  if (request.path == "/reference" && !reference_.empty()) return reference();
  if (extension_.answer)
    if (auto response = extension_.answer(request)) return std::move(*response);
  return error_response(404, "there is nothing here");
}

HttpResponse PageServer::post(const HttpRequest& request) {
  const Shown now = shown();
  if (request.path == "/pause")
    now.render->pause(true);
  else if (request.path == "/resume")
    now.render->pause(false);
  else if (request.path == "/stop")
    now.render->stop();
  else if (auto response = extension_.answer ? extension_.answer(request) : std::nullopt)
    return std::move(*response);
  else
    return error_response(404, "there is nothing here");
  return {.status = 204, .type = {}, .body = {}};
}

HttpResponse PageServer::pixels(const HttpRequest& request) {
  const Shown now = shown();
  auto bytes =
      pixels_since(*now.render, now.number, request.value("layer"), request.number("since").value_or(0));
  if (!bytes) return error_response(404, fmt::format("there is no layer {}", request.value("layer")));
  ++in_flight_;
  HttpResponse response{200, "application/octet-stream", std::move(*bytes)};
  response.sent = [this](double processor_seconds) { pixels_sent(processor_seconds); };
  return response;
}

void PageServer::pixels_sent(double processor_seconds) {
  --in_flight_;
  const std::lock_guard lock(mutex_);
  last_sent_ = Clock::now();
  next_update_ = std::max(next_update_, last_sent_ - kCredit) +
                 std::chrono::duration_cast<Clock::duration>(
                     std::chrono::duration<double>(rest_after(processor_seconds)));
}

uint64_t PageServer::announced(const Shown& now, const LiveStatus& status) {
  const uint64_t version = now.render->picture.changed_since(~uint64_t{0}).version;
  const std::lock_guard lock(mutex_);
  const bool may = status.state != LiveState::kRunning || Clock::now() >= next_update_;
  if (may || announced_number_ != now.number) announced_number_ = now.number, announced_version_ = version;
  return announced_version_;
}

HttpResponse PageServer::reference() const {
  const auto* const bytes = reinterpret_cast<const char*>(reference_.data());
  return {200, "application/octet-stream", std::string(bytes, reference_.size() * sizeof(float))};
}

HttpResponse PageServer::save(const HttpRequest& request) const {
  const Shown now = shown();
  return saved_picture(*now.render, request, options_.tone);
}

std::string PageServer::next_event(EventReader* reader) {
  for (int look = 1; !ending_; ++look) {
    if (reader->seen != 0) std::this_thread::sleep_for(kBetweenLooks);
    const Shown now = shown();
    const LiveStatus status = now.render->status();
    const uint64_t version = announced(now, status);
    // Anything but the time that passes.
    const uint64_t key = std::hash<std::string>()(
        fmt::format("{} {} {} {} {} {} {} {}", now.number, version, int(status.state), status.phase,
                    status.pass, status.fraction, status.errors.size(), status.stopped));
    if (key != reader->seen || look >= kLooks) {
      reader->seen = key;
      return status_event(*now.render, now.number, version);
    }
  }
  return {};
}

}  // namespace kaustik::app
