#pragma once
// A picture in progress as a small picture for the screen.

#include "apps/live/live_picture.h"
#include "apps/live/terminal/pixels8.h"
#include "apps/settings/table/settings.h"

namespace kaustik::app {

class PreviewPixels {
 public:
  // `picture` must outlive it.
  PreviewPixels(const LivePicture& picture, const ToneChoice& tone);

  // Reads what the picture has new, and returns whether there was anything.
  bool update();
  // Whether there is anything to see yet.
  bool known() const { return version_ > 0; }
  // The means over the area of each pixel of a size that is not larger than the picture's, as PNG files would
  // show them now: an automatic exposure is that of the picture so far.
  Pixels8 shown(int width, int height) const;

 private:
  void read(const render::PixelRange& tile);

  const LivePicture& live_;
  const ToneChoice tone_;
  const std::vector<LiveChannel> channels_;
  uint64_t version_ = 0;
  render::Image picture_;
  render::Image lights_;  // for the automatic exposure: see render::lights_seen()
};

}  // namespace kaustik::app
