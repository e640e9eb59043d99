#pragma once
// A test fixture that writes scenes into a folder of its own and loads them.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "apps/import/import_scene.h"
#include "tests/support/output_folder.h"

namespace kaustik::pbrt {

// The shapes and materials of the file alone: a model that comes alone gets no floor.
inline const ImportOptions kWithoutFloor{.view = {.floor = Floor::kOff}};

// Named materials m0, of this type and parameters, and m1 to m<count>, each of which mixes the one before it
// with itself: 2^count paths lead from the last one to the first. One line each.
inline std::string nested_mixtures(const std::string& first, int count) {
  std::string text = "MakeNamedMaterial \"m0\" \"string type\" " + first + "\n";
  for (int i = 1; i <= count; ++i) {
    const std::string before = "\"m" + std::to_string(i - 1) + "\" ";
    text += "MakeNamedMaterial \"m" + std::to_string(i) +
            "\" \"string type\" \"mix\" \"string materials\" [ " + before + before + "]\n";
  }
  return text;
}

class ImportTest : public testing::Test {
 protected:
  void SetUp() override { folder_ = test::empty_output_folder(); }
  void TearDown() override {
    if (!HasFailure()) std::filesystem::remove_all(folder_);
  }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    // Removes the old file first: truncating a file may wait for the disk.
    std::filesystem::remove(path);
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

  // Imports the scene, which must have no errors, without building it.
  SceneDescription describe(const std::string& text) {
    diagnostics_ = Diagnostics();
    auto description = import_scene(write("scene.pbrt", text), diagnostics_);
    EXPECT_FALSE(diagnostics_.has_errors()) << diagnostics_.format_all();
    return std::move(*description);
  }

  // Loads the scene, which must have no errors.
  LoadedScene load(const std::string& text) {
    diagnostics_ = Diagnostics();
    auto loaded = load_scene(write("scene.pbrt", text), diagnostics_);
    EXPECT_TRUE(loaded) << diagnostics_.format_all();
    return loaded ? std::move(*loaded) : LoadedScene{};
  }
  Scene world(const std::string& text) { return load("WorldBegin\n" + text).scene; }

  // All messages about a scene, with file names without their folder.
  std::string messages(const std::string& text) {
    diagnostics_ = Diagnostics();
    loaded_ = load_scene(write("scene.pbrt", text), diagnostics_).has_value();
    EXPECT_EQ(loaded_, !diagnostics_.has_errors());
    std::string out = diagnostics_.format_all();
    const std::string prefix = folder_.string() + "/";
    for (size_t i; (i = out.find(prefix)) != out.npos;) out.erase(i, prefix.size());
    return out;
  }
  // Only the first line of each message, without the file's name. The text is put after a line with
  // WorldBegin.
  std::string first_lines(const std::string& text) {
    messages("WorldBegin\n" + text);
    std::string out;
    for (const Diagnostic& d : diagnostics_.entries()) {
      out += std::to_string(d.location.line) + ":" + std::to_string(d.location.column) +
             (d.severity == Severity::kError ? ": error: " : ": warning: ") + d.message + "\n";
    }
    const std::string prefix = folder_.string() + "/";
    for (size_t i; (i = out.find(prefix)) != out.npos;) out.erase(i, prefix.size());
    return out;
  }

  std::filesystem::path folder_;
  Diagnostics diagnostics_;
  bool loaded_ = false;
};

}  // namespace kaustik::pbrt
