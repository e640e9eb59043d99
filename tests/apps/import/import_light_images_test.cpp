// Tests the images of lights: they are found beside the scene, checked, and refused with their location.
#include "render/picture/image_io.h"
#include "tests/apps/import/import_support.h"

namespace kaustik::pbrt {
namespace {

class ImportLightImages : public ImportTest {
 protected:
  void write_exr(const std::string& name, int width, int height, const Rgb& colour, const Rgb& last) {
    render::Image image(width, height, colour);
    image.at(width - 1, height - 1) = last;
    render::write_image((folder_ / name).string(), image);
  }
  void write_exr(const std::string& name, int width, int height, const Rgb& colour) {
    write_exr(name, width, height, colour, colour);
  }
};

// These numbers are exact as half floats and as floats.
TEST_F(ImportLightImages, MapsBecomeLights) {
  write_exr("square.exr", 4, 4, {1, 2, 3});
  write_exr("wide.exr", 8, 4, {1, 2, 3});
  write("sub/light.pbrt", R"(LightSource "projection" "string filename" "square.exr" "float power" 5)");
  const Scene s = world(R"(LightSource "infinite" "string filename" "square.exr" "float scale" 2
    LightSource "infinite" "string filename" "wide.exr" "float illuminance" 7
    LightSource "goniometric" "string filename" "square.exr" "rgb I" [1 1 2] "float power" 3
    LightSource "infinite" "rgb L" [1 2 3] "point3 portal" [0 0 0  0 1 0  1 1 0  1 0 0]
    Include "sub/light.pbrt" Shape "sphere")");
  ASSERT_EQ(s.lights.size(), 5u);
  EXPECT_EQ(std::get<ImageInfiniteLight>(s.lights[0]).Le({{0, 0, 0}, {0, 0, 1}}), Rgb(2, 4, 6));
  const Rgb scaled = std::get<ImageInfiniteLight>(s.lights[1]).Le({{0, 0, 0}, {0, 0, 1}});
  EXPECT_NEAR(luminance(scaled) * kPi, 7, 0.02);  // the map's integral: direction_map_test.cpp
  EXPECT_NEAR(luminance(power(s.lights[2])), 3 * luminance({1, 1, 2}), 4e-6);
  EXPECT_EQ(std::get<GoniometricLight>(s.lights[2]).map->mean(), Rgb(2));  // mean of the three channels
  // From below the rectangle the sky is towards cross(p3 - p0, p1 - p0) = +z.
  const auto& portal = std::get<PortalInfiniteLight>(s.lights[3]);
  EXPECT_EQ(portal.Le({{0.5f, 0.5f, -1}, {0, 0, 1}}), Rgb(1, 2, 3));
  EXPECT_EQ(portal.Le({{0.5f, 0.5f, 1}, {0, 0, -1}}), Rgb(0));
  EXPECT_NEAR(luminance(power(s.lights[4])), 5, 5e-6);
  EXPECT_EQ(diagnostics_.warning_count(), 1u);  // about the latitude-longitude map
}

// In pbrt-v3 `L` and `scale` multiply the image.
TEST_F(ImportLightImages, ImagesOfTheSkyAreScaledByL) {
  write_exr("square.exr", 4, 4, {1, 2, 3});
  const Scene s =
      world(R"(LightSource "infinite" "string mapname" "square.exr" "rgb L" [2 1 .5] "rgb scale" [2 2 2]
    AreaLightSource "diffuse" "string filename" "square.exr" "rgb L" [2 1 .5] Shape "sphere")");
  EXPECT_EQ(std::get<ImageInfiniteLight>(s.lights[0]).Le({{0, 0, 0}, {0, 0, 1}}), Rgb(4, 4, 3));
  EXPECT_EQ(std::get<DiffuseAreaLight>(s.lights[1]).L, Rgb(2, 1, .5f));
}

// `power` uses the mean of all pixels as the emitted colour, as pbrt does, and `scale` multiplies it.
TEST_F(ImportLightImages, AreaLightsShowImages) {
  write_exr("oblong.exr", 3, 1, {1, 2, 3}, {4, 5, 12});
  const Scene s = world(R"(AreaLightSource "diffuse" "string filename" "oblong.exr" "float scale" 2
    Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 1 1 0]
    AreaLightSource "diffuse" "string filename" "oblong.exr" "float power" 5 "bool twosided" true
    Shape "disk"
    AreaLightSource "diffuse" "rgb L" [1 2 3] Shape "sphere" "float alpha" 0
    Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 1 1 0] "float alpha" 0.5)");
  ASSERT_EQ(s.lights.size(), 4u);
  const auto light = [&](size_t i) { return std::get<DiffuseAreaLight>(s.lights[i]); };
  EXPECT_EQ(light(0).image->value({0.1f, 0.5f}), Rgb(1, 2, 3));
  EXPECT_EQ(light(0).image->mean_of_pixels(), Rgb(2, 3, 6));
  EXPECT_EQ(light(0).L, Rgb(2));
  EXPECT_NEAR(luminance(light(1).flux_of(light(1).area, light(1).L * Rgb(2, 3, 6))), 5, 1e-5);
  EXPECT_TRUE(light(2).invisible && is_delta(s.lights[2]) && !light(2).image && !light(2).alpha);
  EXPECT_TRUE(!light(3).invisible && light(3).alpha->constant == 0.5f);
  EXPECT_EQ(diagnostics_.warning_count(), 0u);
}

TEST_F(ImportLightImages, BadImagesOfAreaLightsAreRefused) {
  write_exr("dark.exr", 2, 2, Rgb(0));
  const auto said = [&](const std::string& parameters) {
    const std::string all = first_lines("AreaLightSource \"diffuse\" " + parameters + " Shape \"sphere\"");
    EXPECT_FALSE(loaded_) << parameters;
    return all;
  };
  EXPECT_NE(said("\"string filename\" \"missing.exr\"").find("no such file"), std::string::npos);
  EXPECT_NE(said("\"string filename\" \"dark.exr\" \"float power\" 3").find("a light that emits nothing"),
            std::string::npos);
  EXPECT_NE(said("\"string filename\" \"dark.exr\" \"float scale\" -3").find("`scale`"), std::string::npos);
}

TEST_F(ImportLightImages, MapsOfOtherShapesAreLatitudesAndLongitudes) {
  write_exr("oblong.exr", 6, 4, Rgb(1));
  EXPECT_EQ(first_lines("LightSource \"infinite\" \"string filename\" \"oblong.exr\" Shape \"sphere\""),
            "2:42: warning: \"oblong.exr\" is read as a latitude-longitude map with +z at the top although "
            "it has 6 x "
            "4 pixels; pbrt-v4 takes only square equal-area maps\n");
  EXPECT_TRUE(loaded_);
}

TEST_F(ImportLightImages, BadImagesAreRefusedWithTheirLocation) {
  write_exr("infinite.exr", 4, 4, Rgb(1), {1, std::numeric_limits<float>::infinity(), 1});
  write_exr("nan.exr", 4, 4, Rgb(1), Rgb(std::nanf("")));
  write("broken.exr", "not an image at all");
  write("cut.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16 +X 16\n\x01");
  write("huge.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n");
  const auto said = [&](const std::string& file) {
    const std::string all = first_lines("LightSource \"infinite\" \"string filename\" \"" + file + "\"");
    EXPECT_FALSE(loaded_) << file;
    EXPECT_EQ(all.rfind("2:42: error: ", 0), 0u) << all;
    return all;
  };
  EXPECT_NE(said("infinite.exr").find("pixel (3, 3), 1 inf 1, is not finite"), std::string::npos);
  EXPECT_NE(said("nan.exr").find("is not finite"), std::string::npos);
  EXPECT_NE(said("missing.exr").find("no such file"), std::string::npos);
  EXPECT_NE(said("huge.hdr").find("60000 x 60000 pixels are too large"), std::string::npos);
  said("broken.exr");
  said("cut.hdr");
}

TEST_F(ImportLightImages, NegativePixelsCountAsZero) {
  write_exr("negative.exr", 4, 4, Rgb(1), {-1, 2, 3});
  EXPECT_EQ(first_lines("LightSource \"infinite\" \"string filename\" \"negative.exr\" Shape \"sphere\""),
            "2:42: warning: \"negative.exr\": 1 negative pixel taken as zero; the first is pixel (3, 3), "
            "-1 2 3\n");
  EXPECT_TRUE(loaded_);
}

// A changed image changes the scene's hash.
TEST_F(ImportLightImages, ContentsAreHashed) {
  const std::string scene =
      "WorldBegin LightSource \"infinite\" \"string filename\" \"sky.exr\" Shape \"sphere\"";
  write_exr("sky.exr", 4, 4, Rgb(1));
  const std::string one = load(scene).content_hash;
  EXPECT_EQ(load(scene).content_hash, one);
  write_exr("sky.exr", 4, 4, Rgb(2));
  EXPECT_NE(load(scene).content_hash, one);
}

}  // namespace
}  // namespace kaustik::pbrt
