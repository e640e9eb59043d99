#pragma once
// Calls the program in the test's own process, with a folder of its own to work in.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <sstream>
#include <string>
#include <vector>

#include "apps/run.h"
#include "tests/support/output_folder.h"

namespace kaustik::test {

struct Outcome {
  int code = -1;
  std::string out, err;
};

inline Outcome run_kaustik(const std::vector<std::string>& arguments) {
  std::vector<const char*> argv = {"kaustik"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  std::ostringstream out, err;
  const int code = app::run(static_cast<int>(argv.size()), argv.data(), out, err);
  return {code, out.str(), err.str()};
}

// The exposure that a log names, as the option's text.
inline std::string logged_exposure(const std::string& log) {
  const std::string before = "exposure: --exposure ";
  const size_t at = log.find(before);
  if (at == std::string::npos) return "none is logged";
  const size_t start = at + before.size();
  return log.substr(start, log.find(' ', start) - start);
}

// Works in output_folder(), which is emptied at the start of the test and kept after it for inspection.
class ProgramTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    return path(name);
  }
  std::string read(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  // Writes a scene with a light over a floor and a sphere of milky glass, which disperses, between them;
  // `lines` come before WorldBegin.
  std::string small_scene(const std::string& lines = "") const {
    return write("small.pbrt", "LookAt 0 2 6  0 0.5 0  0 1 0\nCamera \"perspective\" \"float fov\" 40\n" +
                                   lines +
                                   "\nWorldBegin\n"
                                   "AttributeBegin\n  AreaLightSource \"diffuse\" \"rgb L\" [10 10 10]\n"
                                   "  ReverseOrientation\n  Translate 0 3 0\n  Rotate -90 1 0 0\n"
                                   "  Shape \"disk\" \"float radius\" 0.5\nAttributeEnd\n"
                                   "Material \"diffuse\" \"rgb reflectance\" [0.7 0.6 0.5]\n"
                                   "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" "
                                   "[-3 0 3  3 0 3  3 0 -3  -3 0 -3]\n"
                                   "MakeNamedMedium \"milk\" \"string type\" \"homogeneous\" \"rgb sigma_a\" "
                                   "[0 0 0] \"rgb sigma_s\" [0.3 0.3 0.4]\n"
                                   "MediumInterface \"milk\" \"\"\n"
                                   "Material \"dielectric\" \"float abbe\" 20\nTranslate 0 0.8 0\n"
                                   "Shape \"sphere\" \"float radius\" 0.5\n");
  }
  static std::string film(int width, int height) {
    return "Film \"rgb\" \"integer xresolution\" " + std::to_string(width) + " \"integer yresolution\" " +
           std::to_string(height);
  }

 private:
  std::filesystem::path folder_ = empty_output_folder();
};

}  // namespace kaustik::test
