#pragma once
// What the renders of a sweep are measured against.

#include <functional>
#include <optional>
#include <string>

#include "apps/session/scene_loading.h"
#include "apps/sweep/sweep_folder.h"
#include "render/picture/image.h"

namespace kaustik::app {

struct ReferenceChoice {
  std::string file;                      // empty: it is rendered
  double seconds = 60;                   // that rendering may take
  std::optional<render::Method> method;  // unset: reference_method decides
};

// `mc` where the scene has neither mirror nor glass: unbiased, and finds all light. Else `auto` with radii
// that shrink over the passes: paths do not find the light of point lights through glass at all, and that of
// small lights so rarely that photons are nearer to the truth after the same time.
render::Method reference_method(const SceneNeeds& needs);

struct Reference {
  render::Image image;
  std::string hash;  // of the image: what is measured against another one is another measurement
  SweepReference about;
};

// Tells how far it is, in milliseconds of all; false cancels.
using ReferenceProgress = std::function<bool(uint64_t done, uint64_t total)>;

// Reads the file, or takes the one in the folder, or renders passes into it until the time is over (two at
// least), with a seed that no cell has, and without what a sweep examines: of the settings only size, crop,
// bounces and memory are the job's. Nothing when cancelled: then the passes that are complete are kept in the
// folder for the next time. What is damaged in the folder is rendered again, after a warning. Throws
// ExitError (bad command line) for a file that cannot be read or has another size. job's settings are the
// same afterwards.
std::optional<Reference> make_reference(const ReferenceChoice& choice, Job& job, const SweepFolder& folder,
                                        const ReferenceProgress& progress, const Console& console);

// Of size and pixels, to the bit.
std::string picture_hash(const render::Image& image);

// Width and height of the pictures of a job.
std::pair<int, int> picture_size(const Job& job);

}  // namespace kaustik::app
