#pragma once
// The film into which a pass is rendered.

#include "render/film/halves.h"
#include "render/film/media_sums.h"

namespace kaustik::render {

struct PassFilm {
  FilmSums sums;
  HalfSums half;    // of the half that is summed apart; empty if the pass is not halved
  MediaSums media;  // empty if no medium of the scene scatters

  bool halved() const { return half.width() > 0; }
  bool has_media() const { return media.width() > 0; }
  void clear() {
    sums.clear();
    half.clear();
    media.clear();
  }
};

}  // namespace kaustik::render
