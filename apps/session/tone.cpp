#include "apps/session/tone.h"

#include <fmt/format.h>

#include "render/passes/partial_result.h"
#include "render/picture/exposure.h"
#include "render/picture/image_io.h"

namespace kaustik::app {

bool shows_tones(const std::string& path) {
  return !render::is_partial_name(path) && !render::is_exr(path);
}

render::ToneSettings tone_for(const render::Image& picture, const render::Image& lights,
                              const ToneChoice& choice, const Console& console) {
  if (choice.exposure) return {*choice.exposure, choice.tonemap};
  const float stops = render::automatic_exposure(picture, lights, choice.tonemap);
  console.note(fmt::format("exposure: --exposure {} (automatic)", stops));
  return {stops, choice.tonemap};
}

}  // namespace kaustik::app
