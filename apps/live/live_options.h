#pragma once
// The options of the commands that render by which a render is followed, and who then shows it.

#include <memory>
#include <string>
#include <vector>

#include "apps/command_line/command.h"
#include "apps/live/live_render.h"
#include "apps/settings/table/settings.h"

namespace kaustik::app {

struct LiveOptions {
  std::string display;   // HOST:PORT of a program that shows pictures; empty: none
  bool preview = false;  // shows the picture in the terminal

  bool any() const { return !display.empty() || preview; }
};

void add_live_options(Command& command, LiveOptions& options);

// Throws ExitError (bad command line) for values that cannot be right.
void check_live_options(const LiveOptions& options);

using LiveViewers = std::vector<std::unique_ptr<LiveViewer>>;

// layers: of --aov. tone: of viewers that show what PNG files would. `live` and `console` must outlive the
// viewers.
LiveViewers start_viewers(const LiveOptions& options, LiveRender& live,
                          const std::vector<std::string>& layers, const ToneChoice& tone,
                          const Console& console);

}  // namespace kaustik::app
