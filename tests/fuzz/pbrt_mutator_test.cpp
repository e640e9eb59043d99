// Compares the mutator of pbrt scenes with changes of bytes: how many mutants are free of syntax errors, so
// that all of their values reach what reads them.

#include "tests/fuzz/mutator/pbrt_mutator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/import/import_scene.h"
#include "tests/fuzz/input_folder.h"
#include "tests/fuzz/mutator/pbrt_text.h"
#include "tests/support/random.h"

namespace kaustik::fuzz {
namespace {

const std::string kScene =
    "LookAt 0 0 -5 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" [ 40 ]\n"
    "Film \"rgb\" \"integer xresolution\" [ 8 ] \"integer yresolution\" [ 8 ]\nWorldBegin\n"
    "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [ 1 1 1 ]\nTranslate 0 3 0\n"
    "Shape \"disk\" \"float radius\" [ 0.5 ]\nAttributeEnd\n"
    "Texture \"t\" \"spectrum\" \"checkerboard\" \"float uscale\" [ 4 ]\n"
    "Material \"diffuse\" \"texture reflectance\" [ \"t\" ]\n"
    "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"integer indices\" [ 0 1 2 ]\n"
    "Material \"coateddiffuse\" \"float roughness\" [ 0.1 ]\nShape \"sphere\" \"float radius\" [ 2 ]\n";

// One to four changes of bytes, as fuzzers that know no format make them: another byte, one more, a few less,
// or a copy of a part at another place.
std::string change_bytes(std::string text, uint64_t seed) {
  test::Random random(seed);
  const auto below = [&](size_t n) { return n == 0 ? 0 : random.bits() % n; };
  for (size_t changes = 1 + below(4); changes > 0; --changes) {
    const size_t at = below(text.size());
    switch (below(4)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.insert(at, 1, static_cast<char>(below(256)));
        break;
      case 2:
        text.erase(at, 1 + below(8));
        break;
      default:
        text.insert(at, std::string(text.substr(below(text.size()), 1 + below(16))));
    }
  }
  return text;
}

bool is_syntax(const std::string& text) {
  Diagnostics diagnostics;
  pbrt::import_scene(input_file("mutant.pbrt", text), diagnostics);
  return !diagnostics.has_errors();
}

TEST(PbrtMutator, TakesTextsApartAndPutsThemTogether) {
  EXPECT_EQ(put_together(take_apart(kScene)), kScene);
  EXPECT_EQ(put_together(take_apart("# a comment\n3 Shape\"sphere\" \"float radius\"2 \"bool b\"true")),
            "3\nShape \"sphere\" \"float radius\" [ 2 ] \"bool b\" [ true ]\n");
}

TEST(PbrtMutator, DependsOnTextAndSeedOnly) {
  size_t changed = 0;
  for (uint32_t seed = 0; seed < 100; ++seed) {
    const std::string mutant = mutate_pbrt(kScene, 1 << 16, seed);
    EXPECT_EQ(mutant, mutate_pbrt(kScene, 1 << 16, seed));
    changed += mutant != kScene ? 1 : 0;
    EXPECT_LE(mutate_pbrt("", 50, seed).size(), 50u);
    EXPECT_LE(mutate_pbrt(kScene, 50, seed).size(), 50u);
    EXPECT_LE(splice_pbrt(kScene, kScene, 50, seed).size(), 50u);
  }
  // Each seed draws a change that is none (such as a swap with itself) in less than half of the cases; with
  // probability 1/2, 30 or fewer of 100 would change in 4e-5 of all runs.
  EXPECT_GT(changed, 30u);
}

TEST(PbrtMutator, KeepsTheSyntaxMoreOftenThanChangesOfBytes) {
  constexpr int kMutants = 1000;
  int blind = 0, aware = 0;
  for (uint32_t seed = 0; seed < kMutants; ++seed) {
    blind += is_syntax(change_bytes(kScene, seed)) ? 1 : 0;
    aware += is_syntax(mutate_pbrt(kScene, 1 << 16, seed)) ? 1 : 0;
  }
  RecordProperty("blind", blind);
  RecordProperty("aware", aware);
  // The difference of two shares of n mutants each has a standard deviation of at most sqrt(1 / (2 n)).
  EXPECT_GT(double(aware - blind) / kMutants, 5 * std::sqrt(0.5 / kMutants));
}

}  // namespace
}  // namespace kaustik::fuzz
