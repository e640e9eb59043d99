#pragma once
// FLIP: the difference that a person notices when two pictures replace each other on a screen (Andersson et
// al. 2020, "FLIP: A Difference Evaluator for Alternating Images"; for radiance Andersson et al. 2021,
// "Visualizing Errors in Rendered High Dynamic Range Images").
//
// Both pictures are blurred as the eye blurs them at a distance, in an opponent colour space; their colours
// are compared in L*a*b*, and the edges and points that only one of them has amplify the difference. 0 is no
// difference, 1 the largest there is.

#include <optional>
#include <vector>

#include "render/compare/compare.h"

namespace kaustik::render {

struct FlipSettings {
  // Pixels of the screen per degree of view. The default is the paper's: a screen 0.7 m wide of 3840 pixels,
  // seen from 0.7 m.
  double pixels_per_degree = 67.0206;
};

// The exposures at which radiance is compared, in stops, at equal steps; start and stop are equal if there is
// one.
struct Exposures {
  double start = 0, stop = 0;
  int count = 1;
};

struct Flip {
  std::vector<float> error;            // per pixel, row 0 at the top; in [0, 1]
  double mean = 0;                     // over the pixels that compare
  std::optional<Exposures> exposures;  // nothing for display values
};

// Compares display values: linear Rec. 709, clamped to [0, 1]. The mean is over the pixels that
// compared_pixels() tells; the others are taken as black in both pictures. Throws as compare() does.
Flip flip_of_display(const Image& reference, const Image& image, const FlipSettings& settings = {},
                     const CompareOptions& options = {});

// Compares radiance: the largest error over the exposures between which the reference's brightest pixel and
// its median reach 0.85 of the screen's white, with the tone curve of ACES. At most 32 exposures, and at
// least two unless the reference is black. Otherwise as flip_of_display().
Flip flip_of_radiance(const Image& reference, const Image& image, const FlipSettings& settings = {},
                      const CompareOptions& options = {});

// The errors as a picture in the false colours of the paper's heat maps, magma: black, violet, orange, pale
// yellow at 1. Linear values for write_image() with the default tone settings.
Image flip_colours(const Flip& flip, int width, int height);

}  // namespace kaustik::render
