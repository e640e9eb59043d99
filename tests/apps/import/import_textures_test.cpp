// Tests texture directives and image files: their meaning, and the messages about bad ones.

#include <OpenImageIO/imageio.h>
#include <tbb/parallel_for.h>

#include <atomic>

#include "core/scene/bsdf_at.h"
#include "tests/apps/import/import_support.h"

namespace kaustik::pbrt {
namespace {

class ImportTextures : public ImportTest {
 protected:
  // values: rows from the top, channels interleaved.
  template <class T>
  void write_image(const std::string& name, int width, int channels, const std::vector<T>& values) const {
    const OIIO::TypeDesc type = sizeof(T) == 1 ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
    const int height = static_cast<int>(values.size()) / width / channels;
    OIIO::ImageSpec spec(width, height, channels, type);
    const std::string path = (folder_ / name).string();
    auto out = OIIO::ImageOutput::create(path);
    ASSERT_TRUE(out);
    ASSERT_TRUE(out->open(path, spec) && out->write_image(type, values.data()) && out->close());
  }

  // Writes a 2 x 2 image of one byte per pixel: 0 and 255 above, 51 and 102 below.
  void write_fields(const std::string& name = "fields.png") const {
    write_image<uint8_t>(name, 2, 1, {0, 255, 51, 102});
  }
  // The reflectance that the texture gives to a plane at (u, v).
  static Rgb colour_at(const Scene& scene, float u, float v) {
    // The triangle has the uv (0, 0), (1, 0), (1, 1).
    SurfaceInteraction si = make_interaction(scene.shapes, {}, {1, 0, 0, {u - v, v}});
    const BsdfAt bsdf(scene, si, {0, 0, 1});
    return std::get<Lambertian>(*bsdf).reflectance;
  }
  Scene with_texture(const std::string& parameters, const std::string& type = "imagemap") {
    return world("Texture \"t\" \"spectrum\" \"" + type + "\" " + parameters +
                 "\nMaterial \"diffuse\" \"texture reflectance\" \"t\" "
                 "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 1 1 0]");
  }
};

constexpr const char* kLinear = " \"string encoding\" \"linear\"";

// Interpolation is bilinear between texel centres at 1/4 and 3/4; t points up, so v = 3/4 is the upper row.
// 8-bit values are kept as half floats, which round by 2^-11 of the value.
TEST_F(ImportTextures, ImagesAreInterpolatedBetweenTexels) {
  write_fields();
  const Scene s = with_texture(std::string("\"string filename\" \"fields.png\"") + kLinear);
  EXPECT_NEAR(colour_at(s, 0.75f, 0.75f).x, 1, 1e-6f);
  EXPECT_NEAR(colour_at(s, 0.75f, 0.25f).x, 0.4f, 2e-4f);
  EXPECT_NEAR(colour_at(s, 0.5f, 0.25f).x, 0.3f, 2e-4f);
  EXPECT_EQ(colour_at(s, 0.75f, 0.25f).x, colour_at(s, 0.75f, 0.25f).z);
}

// At s = 1 the value is between the right texel and the next: the left one, zero, or the right one itself.
TEST_F(ImportTextures, WrapModesAreApplied) {
  write_fields();
  const auto at_edge = [&](const std::string& wrap) {
    const Scene s =
        with_texture("\"string filename\" \"fields.png\" \"float udelta\" 0.25 \"string wrap\" \"" + wrap +
                     "\"" + kLinear);
    return colour_at(s, 0.75f, 0.75f).x;
  };
  EXPECT_NEAR(at_edge("repeat"), 0.5f, 1e-3f);
  EXPECT_NEAR(at_edge("black"), 0.5f, 1e-3f);
  EXPECT_NEAR(at_edge("clamp"), 1, 1e-3f);
  const Scene far = with_texture(std::string("\"string filename\" \"fields.png\" \"float udelta\" 1 "
                                             "\"string wrap\" \"black\"") +
                                 kLinear);
  EXPECT_EQ(colour_at(far, 0.75f, 0.75f).x, 0);
}

// A mirrored image read at s + 1 is that at 1 - s; the images beyond follow with period 2. The other
// direction may have a mode of its own.
TEST_F(ImportTextures, ImagesAreMirrored) {
  write_fields();
  const auto with = [&](const std::string& more) {
    return with_texture("\"string filename\" \"fields.png\" " + more + kLinear);
  };
  const Scene plain = with("");
  for (const char* shift : {"1", "-1", "41"}) {
    const Scene mirrored = with(std::string("\"float udelta\" ") + shift + " \"string wrap\" \"mirror\"");
    EXPECT_EQ(colour_at(mirrored, 0.75f, 0.75f), colour_at(plain, 0.25f, 0.75f)) << shift;
    EXPECT_EQ(colour_at(mirrored, 0.25f, 0.25f), colour_at(plain, 0.75f, 0.25f)) << shift;
  }
  EXPECT_NE(colour_at(plain, 0.25f, 0.75f), colour_at(plain, 0.75f, 0.75f));
  const Scene black = with("\"float vdelta\" 1 \"string vwrap\" \"black\"");
  EXPECT_EQ(colour_at(black, 0.75f, 0.75f), Rgb(0));
  EXPECT_EQ(colour_at(with("\"float udelta\" 1 \"string vwrap\" \"black\""), 0.75f, 0.75f),
            colour_at(plain, 0.75f, 0.75f));
}

// The byte 102 = 0.4 decodes to ((0.4 + 0.055) / 1.055)^2.4 = 0.13287 (sRGB), 0.4 (linear), 0.4^2.2 = 0.13320
// (gamma).
TEST_F(ImportTextures, EncodingsAreDecoded) {
  write_fields();
  const auto decoded = [&](const std::string& encoding) {
    const std::string parameter = encoding.empty() ? "" : " \"string encoding\" \"" + encoding + "\"";
    return colour_at(with_texture("\"string filename\" \"fields.png\"" + parameter), 0.75f, 0.25f).x;
  };
  EXPECT_NEAR(decoded(""), 0.13287f, 1e-4f);
  EXPECT_NEAR(decoded("sRGB"), 0.13287f, 1e-4f);
  EXPECT_NEAR(decoded("linear"), 0.4f, 2e-4f);
  EXPECT_NEAR(decoded("gamma 2.2"), 0.13320f, 1e-4f);
}

// Float images are linear whatever the encoding; three channels are kept, and alpha is ignored.
TEST_F(ImportTextures, FloatImagesIgnoreEncodingAndAlpha) {
  write_image<float>("c.exr", 1, 4, {0.25f, 0.5f, 0.75f, 0.5f});
  const Scene s = with_texture("\"string filename\" \"c.exr\" \"string encoding\" \"sRGB\"");
  EXPECT_EQ(colour_at(s, 0.5f, 0.25f), Rgb(0.25f, 0.5f, 0.75f));
}

TEST_F(ImportTextures, ValuesStayInTheRangeOfTheParameter) {
  write_image<float>("c.exr", 1, 3, {-1, 5, std::numeric_limits<float>::quiet_NaN()});
  const Scene s = with_texture("\"string filename\" \"c.exr\"");
  EXPECT_EQ(colour_at(s, 0.5f, 0.25f), Rgb(0, 1, 0));
}

// The transform is that of the texture's definition, not that of its use.
TEST_F(ImportTextures, TextureSpaceIsTheCurrentTransform) {
  const Scene s = world(R"(
    AttributeBegin Translate 2 0 0
    Texture "t" "spectrum" "checkerboard" "integer dimension" 3 "rgb tex1" [1 0 0] "rgb tex2" [0 1 0]
    AttributeEnd
    Material "diffuse" "texture reflectance" "t"
    Translate 7 0 0.5 Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 1 1 0])");
  SurfaceInteraction si = make_interaction(s.shapes, {}, {1, 0, 0, {0.25f, 0.25f}});
  EXPECT_EQ(std::get<Lambertian>(*BsdfAt(s, si, {0, 0, 1})).reflectance,
            Rgb(0, 1, 0));  // 7.5 - 2 is in field 5
}

// Numbers such as roughness accept float textures, and a float texture accepts a number.
TEST_F(ImportTextures, NumbersAcceptFloatTextures) {
  const Scene s = world(R"(
    Texture "a" "float" "constant" "float value" 1.25
    Texture "b" "float" "scale" "texture tex" "a" "float scale" 2
    Material "dielectric" "texture eta" "b" Shape "sphere")");
  SurfaceInteraction si = make_interaction(s.shapes, {{0, 0, 2}, {0, 0, -1}}, {1, 0, 0, {}});
  EXPECT_EQ(std::get<Dielectric>(*BsdfAt(s, si, {0, 0, 1})).eta, 2.5f);
  EXPECT_TRUE(s.needs.specular);
}

TEST_F(ImportTextures, ConstantMaterialsStayConstant) {
  const Scene s = world(R"(Texture "t" "spectrum" "constant" Material "diffuse" Shape "sphere")");
  EXPECT_TRUE(s.materials[s.shapes[0].material].constant());
}

TEST_F(ImportTextures, ReportsErrorsInTextures) {
  EXPECT_EQ(first_lines(R"(Texture "t" "colour" "constant")"),
            "2:13: warning: a texture is \"float\" or \"spectrum\": \"colour\" is read as \"spectrum\"\n");
  EXPECT_EQ(first_lines(R"(Texture "t" "float" "ptex")"),
            "2:21: warning: unknown texture \"ptex\": a grey of 0.5 stands in\n");
  EXPECT_EQ(
      first_lines("Texture \"t\" \"float\" \"constant\"\nTexture \"t\" \"float\" \"mix\""),
      "3:9: warning: texture `t` is defined again, as pbrt-v3 allows: this definition holds up to the end "
      "of the block\n");
  EXPECT_EQ(first_lines(R"(Texture "t" "float" "constant" "rgb value" [1 1 1])"),
            "2:32: warning: `value` must be a number in a float texture: \"float value\"; the mean of the "
            "colour is "
            "taken\n");
  EXPECT_EQ(first_lines(R"(Texture "t" "float" "imagemap")"),
            "2:21: error: texture \"imagemap\" needs `filename`\n");
  EXPECT_EQ(
      first_lines(R"(Texture "t" "float" "dots" "string mapping" "planer")"),
      "2:45: error: unknown mapping \"planer\"; did you mean `planar`? known: uv, spherical, cylindrical, "
      "planar\n");
}

// Names may be reused, as in pbrt-v3, where they end with their block.
TEST_F(ImportTextures, NamesMayBeReused) {
  const Scene s = world(R"(
    Texture "t" "spectrum" "constant" "rgb value" [ .1 .1 .1 ]
    AttributeBegin
      Texture "t" "spectrum" "constant" "rgb value" [ .2 .2 .2 ]
      Texture "t" "spectrum" "scale" "texture tex" "t" "float scale" 2
      MakeNamedMaterial "m" "string type" "diffuse" "texture reflectance" "t"
      NamedMaterial "m" Shape "sphere"
    AttributeEnd
    AttributeBegin
      MakeNamedMaterial "m" "string type" "diffuse" "texture reflectance" "t"
      NamedMaterial "m" Shape "sphere"
    AttributeEnd
    NamedMaterial "m" Shape "sphere")");
  const auto reflectance = [&](size_t shape) {
    SurfaceInteraction si = make_interaction(s.shapes, {{0, 0, 2}, {0, 0, -1}}, {1, uint32_t(shape), 0, {}});
    return std::get<Lambertian>(*BsdfAt(s, si, {0, 0, 1})).reflectance.x;
  };
  EXPECT_FLOAT_EQ(reflectance(0), 0.4f);
  EXPECT_FLOAT_EQ(reflectance(1), 0.1f);
  EXPECT_FLOAT_EQ(reflectance(2), 0.4f);
}

TEST_F(ImportTextures, NoiseReadsItsParameters) {
  world(R"(Texture "f" "float" "fbm" "integer octaves" 3 "float roughness" .25
    Texture "w" "float" "wrinkled" Texture "y" "float" "windy"
    Texture "m" "spectrum" "marble" "float scale" 2 "float variation" .5
    Material "diffuse" "texture reflectance" "m" "texture displacement" "w" Shape "sphere")");
  EXPECT_EQ(first_lines(R"(Texture "f" "float" "fbm" "integer octaves" 0)"),
            "2:45: warning: `octaves` of texture \"fbm\" must be >= 1 and <= 32: 0 becomes 1\n");
}

TEST_F(ImportTextures, ReportsErrorsInNames) {
  EXPECT_EQ(
      first_lines("Texture \"wood\" \"spectrum\" \"constant\"\n"
                  "Material \"diffuse\" \"texture reflectance\" \"wod\""),
      "3:42: warning: no texture is named `wod` up to here: `reflectance` keeps its default; did you mean "
      "`wood`?\n");
  EXPECT_EQ(
      first_lines("Texture \"wood\" \"float\" \"constant\"\n"
                  "Material \"diffuse\" \"texture reflectance\" \"wood\""),
      "3:42: warning: `reflectance` takes a spectrum texture, which `wood` is not: its grey is taken\n");
  EXPECT_EQ(first_lines(R"(Texture "t" "float" "scale" "texture tex" "t")"),
            "2:43: warning: no texture is named `t` up to here: `tex` keeps its default\n");
}

// 60 lines would cause 2^60 lookups.
TEST_F(ImportTextures, RefusesTexturesOfTooManyTextures) {
  std::string text = "Texture \"t0\" \"float\" \"constant\"\n";
  for (int i = 1; i <= 60; ++i) {
    const std::string before = std::to_string(i - 1);
    text += "Texture \"t" + std::to_string(i) + "\" \"float\" \"mix\" \"texture tex1\" \"t" + before +
            "\" \"texture tex2\" \"t" + before + "\"\n";
  }
  EXPECT_NE(first_lines(text).find("at most 256 are supported"), std::string::npos);
}

TEST_F(ImportTextures, ReportsErrorsInImages) {
  const auto lines = [&](const std::string& file) {
    return first_lines("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"" + file + "\"");
  };
  EXPECT_EQ(lines("none.png"), "2:53: error: cannot open \"none.png\": no such file\n");
  write("text.png", "no picture at all");
  EXPECT_TRUE(lines("text.png").starts_with("2:53: error: cannot read the image \"text.png\": "));
  // The second half of the pixels is cut off.
  std::vector<uint8_t> noise(64 * 64);
  for (size_t i = 0; i < noise.size(); ++i) noise[i] = static_cast<uint8_t>(i * i * 37 >> 3);
  write_image<uint8_t>("whole.png", 64, 1, noise);
  std::ifstream in(folder_ / "whole.png", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  write("half.png", bytes.substr(0, bytes.size() / 2));
  EXPECT_TRUE(lines("half.png").starts_with("2:53: error: cannot read the image \"half.png\": "));
}

// A FITS file of three axes with no third extent ends the process in OpenImageIO's reader.
TEST_F(ImportTextures, RefusesFormatsThatAreNoTextures) {
  std::string header;
  for (const std::string card :
       {"SIMPLE  =                    T", "BITPIX  =                  -32", "NAXIS   =                    3",
        "NAXIS1  =                    3", "NAXIS2  =                   16", "END"})
    header += card + std::string(80 - card.size(), ' ');
  write("x.fits", header + std::string(2880 - header.size(), ' ') + std::string(2880, '\0'));
  const std::string said =
      first_lines("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"x.fits\"");
  EXPECT_TRUE(said.starts_with("2:53: error: cannot read the image \"x.fits\": it is in none of the formats"))
      << said;
}

// A file of some hundred bytes that claims 2^40 pixels is refused by its header.
TEST_F(ImportTextures, RefusesHugeImagesByTheirHeaders) {
  std::ofstream out(folder_ / "huge.pfm", std::ios::binary);
  out << "PF\n1048576 1048576\n-1.0\n" << std::string(100, '\0');
  out.close();
  const std::string said =
      first_lines("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"huge.pfm\"");
  EXPECT_TRUE(said.starts_with("2:53: error: cannot read the image \"huge.pfm\": ")) << said;
}

// A PNG is refused when it is too small for its pixels; a single colour compresses nearly as well as
// possible.
TEST_F(ImportTextures, RefusesCutImagesByTheirSize) {
  write_image<uint8_t>("black.png", 2048, 1, std::vector<uint8_t>(2048 * 2048));
  EXPECT_EQ(colour_at(with_texture("\"string filename\" \"black.png\""), 0.5f, 0.5f), Rgb(0));
  std::ifstream in(folder_ / "black.png", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  write("cut.png", bytes.substr(0, bytes.size() / 2));
  EXPECT_TRUE(first_lines("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"cut.png\"")
                  .starts_with("2:53: error: cannot read the image \"cut.png\": it ends early\n"));
}

// Partial results of another picture are refused, because the hash of the scene's files covers images.
TEST_F(ImportTextures, ImagesArePartOfTheContentHash) {
  const std::string text = "WorldBegin Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"a.png\"";
  write_image<uint8_t>("a.png", 1, 1, {10});
  const std::string first = load(text).content_hash;
  EXPECT_EQ(load(text).content_hash, first);
  write_image<uint8_t>("a.png", 1, 1, {11});
  EXPECT_NE(load(text).content_hash, first);
}

// Threads outlive scenes: what a thread cached of one scene's images must not affect the next scene.
TEST_F(ImportTextures, ImagesOfSuccessiveScenesAreSeparate) {
  for (int scene = 0; scene < 40; ++scene) {
    const int value = 6 * scene;
    std::string more;
    for (int i = 0; i < 8; ++i) {
      const std::string name = std::to_string(i) + ".png";
      write_image<uint8_t>(name, 100, 1, std::vector<uint8_t>(10'000, static_cast<uint8_t>(value)));
      more += "Texture \"" + name + "\" \"spectrum\" \"imagemap\" \"string filename\" \"" + name + "\"" +
              kLinear + "\n";
    }
    const Scene s = with_texture(std::string("\"string filename\" \"0.png\"") + kLinear + "\n" + more);
    std::atomic<int> wrong = 0;
    tbb::parallel_for(0, 256, [&](int /*i*/) {
      if (std::abs(colour_at(s, 0.5f, 0.25f).x - static_cast<float>(value) / 255) > 5e-4f) ++wrong;
    });
    EXPECT_EQ(wrong, 0) << scene;
  }
}

// Materials load their normal maps after all textures are made. (204, 128, 230) / 255 stands for the normal
// (0.6, 0, 0.8) to half a level of 8 bits, which is 1/255 of it.
TEST_F(ImportTextures, ANormalMapMayBeTheOnlyImage) {
  write_image<uint8_t>("n.png", 1, 3, {204, 128, 230});
  const Scene s = world(
      "Material \"diffuse\" \"string normalmap\" \"n.png\" "
      "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 1 1 0]");
  SurfaceInteraction si = make_interaction(s.shapes, {}, {1, 0, 0, {0.25f, 0.25f}});
  const BsdfAt bsdf(s, si, {0, 0, 1});
  EXPECT_NEAR(si.ns.x, 0.6f, 0.005f);
  EXPECT_NEAR(si.ns.y, 0, 0.005f);
  EXPECT_NEAR(std::abs(si.ns.z), 0.8f, 0.005f);
}

TEST_F(ImportTextures, RefusesMixturesOfTooManyMixtures) {
  EXPECT_EQ(first_lines(nested_mixtures("\"mirror\"", 256)), "");
  EXPECT_EQ(first_lines(nested_mixtures("\"mirror\"", 257)),
            "259:40: error: this mixture of mixtures is 257 deep: at most 256 are supported\n");
}

TEST_F(ImportTextures, AmountsOfMixturesAreFloatTextures) {
  const std::string mix = R"(MakeNamedMaterial "a" "string type" "mirror"
    Texture "grey" "spectrum" "constant" Texture "half" "float" "constant" "float value" 0.5
    Material "mix" "string materials" ["a" "a"] "texture amount" )";
  EXPECT_EQ(first_lines(mix + "\"grey\" Shape \"sphere\""),
            "4:66: warning: `amount` takes a float texture, which `grey` is not: its red is taken\n");
  const Scene s = world(mix + "\"half\" Shape \"sphere\"");
  EXPECT_EQ(s.materials[s.shapes[0].material].mixed()->amount_texture, 1u);
}

}  // namespace
}  // namespace kaustik::pbrt
