#pragma once
// Learns which light photons carry and which paths find.

#include <memory>

#include "photon/emission/emission_guide.h"
#include "photon/sources/source_split.h"
#include "render/plan/render_input.h"

namespace kaustik::render {

// The shares of photons in all sources, and what they lead to.
struct LearnedSplit {
  photon::SourceSplit sources;
  bool photons = true;  // whether photons may have anything to do
  bool light = true;    // whether they bring some of the light that the few photons show
  // Share of the indirect photons that are left, of those that sources would send if photons carried all.
  double stored = 1;
  // Predicted squared noise of the paths' share of the light, over 64 pixels.
  double noise = 0;
  // Predicted squared error, as a multiple of that of paths alone with as many samples.
  double error = 1;
};

// Learns the shares from few photons, which are not counted. guide: that of indirect photons; null: they are
// not guided. A function of scene and settings. Null where too few photons without a guide arrive at
// visible points to tell.
std::unique_ptr<const LearnedSplit> learn_split(const RenderInput& input, const photon::EmissionGuide* guide);

}  // namespace kaustik::render
