#pragma once
// Loads a scene and combines its settings with those of the command line.

#include <string>
#include <string_view>

#include "apps/console/console.h"
#include "apps/import/import_scene.h"
#include "apps/session/files/collisions.h"
#include "apps/session/files/memory_plan.h"
#include "apps/settings/scene_settings.h"
#include "apps/settings/setting_options.h"

namespace kaustik::app {

struct Job {
  Scene scene;  // the camera has its final size
  Settings settings;
  std::string path;
  std::string content_hash;  // of the scene's files, see pbrt::LoadedScene
  std::string scene_output;  // output name in the scene file; empty when it has none
  // What the file says of its camera, film and animations; without shapes, materials and lights.
  SceneDescription view;
  bool fixed_screen_window = false;  // see SceneSettings
  double load_seconds = 0;
  MemoryPlan memory{};
  std::vector<std::string> files;  // every file that was read
};

// What a scene is loaded for: its description alone, without the pixels of its textures; photons that are
// written and not rendered; or pictures.
enum class LoadFor { kDescription, kPhotons, kPictures };

// Loads and checks a scene file. The command line's settings override the file's, which override the
// defaults. Warnings go to the console, and the log names the settings that the file makes. Throws ExitError:
// bad scene, after printing every error of the file, or bad command line when the crop does not fit the
// image. Throws std::runtime_error if there is not enough memory for pictures.
Job load_job(const std::string& path, const SettingOverrides& overrides, const Console& console,
             LoadFor use = LoadFor::kPictures);

// The files of a scene as inputs for check_collisions().
std::vector<NamedFile> files_of(const Job& job);

// For example "12 shapes, 88,066 primitives, 3 materials, 2 lights".
std::string scene_summary(const Scene& scene);

// Formats 1234567 as "1,234,567".
std::string grouped(uint64_t n);

// A number with its noun in singular or plural: "1 shape", "1,234 shapes".
std::string counted(uint64_t n, std::string_view noun);

}  // namespace kaustik::app
