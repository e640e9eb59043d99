#pragma once
// Serves the live page of a render, by default to this machine alone.

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/console/console.h"
#include "apps/live/live_render.h"
#include "apps/settings/table/settings.h"
#include "apps/web/request_check.h"

namespace kaustik::app {

struct PageOptions {
  int port = 0;          // 0: any that is free
  std::string listen{};  // the address of this machine to serve at; empty: 127.0.0.1, for this machine alone
  bool open = false;     // opens the page in the user's browser
  std::string reference{};  // a picture to compare with, or empty
  ToneChoice tone{};        // how the page shows the picture at first
};

// Answers requests that only some pages have. `describe`: members for /info.
struct PageExtension {
  std::function<std::optional<HttpResponse>(const HttpRequest&)> answer{};
  std::function<nlohmann::ordered_json()> describe{};
};

class PageServer final : public LiveViewer, private HttpHandler {
 public:
  // Starts to serve, and prints the address as a result. Throws ExitError if that is impossible, or the
  // reference is no picture of this size.
  PageServer(const PageOptions& options, std::shared_ptr<LiveRender> live, PageExtension extension,
             const Console& console);
  // Waits a moment for the pages that are open to get the last state.
  ~PageServer() override;

  // Shows another render from now on.
  void show(std::shared_ptr<LiveRender> live);
  std::string url() const { return address_.url(); }

 private:
  using Clock = std::chrono::steady_clock;
  struct Shown {
    std::shared_ptr<LiveRender> render;
    uint64_t number = 0;
  };

  HttpResponse answer(const HttpRequest& request) override;
  std::string next_event(EventReader* reader) override;
  // The version of the pixels that pages shall show. The newest one would keep them busy.
  uint64_t announced(const Shown& now, const LiveStatus& status);
  void pixels_sent(double processor_seconds);
  void stream_begins() override { ++readers_; }
  void stream_ends() override { --readers_; }
  HttpResponse get(const HttpRequest& request);
  HttpResponse post(const HttpRequest& request);
  HttpResponse pixels(const HttpRequest& request);
  HttpResponse save(const HttpRequest& request) const;
  HttpResponse reference() const;
  Shown shown() const;
  void wait_for_readers() const;

  const PageOptions options_;
  const PageExtension extension_;
  std::vector<float> reference_;  // r, g, b of the window; may be empty
  PageAddress address_;
  mutable std::mutex mutex_;  // guards what follows, up to last_sent_
  Shown shown_;
  uint64_t announced_number_ = 0, announced_version_ = 0;
  Clock::time_point next_update_{}, last_sent_{};
  std::atomic<int> readers_{0}, in_flight_{0};  // streams of events; answers with pixels
  std::atomic<bool> ending_{false};
  std::unique_ptr<HttpServer> server_;  // the last member: its threads use the others
};

}  // namespace kaustik::app
