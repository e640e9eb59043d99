// Tests kaustik render, photons and info from the outside: files, reports, interruption.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "render/picture/image_formats.h"
#include "render/picture/image_io.h"
#include "tests/apps/support/program.h"
#include "tests/apps/support/watching.h"

namespace kaustik::app {
namespace {

using test::count_threads;
using test::logged_exposure;
using test::Outcome;
using test::run_kaustik;
using test::ThreadCounts;
using test::wait_until_handled;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class RenderCommand : public test::ProgramTest {
 protected:
  nlohmann::json stats(const std::string& name) const { return nlohmann::json::parse(read(name)); }
};

TEST_F(RenderCommand, WritesAndReportsEveryFile) {
  const Outcome outcome =
      run_kaustik({"render", small_scene(film(24, 16)), "-o", path("a.exr"), "-o", path("a.png"), "--photons",
                   "10k", "--guide", "off", "--spp", "2", "--aov", "all", "--stats", path("a.json")});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_THAT(files(), ElementsAre("a.exr", "a.json", "a.png", "small.pbrt"));
  for (const char* expected : {"a.exr", "a.png", "a.json", "10,000 emitted", "photon trace", "total"}) {
    EXPECT_THAT(outcome.err, HasSubstr(expected));
  }
  const render::Image image = render::read_image(path("a.exr"));
  EXPECT_EQ(image.width, 24);
  EXPECT_EQ(image.height, 16);
}

TEST_F(RenderCommand, LogsAnExposureThatRepeatsThePicture) {
  const auto render = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render",    small_scene(film(24, 16)),
                                          "-o",        path(name + ".png"),
                                          "-o",        path(name + ".exr"),
                                          "--photons", "5k",
                                          "--spp",     "2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run_kaustik(arguments);
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return outcome.err;
  };
  const std::string exposure = logged_exposure(render("a", {}));
  EXPECT_THAT(render("b", {"--exposure", exposure}), Not(HasSubstr("exposure:")));
  EXPECT_EQ(read("a.png"), read("b.png"));
  EXPECT_EQ(logged_exposure(render("c", {"--exposure", "auto"})), exposure);
  render("d", {"--exposure", std::to_string(std::stod(exposure) + 1)});
  EXPECT_NE(read("a.png"), read("d.png"));
  EXPECT_EQ(read("a.exr"), read("d.exr")) << "EXR files keep the radiance";
  EXPECT_NE(logged_exposure(render("e", {"--tonemap", "srgb"})), exposure) << "grey depends on the operator";
  render("f", {"--stats", path("f.json")});
  EXPECT_NEAR(stats("f.json")["settings"]["exposure"].get<double>(), std::stod(exposure), 1e-5);
  EXPECT_EQ(stats("f.json")["settings"]["tonemap"], "filmic");
}

TEST_F(RenderCommand, WarnsOfLayersThatNoFileHolds) {
  const auto log_of = [&](const std::vector<std::string>& files) {
    std::vector<std::string> arguments = {"render", small_scene(film(8, 8)), "--photons", "1k", "--spp", "1",
                                          "--aov",  "depth,normal",          "-q"};
    for (const std::string& file : files) arguments.insert(arguments.end(), {"-o", path(file)});
    return run_kaustik(arguments).err;
  };
  EXPECT_THAT(log_of({"a.png"}), HasSubstr("no file holds the layers depth, normal"));
  EXPECT_EQ(log_of({"a.png", "a.exr"}), "");
  EXPECT_EQ(log_of({"a.kpart"}), "");
}

TEST_F(RenderCommand, StatisticsHaveTheDocumentedKeys) {
  ASSERT_EQ(run_kaustik({"render", small_scene(film(16, 16)), "-o", path("a.exr"), "--photons", "5k", "--spp",
                         "1", "--method", "photon", "--stats", path("a.json"), "--quiet"})
                .code,
            kDone);
  const nlohmann::json json = stats("a.json");
  EXPECT_EQ(json["photons"]["emitted"], 5000);
  for (const char* kind : {"direct", "shadow", "caustic", "indirect"}) {
    EXPECT_TRUE(json["photons"]["stored"].contains(kind)) << kind;
  }
  EXPECT_GT(json["photons"]["stored"]["caustic"], 0);
  for (const char* phase : {"load", "bvh", "photon_trace", "photon_build", "render", "write", "total"}) {
    EXPECT_TRUE(json["seconds"][phase].is_number()) << phase;
  }
  EXPECT_GE(json["seconds"]["total"], json["seconds"]["render"]);
  EXPECT_GT(json["radius"], 0);
  EXPECT_GT(json["peak_memory_bytes"], 0);
  EXPECT_TRUE(json["needs"]["specular"]);
  EXPECT_EQ(json["settings"]["spp"], 1);
}

TEST_F(RenderCommand, QuietPrintsNothing) {
  const Outcome outcome = run_kaustik(
      {"render", small_scene(film(8, 8)), "-o", path("a.exr"), "--photons", "1k", "--spp", "1", "--quiet"});
  EXPECT_EQ(outcome.code, kDone);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out, "");
}

TEST_F(RenderCommand, CommandLineOverridesFileAndFileOverridesDefaults) {
  const std::string scene =
      small_scene(film(10, 20) +
                  "\nSampler \"halton\" \"integer pixelsamples\" 3"
                  "\nIntegrator \"photonmap\" \"integer photons\" 2000 \"string direct\" "
                  "\"photons\" \"string kernel\" \"cone\"");
  ASSERT_EQ(run_kaustik({"render", scene, "-o", path("file.exr"), "--stats", path("file.json"), "-q"}).code,
            kDone);
  const nlohmann::json file = stats("file.json")["settings"];
  EXPECT_EQ(file["spp"], 3);
  EXPECT_EQ(file["photons"], 2000);
  EXPECT_EQ(file["direct"], "photons");
  EXPECT_EQ(file["kernel"], "cone");
  ASSERT_EQ(run_kaustik({"render", scene, "-o", path("line.exr"), "--stats", path("line.json"), "-q", "--spp",
                         "1", "--kernel", "epanechnikov", "--width", "5"})
                .code,
            kDone);
  const nlohmann::json line = stats("line.json");
  EXPECT_EQ(line["settings"]["spp"], 1);
  EXPECT_EQ(line["settings"]["kernel"], "epanechnikov");
  EXPECT_EQ(line["settings"]["photons"], 2000);
  EXPECT_EQ(line["width"], 5);
  EXPECT_EQ(line["height"], 10);  // keeps the aspect ratio
}

// --method on the command line replaces all estimators, including those that the file chose.
TEST_F(RenderCommand, MethodOfTheCommandLineReplacesTheFilesEstimators) {
  const std::string scene = small_scene(film(8, 8) + "\nIntegrator \"sppm\"");
  ASSERT_EQ(run_kaustik({"render", scene, "-o", path("a.exr"), "--stats", path("a.json"), "-q", "--spp", "1",
                         "--method", "mc"})
                .code,
            kDone);
  const nlohmann::json settings = stats("a.json")["settings"];
  EXPECT_EQ(settings["direct"], "shadow-rays");
  EXPECT_EQ(settings["caustics"], "paths");
  EXPECT_EQ(settings["indirect"], "paths");
}

TEST_F(RenderCommand, FilmFilenameIsTheDefaultOutput) {
  const std::string name = path("from-the-film.exr");
  const std::string scene = small_scene(film(8, 8) + " \"string filename\" \"" + name + "\"");
  ASSERT_EQ(run_kaustik({"render", scene, "--spp", "1", "--photons", "1k", "-q"}).code, kDone);
  EXPECT_TRUE(exists("from-the-film.exr"));
}

TEST_F(RenderCommand, FilesAreTheSameBytesForAnyNumberOfThreads) {
  const std::string scene = small_scene(film(32, 24));
  std::string first;
  for (const char* threads : {"1", "2", "3", "8"}) {
    const std::string name = std::string("t") + threads + ".exr";
    ASSERT_EQ(run_kaustik({"render", scene, "-o", path(name), "--photons", "20k", "--spp", "2", "--aov",
                           "all", "-q", "--threads", threads})
                  .code,
              kDone);
    const std::string bytes = read(name);
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes.size(), first.size());
    EXPECT_TRUE(bytes == first) << threads << " threads";
  }
}

TEST_F(RenderCommand, CropOutsideTheImageExitsWithTwo) {
  const Outcome outcome =
      run_kaustik({"render", small_scene(film(8, 8)), "-o", path("a.exr"), "--crop", "0", "9", "0", "4"});
  EXPECT_EQ(outcome.code, kBadCommandLine);
  EXPECT_THAT(outcome.err, HasSubstr("8 x 8"));
}

// When the folder disappears during the render the exit code is 1 and nothing is written.
TEST_F(RenderCommand, FailureWhileWritingExitsWithOne) {
  std::filesystem::create_directories(path("gone"));
  const std::string scene = small_scene(film(64, 64));
  std::atomic<bool> stop = false;
  std::thread remover([&] {
    wait_until_handled(SIGTERM, stop);
    std::filesystem::remove_all(path("gone"));
  });
  const Outcome outcome =
      run_kaustik({"render", scene, "-o", path("gone/a.exr"), "--photons", "200k", "--spp", "64", "-q"});
  stop = true;
  remover.join();
  EXPECT_EQ(outcome.code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("a.exr"));
  EXPECT_FALSE(exists("gone"));
}

// Before the first tile is finished there is nothing to write; partial_results_test.cpp tests later
// interrupts.
TEST_F(RenderCommand, EarlyInterruptWritesNoPictureAndExitsWith130) {
  // These are far more samples than a test could wait for: only the signal can end the render.
  const std::string scene = small_scene(film(256, 256));
  std::atomic<bool> stop = false;
  std::thread sender([&] {
    wait_until_handled(SIGINT, stop);
    if (!stop) std::raise(SIGINT);
  });
  const Outcome outcome =
      run_kaustik({"render", scene, "-o", path("a.exr"), "--photons", "1k", "--spp", "1000000", "-q"});
  stop = true;
  sender.join();
  EXPECT_EQ(outcome.code, kInterrupted);
  EXPECT_THAT(files(), ElementsAre("small.pbrt"));
}

TEST_F(RenderCommand, ThreadsBoundsEveryThreadOfTheProcess) {
  const std::string scene = small_scene(film(64, 64));
  render::image_formats();  // brings libraries with idle threads of their own
  int code = -1;
  const ThreadCounts threads = count_threads([&] {
    code = run_kaustik({"render", scene, "-o", path("a.exr"), "-o", path("a.png"), "--photons", "50k",
                        "--spp", "4", "--threads", "2", "-q"})
               .code;
  });
  EXPECT_EQ(code, kDone);
  EXPECT_LE(threads.most, threads.before + 1);
}

TEST_F(RenderCommand, PhotonsWritesACloudAndAView) {
  const Outcome outcome =
      run_kaustik({"photons", small_scene(film(48, 32)), "--photons", "20k", "-o", path("map.ply"), "--image",
                   path("view.png"), "--kinds", "direct,caustic"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_TRUE(read("map.ply").starts_with("ply\n"));
  EXPECT_THAT(outcome.err, HasSubstr("caustic"));
  EXPECT_THAT(outcome.err, ::testing::Not(HasSubstr("shadow")));
  const render::Image view = render::read_image(path("view.png"));
  EXPECT_EQ(view.width, 48);
  float brightest = 0;
  for (const Rgb& pixel : view.pixels) brightest = std::max(brightest, max_component(pixel));
  EXPECT_GT(brightest, 0.3f);  // far above the dim background, which stays below 0.06
}

// The picture's legend has a field of each colour; a picture that has no room for it has none.
TEST_F(RenderCommand, PhotonsViewsHaveALegend) {
  const auto view_of = [&](int width, const std::string& colours) {
    const Outcome outcome =
        run_kaustik({"photons", small_scene(film(width, width)), "--photons", "1k", "--image",
                     path("view.exr"), "--kinds", "direct,shadow,caustic", "--colours", colours});
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return render::read_image(path("view.exr"));
  };
  // Fields are of 7 x 7 pixels in distances of 10, the lowest 4 from the picture's lower left corner.
  const auto field = [](const render::Image& view, int from_below) {
    return view.at(4 + 3, view.height - 4 - 4 - 10 * from_below);
  };
  const render::Image kinds = view_of(160, "kind");
  EXPECT_GT(field(kinds, 0).x, field(kinds, 0).z);  // caustic: orange
  EXPECT_GT(field(kinds, 1).z, field(kinds, 1).x);  // shadow: blue
  EXPECT_GT(field(kinds, 2).y, field(kinds, 2).z);  // direct: yellow
  const render::Image light = view_of(160, "light");
  EXPECT_GT(field(light, 0).z, field(light, 0).x);
  EXPECT_EQ(field(light, 1), Rgb(1));
  EXPECT_NE(field(view_of(48, "light"), 1), Rgb(1));
  const Outcome wrong = run_kaustik({"photons", small_scene(), "--image", path("a.png"), "--colours", "red"});
  EXPECT_EQ(wrong.code, kBadCommandLine);
  EXPECT_THAT(wrong.err, HasSubstr("--colours: `red`: expected one of light, kind"));
}

TEST_F(RenderCommand, InfoCountsTheObjectsOfTheScene) {
  const Outcome outcome = run_kaustik({"info", small_scene(film(48, 32)), "--json"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  const nlohmann::json json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["image"]["width"], 48);
  EXPECT_EQ(json["lights"].size(), 1u);
  EXPECT_EQ(json["shapes"].size(), 3u);  // a mesh, a sphere and a disk
  EXPECT_TRUE(json["needs"]["specular"]);
  EXPECT_FALSE(json["needs"]["only_delta_lights"]);
  // The power is pi L A of a disk of radius 1/2 that emits on one side; the radiance is exact, the rest
  // rounds.
  const double watts = M_PI * 10 * M_PI * 0.25;
  EXPECT_NEAR(json["lights"][0]["power"][1].get<double>(), watts, 1e-5 * watts);
  const Outcome text = run_kaustik({"info", small_scene(film(48, 32))});
  EXPECT_EQ(text.code, kDone);
  EXPECT_THAT(text.out, HasSubstr("dielectric"));
}

}  // namespace
}  // namespace kaustik::app
