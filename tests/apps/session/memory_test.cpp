// `--memory`: renders keep to it, in as many passes as that takes, or say what takes most of it.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "apps/machine/peak_memory.h"
#include "apps/machine/usable_memory.h"
#include "tests/apps/support/program.h"
#include "tests/support/sanitized.h"

namespace kaustik::app {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::string kScene = KAUSTIK_SCENES_DIR "/cornell-spheres/square-lamp-2.pbrt";
constexpr uint64_t kMegabyte = 1'000'000;

class Memory : public test::ProgramTest {
 protected:
  // Renders the scene with this much more memory than the process has now.
  test::Outcome render(uint64_t megabytes, std::vector<std::string> options) const {
    restart_peak_memory();
    const uint64_t bytes = held_memory() + megabytes * kMegabyte;
    options.insert(options.begin(), {"render", kScene, "--spp", "1", "--memory", std::to_string(bytes), "-o",
                                     path("a.exr"), "--stats", path("a.json")});
    return test::run_kaustik(options);
  }
  json statistics() const { return json::parse(read("a.json")); }
};

class MeasuredMemory : public Memory {
 protected:
  void SetUp() override {
    if (test::kSanitized) GTEST_SKIP() << "a sanitizer takes memory that no forecast knows";
  }
};

TEST_F(MeasuredMemory, IsForecastAndKept) {
  const auto ran = render(400, {"--width", "200", "--photons", "1M"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const json memory = statistics()["memory"], forecast = memory["forecast_bytes"];
  EXPECT_EQ(memory["limit_by"], "--memory");
  EXPECT_LE(memory["peak_bytes"], memory["limit_bytes"]);
  EXPECT_LE(memory["peak_bytes"], forecast["total"]);
  uint64_t parts = 0;
  for (const char* part : {"scene", "bvh", "surfaces", "film", "photons", "libraries"})
    parts += forecast[part].get<uint64_t>();
  EXPECT_EQ(parts, forecast["total"]);
}

// Of 160 MB, the film, the sums and the rest take some 110; one pass of ten million photons would take over
// 500.
TEST_F(MeasuredMemory, DividesPhotonsIntoPassesThatFit) {
  const auto ran = render(160, {"--width", "200", "--photons", "10M"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const json all = statistics(), memory = all["memory"];
  EXPECT_GT(all["passes_of_settings"], 5);
  EXPECT_LE(memory["peak_bytes"], memory["limit_bytes"]);
}

// A checkpoint keeps the sums of a single pass, too.
TEST_F(MeasuredMemory, SumsOfOnePassAreCounted) {
  for (const uint64_t megabytes : {280, 500}) {  // several passes, and one
    const auto ran = render(
        megabytes, {"--width", "400", "--height", "400", "--photons", "2M", "--checkpoint", path("c.kpart")});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const json memory = statistics()["memory"];
    EXPECT_LE(memory["peak_bytes"], memory["limit_bytes"]);
  }
}

// Each thread takes its buffers, but a small picture fits whatever their number.
TEST_F(Memory, ManyThreadsOfASmallPictureFit) {
  const auto ran = render(120, {"--width", "64", "--photons", "10k", "--threads", "64"});
  EXPECT_EQ(ran.code, 0) << ran.err;
}

// The image of a light is refused by its size, too.
TEST_F(Memory, ImagesOfLightsMustFit) {
  std::ofstream(path("sky.pfm")) << "PF\n4096 4096\n-1.0\n";
  std::filesystem::resize_file(path("sky.pfm"), 20 + 4096 * 4096 * 12);
  const std::string scene =
      write("scene.pbrt",
            "WorldBegin\nLightSource \"infinite\" \"string filename\" \"sky.pfm\"\nShape \"sphere\"\n");
  EXPECT_EQ(test::run_kaustik({"render", scene, "--memory", "500M", "-o", path("a.exr")}).code, 3);
}

TEST_F(Memory, TooLargeAFilmIsNamedBeforeTheRender) {
  const auto ran = render(1000, {"--width", "16384", "--height", "16384"});
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.err, HasSubstr("--memory allows"));
  EXPECT_THAT(ran.err,
              HasSubstr("the film, whose picture has 16384 x 16384 pixels: render a smaller picture"));
  EXPECT_FALSE(exists("a.exr"));
  EXPECT_FALSE(exists("a.json"));
}

// A part of the same picture fits.
TEST_F(Memory, ACropNeedsItsOwnFilmAlone) {
  const auto ran = render(
      200, {"--width", "16384", "--height", "16384", "--crop", "0", "64", "0", "64", "--photons", "10k"});
  EXPECT_EQ(ran.code, 0) << ran.err;
}

// The photons of a kept map stay in their file: their memory is not the render's.
TEST_F(Memory, KeptPhotonsTakeNone) {
  const std::vector<std::string> photons = {"--width", "64", "--photons", "1M"};
  std::vector<std::string> shoot = {"shoot", kScene, "-o", path("a.kmap")};
  shoot.insert(shoot.end(), photons.begin(), photons.end());
  ASSERT_EQ(test::run_kaustik(shoot).code, 0);
  ASSERT_EQ(render(400, photons).code, 0);
  const json forecast = statistics()["memory"]["forecast_bytes"];
  ASSERT_GT(forecast["photons"], 20 * kMegabyte);
  const uint64_t others = uint64_t(forecast["total"]) - uint64_t(forecast["photons"]);
  const uint64_t megabytes = (others - uint64_t(forecast["scene"])) / kMegabyte + 10;
  ASSERT_EQ(render(megabytes, photons).code, 0);
  EXPECT_GT(statistics()["passes_of_settings"], 1);  // not all at once
  const auto kept = render(megabytes, {"--width", "64", "--map", path("a.kmap")});
  ASSERT_EQ(kept.code, 0) << kept.err;
  EXPECT_EQ(statistics()["passes_of_settings"], 1);
}

// A file that does not fit beside what is made of it is refused where the scene names it, before it is read.
TEST_F(Memory, FilesAreRefusedBeforeTheyAreRead) {
  std::ofstream(path("large.ply")) << "ply\n";
  std::filesystem::resize_file(path("large.ply"), 300 * kMegabyte);
  const std::string scene =
      write("scene.pbrt",
            "Camera \"perspective\"\nWorldBegin\nShape \"plymesh\" \"string filename\" \"large.ply\"\n");
  const auto ran = test::run_kaustik({"render", scene, "--memory", "500M", "-o", path("a.exr")});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, HasSubstr("scene.pbrt:3:"));
  EXPECT_THAT(ran.err, HasSubstr("it needs about 600 MB of memory, but --memory leaves"));
}

// Only a description is wanted, which needs no film.
TEST_F(Memory, InfoNeedsNoFilm) {
  const std::string text =
      "Film \"rgb\" \"integer xresolution\" 60000 \"integer yresolution\" 60000\n"
      "Camera \"perspective\"\nWorldBegin\nLightSource \"point\"\nShape \"sphere\"\n";
  EXPECT_EQ(test::run_kaustik({"info", write("large.pbrt", text)}).code, 0);
}

}  // namespace
}  // namespace kaustik::app
