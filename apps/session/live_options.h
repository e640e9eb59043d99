#pragma once
// The options of the commands that render by which a render is followed, and who then shows it.

#include <memory>
#include <string>
#include <vector>

#include "apps/command_line/command.h"
#include "apps/live/live_render.h"
#include "apps/settings/table/settings.h"
#include "apps/web/page_server.h"

namespace kaustik::app {

struct LiveOptions {
  std::string display;   // HOST:PORT of a program that shows pictures; empty: none
  bool preview = false;  // shows the picture in the terminal
  bool view = false;     // serves a page with the picture
  PageOptions page{};

  bool any() const { return !display.empty() || preview || view; }
};

void add_live_options(Command& command, LiveOptions& options);

using LiveViewers = std::vector<std::unique_ptr<LiveViewer>>;

// layers: of --aov. tone: of viewers that show what PNG files would. `console` must outlive the viewers.
// Throws ExitError (failed) for a page that cannot be served.
LiveViewers start_viewers(const LiveOptions& options, const std::shared_ptr<LiveRender>& live,
                          const std::vector<std::string>& layers, const ToneChoice& tone,
                          const Console& console);

}  // namespace kaustik::app
