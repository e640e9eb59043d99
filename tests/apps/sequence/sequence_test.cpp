// Tests sequences from the outside: which frames are rendered does not change them, photons stay where they
// are while the camera moves, and a sequence that was stopped goes on.

#include <gmock/gmock.h>

#include <cmath>
#include <regex>
#include <thread>

#include "render/picture/image_io.h"
#include "tests/apps/support/child_process.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using test::Outcome;
using test::run_kaustik;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Arguments = std::vector<std::string>;

class Sequences : public test::ProgramTest {
 protected:
  Arguments command(const std::string& scene, const Arguments& more) const {
    Arguments all = {"render", scene};
    all.insert(all.end(), more.begin(), more.end());
    all.insert(all.end(), {"--spp", "2", "--photons", "10k"});
    return all;
  }
  Outcome render(const std::string& scene, const Arguments& more) const {
    return run_kaustik(command(scene, more));
  }
  void expect_done(const Outcome& outcome) const { EXPECT_EQ(outcome.code, kDone) << outcome.err; }
  void expect_refused(const Arguments& more, const std::string& text) const {
    const Outcome outcome = render(scene_, more);
    EXPECT_EQ(outcome.code, kBadCommandLine);
    EXPECT_THAT(outcome.err, HasSubstr(text));
  }
  Arguments along(const std::string& files, const Arguments& more = {}) const {
    Arguments all = {"--camera-path", path_, "-o", path(files)};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  // Mean of the squared differences between a picture and another that is shifted by `pixels`.
  static double mean_square(const render::Image& a, const render::Image& b, int pixels) {
    double sum = 0;
    int count = 0;
    for (int y = 0; y < a.height; ++y)
      for (int x = std::max(0, pixels); x < std::min(a.width, a.width + pixels); ++x, ++count)
        sum += std::pow(double(a.at(x, y).g) - double(b.at(x - pixels, y).g), 2);
    return sum / count;
  }

  // A floor under a point light, seen from above. The first animation of the file moves the node with this
  // index, within half a second, 1 m along x: 0 is the camera, 1 the floor.
  std::string animated_file(int node) const {
    std::ofstream bin(path("data.bin"), std::ios::binary);
    const auto put = [&](std::initializer_list<float> values) {
      for (const float v : values) bin.write(reinterpret_cast<const char*>(&v), sizeof v);
    };
    put({-2, 0, -2, -2, 0, 2, 2, 0, 2, -2, 0, -2, 2, 0, 2, 2, 0, -2});  // 72 bytes
    put({0, 0.5f});                                                     // at 72
    const float height = node == 0 ? 4 : 0;
    put({0, height, 0, 1, height, 0});  // at 80
    return write("animated.gltf", R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_lights_punctual"],
      "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 3000}]}},
      "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
      "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
      "nodes": [{"camera": 0, "translation": [0, 4, 0], "rotation": [-0.70710678, 0, 0, 0.70710678]},
                {"mesh": 0}, {"translation": [0.3, 1, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
      "buffers": [{"uri": "data.bin", "byteLength": 104}],
      "bufferViews": [{"buffer": 0, "byteLength": 104}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3",
                     "min": [-2, 0, -2], "max": [2, 0, 2]},
                    {"bufferView": 0, "byteOffset": 72, "componentType": 5126, "count": 2, "type": "SCALAR"},
                    {"bufferView": 0, "byteOffset": 80, "componentType": 5126, "count": 2, "type": "VEC3"}],
      "animations": [{"samplers": [{"input": 1, "output": 2}],
        "channels": [{"sampler": 0, "target": {"node": )" +
                                      std::to_string(node) + R"(, "path": "translation"}}]}]})");
  }

  std::string scene_ = small_scene(film(24, 16));
  std::string path_ = write("path.json", R"({"keys": [
    {"frame": 0, "eye": [0, 2, 6], "target": [0, 0.5, 0], "fov": 40},
    {"frame": 4, "eye": [1, 2, 5], "target": [0, 0.5, 0], "fov": 45}]})");
};

TEST_F(Sequences, FramesDoNotDependOnWhichAreRendered) {
  expect_done(render(scene_, along("all.%02d.exr")));
  expect_done(render(scene_, along("some.%d.exr", {"--frames", "2:4", "--threads", "1"})));
  EXPECT_TRUE(read("some.2.exr") == read("all.02.exr"));
  EXPECT_TRUE(read("some.3.exr") == read("all.03.exr"));
  EXPECT_FALSE(read("all.02.exr") == read("all.03.exr"));
  EXPECT_FALSE(exists("some.1.exr"));
  EXPECT_FALSE(exists("all.05.exr"));
}

// The log names the options that show the frame's camera, which have the same bits where nothing is learned
// from the cameras of other frames.
TEST_F(Sequences, FramesAreTheRendersOfTheirCamera) {
  const Outcome outcome = render(scene_, along("f.%d.exr", {"--frames", "1:2", "--method", "raytrace"}));
  expect_done(outcome);
  std::smatch options;
  ASSERT_TRUE(std::regex_search(outcome.err, options, std::regex("frame 1 of 5: (.*)\n"))) << outcome.err;
  std::istringstream words(options[1].str());
  Arguments single(std::istream_iterator<std::string>(words), {});
  single.insert(single.end(), {"--method", "raytrace", "-o", path("single.exr")});
  expect_done(render(scene_, single));
  EXPECT_TRUE(read("single.exr") == read("f.1.exr"));
}

TEST_F(Sequences, GoOnWithMissingFrames) {
  const Arguments sequence = along("f.%d.png");
  expect_done(render(scene_, sequence));
  const std::string third = read("f.3.png");
  write("f.1.png", "kept");
  std::filesystem::remove(path("f.3.png"));
  expect_done(render(scene_, sequence));
  EXPECT_EQ(read("f.1.png"), "kept");
  EXPECT_TRUE(read("f.3.png") == third);
  EXPECT_THAT(render(scene_, sequence).err, HasSubstr("every frame exists; --overwrite renders them again"));
  expect_done(render(scene_, along("f.%d.png", {"--overwrite", "--frames", "1:2"})));
  EXPECT_NE(read("f.1.png"), "kept");
}

TEST_F(Sequences, ThatAreInterruptedLeaveWholeFrames) {
  const Arguments sequence = along("f.%d.exr", {"--width", "160", "--spp", "64", "-q"});
  {
    test::ChildProcess child(command(scene_, sequence));
    while (child.running() && !exists("f.0.exr")) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    child.kill(SIGINT);
    const int code = child.wait();
    EXPECT_TRUE(code == kInterrupted || code == kDone) << code;
  }
  expect_done(render(scene_, sequence));
  expect_done(render(scene_, along("whole.%d.exr", {"--width", "160", "--spp", "64", "-q"})));
  for (int frame = 0; frame < 5; ++frame)
    EXPECT_TRUE(read("f." + std::to_string(frame) + ".exr") ==
                read("whole." + std::to_string(frame) + ".exr"));
}

TEST_F(Sequences, ShareTheirExposure) {
  const Outcome outcome = render(scene_, along("f.%d.png"));
  expect_done(outcome);
  const std::string exposure = test::logged_exposure(outcome.err);
  expect_done(render(scene_, along("g.%d.png", {"--exposure", exposure})));
  for (const char* frame : {"0.png", "4.png"})
    EXPECT_TRUE(read(std::string("f.") + frame) == read(std::string("g.") + frame));
}

TEST_F(Sequences, TakeAndKeepMaps) {
  expect_done(render(scene_, along("own.%d.exr", {"--save-map", path("a.kmap")})));
  expect_done(render(scene_, along("kept.%d.exr", {"--map", path("a.kmap"), "--frames", "3:5"})));
  EXPECT_THAT(render(scene_, {"--map", path("a.kmap"), "-o", path("one.exr")}).err,
              HasSubstr("was shot for another camera"));
  EXPECT_TRUE(read("kept.3.exr") == read("own.3.exr"));
  EXPECT_TRUE(read("kept.4.exr") == read("own.4.exr"));
}

// A floor is seen from straight above by parallel rays; from one frame to the next the camera moves by two
// pixels. The light of the photon maps at a place of the floor is then the same but for the places of samples
// within a pixel, about which discs lie whose radius follows from sixteen rays, while other photons give
// another noise.
TEST_F(Sequences, PhotonsDoNotFlicker) {
  const std::string scene = write("floor.pbrt", R"(LookAt 0 3 0  0 0 0  0 0 1
Camera "orthographic" "float screenwindow" [-0.5 0.5 -0.5 0.5]
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
WorldBegin
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [10 10 10]
  Translate 0 4 0
  Rotate 90 1 0 0
  Shape "disk" "float radius" 0.5
AttributeEnd
Material "diffuse" "rgb reflectance" [0.8 0.8 0.8]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-3 0 3  3 0 3  3 0 -3  -3 0 -3]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [2 0 3  2 3 3  2 3 -3  2 0 -3]
Material "dielectric"
Translate 0 1.2 0
Shape "sphere" "float radius" 0.3
)");
  write("slide.json", R"({"interpolation": "linear", "keys": [
    {"frame": 0, "eye": [0, 3, 0], "target": [0, 0, 0], "up": [0, 0, 1]},
    {"frame": 1, "eye": [0.0625, 3, 0], "target": [0.0625, 0, 0], "up": [0, 0, 1]}]})");
  const auto sequence = [&](const std::string& files, const std::string& seed) {
    expect_done(run_kaustik({"render", scene, "--camera-path", path("slide.json"), "-o", path(files),
                             "--method", "photon", "--direct", "shadow-rays", "--spp", "64", "--photons",
                             "100k", "--seed", seed, "--aov", "indirect,caustic"}));
  };
  sequence("a.%d.exr", "0");
  sequence("b.%d.exr", "1");
  for (const std::string layer : {"indirect", "caustic"}) {
    const auto image = [&](const std::string& name) { return render::read_layer(path(name), layer); };
    const render::Image first = image("a.0.exr"), moved = image("a.1.exr"), other = image("b.0.exr");
    const double from_frame = std::min(mean_square(first, moved, 2), mean_square(first, moved, -2));
    const double from_photons = mean_square(first, other, 0);
    EXPECT_GT(from_photons, 0);
    EXPECT_LT(from_frame, 0.25 * from_photons) << layer;
  }
}

TEST_F(Sequences, AnimatedCamerasMoveInAWorldThatStandsStill) {
  const std::string file = animated_file(0);
  const Outcome outcome =
      render(file, {"-o", path("f.%d.exr"), "--frames", "0:13", "--width", "16", "--method", "raytrace"});
  expect_done(outcome);
  expect_done(
      render(file, {"-o", path("single.exr"), "--frame", "7", "--width", "16", "--method", "raytrace"}));
  EXPECT_TRUE(read("single.exr") == read("f.7.exr"));
  EXPECT_FALSE(read("f.0.exr") == read("f.7.exr"));
  EXPECT_THAT(render(file, {"-o", path("f.%d.exr"), "--frames", "0:14"}).err,
              HasSubstr("--frames 0:14: the sequence has frames 0:13"));
}

TEST_F(Sequences, ObjectsMove) {
  const std::string file = animated_file(1);
  const Arguments settings = {"--width", "16", "--method", "photon"};
  Arguments sequence = {"-o", path("f.%d.exr"), "--frames", "6:8"},
            single = {"-o", path("single.exr"), "--frame", "7"};
  sequence.insert(sequence.end(), settings.begin(), settings.end());
  single.insert(single.end(), settings.begin(), settings.end());
  expect_done(render(file, sequence));
  expect_done(render(file, single));
  EXPECT_TRUE(read("single.exr") == read("f.7.exr"));
  EXPECT_FALSE(read("f.6.exr") == read("f.7.exr"));
  sequence.insert(sequence.end(), {"--save-map", path("a.kmap")});
  EXPECT_THAT(render(file, sequence).err, HasSubstr("whose shapes or lights move"));
}

TEST_F(Sequences, WithoutMeaningAreRefused) {
  expect_refused({"--frames", "0:4", "-o", path("f.%d.exr")}, "--frames needs --camera-path");
  expect_refused({"--frames", "4:0", "-o", path("f.%d.exr")}, "expected frames BEGIN:END");
  expect_refused({"--camera-path", path_}, "a sequence needs -o with a pattern");
  expect_refused(along("f.exr"), "expected one %d or %04d");
  expect_refused(along("f.%d.tiff"), "f.0.tiff");
  expect_refused(along("none/f.%d.exr"), "there is no folder");
  expect_refused(along("f.%d.exr", {"--time", "3s"}), "cannot be combined with a sequence");
  expect_refused(along("f.%d.exr", {"--checkpoint", path("a.kpart")}),
                 "cannot be combined with --checkpoint");
  expect_refused(along("f.%d.kpart"), "cannot be partial results");
  expect_refused(along("f.%d.exr", {"-o", path("f.%01d.exr")}), "-o");
  expect_refused({"--overwrite", "-o", path("f.exr")}, "--overwrite needs --camera-path");
  expect_refused({"--camera-path", path("none.json"), "-o", path("f.%d.exr")}, "cannot read the camera path");
  EXPECT_THAT(files(), ElementsAre("path.json", "small.pbrt"));
}

}  // namespace
}  // namespace kaustik::app
