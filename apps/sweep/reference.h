#pragma once
// Makes the reference image that the renders of a sweep are measured against.

#include <functional>
#include <optional>
#include <string>

#include "apps/session/files/scene_loading.h"
#include "apps/sweep/sweep_folder.h"
#include "render/picture/image.h"

namespace kaustik::app {

struct ReferenceChoice {
  std::string file;                      // empty = render the reference
  double seconds = 60;                   // time for rendering it
  std::optional<render::Method> method;  // unset = as reference_method() decides
};

// The method of the reference. For scenes without specular surfaces it is `mc`, which is unbiased and finds
// all light there. Otherwise it is `auto`, with radii that shrink over the passes: path tracing never finds
// the light of point lights through glass, and finds that of small lights so rarely that photons are more
// accurate after the same time.
render::Method reference_method(const SceneNeeds& needs);

struct Reference {
  render::Image image;
  render::Image lights;  // lights_seen() of it
  // picture_hash of the image; part of each cell's key, so a new reference measures cells anew
  std::string hash;
  SweepReference about;
};

// Reports progress in milliseconds; returning false cancels.
using ReferenceProgress = std::function<bool(uint64_t done, uint64_t total)>;

// Reads the chosen file, or the reference in the folder, or renders one into the folder. Rendering takes
// passes until the time is up, at least two, with a seed that no cell has. Size, crop, bounces, threads and
// memory are the job's settings; all others are fixed. Nothing when cancelled; the complete passes are then
// kept in the folder for the next run. A damaged reference in the folder is rendered again, after a warning.
// Throws ExitError (bad command line) for a file that cannot be read or has the wrong size. Restores the
// job's settings.
std::optional<Reference> make_reference(const ReferenceChoice& choice, Job& job, const SweepFolder& folder,
                                        const ReferenceProgress& progress, const Console& console);

// A hash of the image's size and the exact bits of its pixels.
std::string picture_hash(const render::Image& image);

// Width and height of a job's pictures in pixels.
std::pair<int, int> picture_size(const Job& job);

}  // namespace kaustik::app
