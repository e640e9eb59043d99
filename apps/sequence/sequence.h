#pragma once
// Renders the frames of a sequence: of a camera path, of an animated scene, or of both.

#include <optional>
#include <string>

#include "apps/sequence/camera_path.h"
#include "apps/session/render_session.h"
#include "render/passes/pass_set.h"

namespace kaustik::app {

struct SequenceOptions {
  std::string camera_path;                  // JSON file; empty: none
  std::optional<render::PassSet> frames{};  // to render; unset: all
  bool overwrite = false;                   // renders frames whose files exist, too
  bool any() const { return !camera_path.empty() || frames.has_value(); }
};

// The frames that a sequence has, and what each of them changes.
struct Sequence {
  std::optional<CameraPath> path{};
  bool animated = false;     // the scene is, at 24 frames a second
  bool moves_world = false;  // animations move more than the camera
  uint64_t frames = 0;
};

// Reads the camera path, and counts the frames of the scene. Throws ExitError (bad command line) for a scene
// without animation and without path, for frames that the sequence does not have, and for options that cannot
// be combined with it.
Sequence make_sequence(const SequenceOptions& options, const RenderSession& session, const Job& job,
                       const Console& console);

// Renders the frames whose files are missing. `job` and `session`: of the scene, settled, with patterns
// (frame_name) in place of file names. given: the settings of the command line. In a world that stands still
// photons are shot once, for the cameras of the whole sequence, whichever frames are rendered. Returns the
// exit code.
int run_sequence(const SequenceOptions& options, const Sequence& sequence, const SettingOverrides& given,
                 Job& job, RenderSession session, const InterruptGuard& interrupt, const Console& console);

}  // namespace kaustik::app
