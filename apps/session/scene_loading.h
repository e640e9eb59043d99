#pragma once
// From a path to a scene that is ready to trace, with the settings that hold for it.

#include <string>
#include <string_view>

#include "apps/console/console.h"
#include "apps/import/import_scene.h"
#include "apps/settings/scene_settings.h"
#include "apps/settings/setting_options.h"

namespace kaustik::app {

struct Job {
  Scene scene;  // the camera has its final size
  Settings settings;
  std::string path;
  std::string content_hash;  // of the scene's files, see pbrt::LoadedScene
  std::string scene_output;  // the file's own output name; empty when it has none
  double load_seconds = 0;
};

// Loads and checks a scene file; defaults, then the file's settings, then the command line's. Warnings go to
// the console, and the log says what the file asked for. Throws ExitError: bad scene, after printing every
// error of the file, or bad command line when the crop does not fit the image.
Job load_job(const std::string& path, const SettingOverrides& overrides, const Console& console);

// "12 shapes, 88,066 primitives, 3 materials, 2 lights".
std::string scene_summary(const Scene& scene);

// 1234567 as "1,234,567".
std::string grouped(uint64_t n);

// "1 shape", "1,234 shapes".
std::string counted(uint64_t n, std::string_view noun);

}  // namespace kaustik::app
