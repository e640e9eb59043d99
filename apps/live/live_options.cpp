#include "apps/live/live_options.h"

namespace kaustik::app {

void add_live_options(Command&, LiveOptions&) {}

void check_live_options(const LiveOptions&) {}

LiveViewers start_viewers(const LiveOptions&, LiveRender&, const std::vector<std::string>&, const Console&) {
  return {};
}

}  // namespace kaustik::app
