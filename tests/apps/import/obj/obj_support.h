#pragma once
// A test fixture that writes OBJ and MTL files and imports them.

#include <gmock/gmock.h>

#include "tests/apps/import/import_support.h"

namespace kaustik::pbrt {

inline constexpr std::string_view kObjQuad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

class ObjTest : public ImportTest {
 protected:
  // Imports the text, which must have no errors.
  SceneDescription describe(const std::string& text) {
    diagnostics_ = Diagnostics();
    auto scene = import_scene(write("scene.obj", text), diagnostics_, kWithoutFloor);
    EXPECT_TRUE(scene && !diagnostics_.has_errors()) << diagnostics_.format_all();
    return scene ? std::move(*scene) : SceneDescription{};
  }
  // The message of the only error that the text must have.
  std::string error(const std::string& text) {
    diagnostics_ = Diagnostics();
    EXPECT_FALSE(import_scene(write("scene.obj", text), diagnostics_, kWithoutFloor));
    EXPECT_EQ(diagnostics_.error_count(), 1u);
    return diagnostics_.format_all();
  }
  std::string said() const { return diagnostics_.format_all(); }

  static std::vector<double> numbers(const Directive& d, std::string_view name) {
    const Parameter* p = d.find(name);
    return p ? p->numbers : std::vector<double>{};
  }
  // The positions of the corners of all triangles, in their order.
  static std::vector<double> corners(const ShapeDescription& shape, std::string_view of = "P",
                                     size_t size = 3) {
    std::vector<double> out;
    const std::vector<double> values = numbers(shape, of);
    for (const double index : numbers(shape, "indices"))
      for (size_t k = 0; k < size; ++k) out.push_back(values.at(size * size_t(index) + k));
    return out;
  }
};

}  // namespace kaustik::pbrt
