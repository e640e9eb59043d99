#include "apps/session/live_options.h"

#include "apps/live/terminal_preview.h"
#include "apps/live/tev_display.h"
#include "apps/web/page_options.h"

namespace kaustik::app {

namespace {

constexpr uint16_t kTevPort = 14158;

void add_display(Command& command, LiveOptions& options) {
  command.add_parsed(
      "--display", "HOST[:PORT]",
      "Show the picture in progress in tev or HDRView, which run on this host. A viewer that is slow, or not "
      "there, does not hold up the render. Default: no viewer; port 14158",
      [&options](const std::string& text) {
        try {
          parse_address(text, kTevPort);
        } catch (const std::invalid_argument& error) {
          throw OptionError("--display", error.what());
        }
        options.display = text;
      });
}

}  // namespace

void add_live_options(Command& command, LiveOptions& options) {
  add_display(command, options);
  command.add_flag(
      "--preview", options.preview,
      "Show the picture in progress in the terminal, over ssh, too: by kitty's graphics protocol or "
      "sixels where the terminal knows them, else by coloured characters");
  command.add_flag(
      "--view", options.view,
      "Serve a page with the picture in progress to this machine's browser, and print its address");
  add_page_options(command, options.page, "--view");
}

LiveViewers start_viewers(const LiveOptions& options, const std::shared_ptr<LiveRender>& live,
                          const std::vector<std::string>& layers, const ToneChoice& tone,
                          const Console& console) {
  LiveViewers viewers;
  if (!options.display.empty())
    viewers.push_back(std::make_unique<TevDisplay>(parse_address(options.display, kTevPort),
                                                   display_channels(layers), *live, console));
  if (options.preview)
    if (auto preview = start_preview(*live, tone, console)) viewers.push_back(std::move(preview));
  if (options.view) {
    PageOptions page = options.page;
    page.tone = tone;
    viewers.push_back(std::make_unique<PageServer>(page, live, PageExtension{}, console));
  }
  return viewers;
}

}  // namespace kaustik::app
