#pragma once
// Photon maps that a session writes to a file, or takes from one.

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "apps/console/console.h"
#include "apps/session/files/scene_loading.h"
#include "render/map_files/map_file.h"
#include "render/maps/pass_photons.h"
#include "render/plan/progress.h"

namespace kaustik::app {

struct KeptMaps {
  std::string save;                       // file to write; empty: none
  std::optional<render::MapFile> from{};  // in place of photons that are shot
  // Photons that were shot for an earlier picture of the sequence, in place of both, and what was found out
  // about the scene.
  std::shared_ptr<const render::KeptPhotons> photons{};
  std::shared_ptr<render::ExploredScene> explored{};
  bool any() const { return from || !save.empty() || photons; }
};

// Opens a map file. Throws ExitError (bad command line) for one that is damaged, or of another build or
// instruction set of the program.
render::MapFile open_map_file(const std::string& path);

// The settings on which the photons of a file depend, followed by those that are given. Estimators that are
// given take the place of all of the file's.
SettingOverrides with_settings_of(const render::MapFile& file, const SettingOverrides& given);

// Throws ExitError (bad command line) for rules that would need photons beside the maps.
void check_stop_rules(const KeptMaps& kept, const StopSettings& stop);

// Checks that the maps can serve the job, and asks for a single pass. Throws ExitError (bad command line),
// which names what differs.
void settle_kept_maps(const KeptMaps& kept, const Console& console, Job* job);

// Logs what a file settles for other cameras than those of the job (views, or the scene's camera). Throws
// ExitError (bad command line) if the job writes sums, which would then depend on the file.
void note_cameras(const KeptMaps& kept, const Job& job, std::span<const Camera> views, bool writes_sums,
                  const Console& console);

// The photons of the job, from an earlier picture, from the file or shot, which are then written to the other
// file. Without radii if the progress callback cancelled. Throws render::MapFileError, for a file that cannot
// be written with *photons set.
void make_photons(const KeptMaps& kept, const Job& job, const accel::Bvh& bvh, std::span<const Camera> views,
                  const render::ProgressCallback& progress, std::shared_ptr<render::FirstPhotons>* photons);

// Checks the columns of a map file while they are used.
class MapCheck {
 public:
  // Begins on the threads of the calling task arena.
  explicit MapCheck(const render::MapFile& file);
  ~MapCheck();
  MapCheck(const MapCheck&) = delete;
  MapCheck& operator=(const MapCheck&) = delete;

  // Waits for the result. Throws render::MapFileError for a damaged file.
  void finish();

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace kaustik::app
