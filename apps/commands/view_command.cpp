// kaustik view: shows a render while it goes on in a page, and renders again with other settings.

#include <fmt/format.h>

#include <chrono>
#include <mutex>
#include <optional>
#include <thread>

#include "apps/commands/commands.h"
#include "apps/console/exit_error.h"
#include "apps/machine/thread_limit.h"
#include "apps/session/files/scene_loading.h"
#include "apps/session/isa_option.h"
#include "apps/session/render_session.h"
#include "apps/settings/setting_options.h"
#include "apps/web/laboratory.h"
#include "apps/web/page_options.h"
#include "apps/web/page_server.h"

namespace kaustik::app {

namespace {

struct ViewOptions {
  std::string scene;
  PageOptions page;
  SettingOverrides overrides;
};

// Renders that follow each other on one page.
class View {
 public:
  View(const ViewOptions& options, Job job, const InterruptGuard& interrupt, const Console& console)
      : options_(options),
        console_(console),
        interrupt_(interrupt),
        job_(std::move(job)),
        bvh_(job_.scene, job_.settings.render.threads),
        laboratory_(job_.scene, bvh_, job_.settings),
        given_(options.overrides) {}
  ~View() { laboratory_.end(); }

  int run() {
    for (Settings settings = job_.settings;;) {
      const std::shared_ptr<LiveRender> live = make_live(job_);
      begin(live, settings);
      if (const int code = render(settings, live); code != kDone && code != kInterrupted) return code;
      std::optional<Next> next = wait_for_next();
      if (!next) return kDone;
      given_.append(next->given);
      settings = std::move(next->settings);
    }
  }

 private:
  // What a reader of the page asks for.
  struct Next {
    SettingOverrides given;
    Settings settings;
  };

  void begin(const std::shared_ptr<LiveRender>& live, const Settings& settings) {
    laboratory_.begin();
    {
      const std::lock_guard lock(mutex_);
      live_ = live;
      if (next_) live->stop();  // someone has already asked for another one
    }
    if (page_) return page_->show(live);
    PageOptions page = options_.page;
    page.tone = settings.tone;
    page_.emplace(page, live,
                  laboratory_.extension(
                      [this](const SettingOverrides& given, const Settings& all) { again(given, all); }),
                  console_);
  }

  int render(const Settings& settings, const std::shared_ptr<LiveRender>& live) {
    const Stopwatch total;
    job_.settings = settings;
    RenderSession session;
    session.followed = live;
    session.bvh = &bvh_;
    session.settled = [this](const Settings& settled) { laboratory_.settle(settled); };
    try {
      settle_session(given_, console_, &job_, &session);
      return run_session(job_, std::move(session), interrupt_, total, console_);
    } catch (const std::exception& error) {
      if (!renders_again_) throw;
      // Settings of the page that cannot be rendered: it may give others.
      laboratory_.settle(settings);  // whoever waits for photons is told the same
      console_.error(error.what());
      live->finish(error.what());
      return kDone;
    }
  }

  // Ends the present render and asks for the next one. Called by the page's threads.
  void again(const SettingOverrides& given, const Settings& settings) {
    const std::lock_guard lock(mutex_);
    if (!next_) next_.emplace();
    next_->given.append(given);
    next_->settings = settings;
    live_->stop();
  }

  // The next render, or nothing when the user ends the program.
  std::optional<Next> wait_for_next() {
    constexpr std::chrono::milliseconds kBetweenLooks{20};
    renders_again_ = true;
    while (!interrupt_.requested()) {
      {
        const std::lock_guard lock(mutex_);
        if (next_) return std::exchange(next_, std::nullopt);
      }
      std::this_thread::sleep_for(kBetweenLooks);
    }
    return std::nullopt;
  }

  const ViewOptions& options_;
  const Console& console_;
  const InterruptGuard& interrupt_;
  Job job_;
  const accel::Bvh bvh_;
  Laboratory laboratory_;
  SettingOverrides given_;  // by the command line, and then by the page
  bool renders_again_ = false;
  std::mutex mutex_;  // guards what follows, up to next_
  std::shared_ptr<LiveRender> live_;
  std::optional<Next> next_;
  std::optional<PageServer> page_;  // the last member: its threads use the others
};

int run_view(const ViewOptions& options, const Console& console) {
  const InterruptGuard interrupt;
  Job job;
  with_thread_limit(options.overrides.alone().render.threads, console,
                    [&] { job = load_job(options.scene, options.overrides, console); });
  View view(options, std::move(job), interrupt, console);
  return view.run();
}

}  // namespace

Command make_view_command() {
  Command command("view", "Show a render while it goes on, in a page of this machine's browser");
  const auto options = std::make_shared<ViewOptions>();
  command.add_argument("SCENE", options->scene, "Scene file: .pbrt, .gltf, .glb, .obj, .ply or .stl");
  add_page_options(command, options->page);
  add_isa_option(command);
  command.add_quiet();
  add_setting_options(command, options->overrides, SettingsCommand::kRender);
  command.run = [options](const Console& console) { return run_view(*options, console); };
  return command;
}

}  // namespace kaustik::app
