// Tests the images of glTF files: embedded ones, and those that the importer makes from them.

#include <OpenImageIO/imageio.h>

#include <fstream>

#include "apps/import/common/derived_image.h"
#include "apps/import/common/scene_files.h"
#include "tests/apps/import/gltf/gltf_support.h"

namespace kaustik::pbrt {
namespace {

using testing::HasSubstr;

class GltfTextures : public ImportGltf {
 protected:
  // A PNG of two pixels of red, green, blue and alpha.
  std::string png(const std::vector<uint8_t>& pixels) const {
    const std::string path = (folder_ / "two.png").string();
    const auto out = OIIO::ImageOutput::create(path);
    OIIO::ImageSpec spec(2, 1, 4, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:UnassociatedAlpha", 1);  // store the colours as they are given
    EXPECT_TRUE(out->open(path, spec));
    out->write_image(OIIO::TypeDesc::UINT8, pixels.data());
    out->close();
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static std::vector<float> pixels_of(const std::filesystem::path& path) {
    const auto in = OIIO::ImageInput::open(path.string());
    if (!in) return {};
    std::vector<float> out(static_cast<size_t>(in->spec().width * in->spec().nchannels));
    in->read_image(0, 0, 0, in->spec().nchannels, OIIO::TypeDesc::FLOAT, out.data());
    return out;
  }
  // A triangle whose material uses texture 0, an image after the triangle's bytes.
  SceneDescription textured(const std::string& material, const std::string& image) {
    std::string parts(kTriangleParts);
    const std::string view = R"({ "buffer": 0, "byteOffset": 96, "byteLength": 6 })";
    parts.replace(
        parts.find(view), view.size(),
        view + fmt::format(R"(, {{ "buffer": 0, "byteOffset": 104, "byteLength": {} }})", image.size()));
    return describe(gltf(parts + R"("materials": [ )" + material + R"( ], "nodes": [ { "mesh": 0 } ],
        "textures": [ { "source": 0, "sampler": 0 } ], "samplers": [ { "wrapS": 33071 } ],
        "images": [ { "bufferView": 4, "mimeType": "image/png" } ])",
                         triangle_bytes() + image));
  }
  std::filesystem::path file_of(const Directive& d, std::string_view name) const {
    const Parameter& p = *d.find(name);
    return find_named_file({}, p.strings.at(0), diagnostics_.files.name(p.location.file),
                           folder_ / "scene.gltf")
        .path();
  }
};

// A red pixel, then a grey one with an alpha of one half.
const std::vector<uint8_t> kTwo = {255, 0, 0, 255, 128, 128, 128, 128};

TEST_F(GltfTextures, EmbeddedImagesAreWrittenToFiles) {
  const std::string image = png(kTwo);
  std::filesystem::path file;
  {
    const auto s = textured(R"({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } })", image);
    ASSERT_EQ(s.textures.size(), 1u);
    EXPECT_EQ(s.textures[0].type, "imagemap");
    EXPECT_EQ(s.textures[0].value_type, "spectrum");
    EXPECT_EQ(s.textures[0].find("wrap")->strings[0], "clamp");
    EXPECT_EQ(s.materials.at(0).find("reflectance")->strings[0], s.textures[0].name);
    // The file's name does not contain the folder, so that the scene's hash is reproducible.
    EXPECT_EQ(s.textures[0].find("filename")->strings[0], "image0.png");
    file = file_of(s.textures[0], "filename");
    std::ifstream in(file, std::ios::binary);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), image);
  }
  EXPECT_FALSE(std::filesystem::exists(file));  // the files are deleted with the description
}

TEST_F(GltfTextures, FactorsAreMultipliedIntoImages) {
  const auto s = textured(R"({ "pbrMetallicRoughness": { "baseColorFactor": [ 0.25, 1, 1, 1 ],
      "baseColorTexture": { "index": 0 } } })",
                          png(kTwo));
  const std::vector<float> pixels = pixels_of(file_of(s.textures.at(0), "filename"));
  ASSERT_EQ(pixels.size(), 6u);
  // The sRGB value of 0.25 is 0.5371 (IEC 61966-2-1), in 8 bits.
  EXPECT_NEAR(pixels[0], 0.5371, 0.5 / 255);
  EXPECT_EQ(pixels[1], 0);
  EXPECT_NEAR(pixels[4], 128.0 / 255, 1e-6);
}

// Roughness is in green, and the GGX width is its square; metalness is in blue. Both are written with 16
// bits.
TEST_F(GltfTextures, ChannelsAreSplitIntoImages) {
  const auto s = textured(R"({ "pbrMetallicRoughness": { "metallicRoughnessTexture": { "index": 0 },
      "metallicFactor": 0.5 } })",
                          png({0, 255, 0, 255, 0, 51, 255, 255}));
  std::vector<std::vector<float>> images;
  for (const TextureDescription& t : s.textures) {
    EXPECT_EQ(t.value_type, "float");
    images.push_back(pixels_of(file_of(t, "filename")));
    ASSERT_EQ(images.back().size(), 2u);
  }
  ASSERT_EQ(images.size(), 3u);
  EXPECT_NEAR(images[1][0], 1, 1e-5);  // dielectric's roughness
  EXPECT_NEAR(images[1][1], 0.04, 1e-5);
  const auto mix = std::ranges::find_if(s.materials, [](const auto& m) { return m.type == "mix"; });
  ASSERT_NE(mix, s.materials.end());
  const std::string amount = mix->find("amount")->strings.at(0);
  const auto texture = std::ranges::find_if(s.textures, [&](const auto& t) { return t.name == amount; });
  ASSERT_NE(texture, s.textures.end());
  const std::vector<float> shares = pixels_of(file_of(*texture, "filename"));
  EXPECT_EQ(shares.at(0), 0);
  EXPECT_NEAR(shares.at(1), 0.5, 1e-5);
  EXPECT_EQ(diagnostics_.format_all().find("mean"), std::string::npos);
}

// A metalness texture that is 0 or 1 everywhere needs no mixture.
TEST_F(GltfTextures, UniformMetalnessNeedsNoMixture) {
  for (const auto& [blue, type] : {std::pair{0, "coateddiffuse"}, std::pair{255, "conductor"}}) {
    const auto b = static_cast<uint8_t>(blue);
    const auto s = textured(R"({ "pbrMetallicRoughness": { "metallicRoughnessTexture": { "index": 0 } } })",
                            png({0, 255, b, 255, 0, 51, b, 255}));
    ASSERT_EQ(s.materials.size(), 1u);
    EXPECT_EQ(s.materials[0].type, type);
  }
}

TEST_F(GltfTextures, TransmissionIsMixedByItsTexture) {
  const auto s = textured(R"({ "pbrMetallicRoughness": { "metallicFactor": 0 }, "extensions":
      { "KHR_materials_transmission": { "transmissionFactor": 0.8, "transmissionTexture": { "index": 0 } } } })",
                          png(kTwo));
  const MaterialDescription& mix = s.materials.back();
  ASSERT_EQ(mix.type, "mix");
  const std::vector<float> shares = pixels_of(file_of(s.textures.back(), "filename"));
  EXPECT_EQ(mix.find("amount")->strings.at(0), s.textures.back().name);
  EXPECT_NEAR(shares.at(0), 0.8, 1e-5);
  EXPECT_NEAR(shares.at(1), 0.8 * 128 / 255, 1e-4);
}

TEST_F(GltfTextures, AlphaModesAreConverted) {
  const std::string material =
      R"({ "alphaMode": "%", "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } })";
  for (const auto& [mode, second] : {std::pair{"BLEND", 128.0 / 255}, std::pair{"MASK", 1.0}}) {
    std::string text = material;
    text.replace(text.find('%'), 1, mode);
    const auto s = textured(text, png(kTwo));
    const Parameter* alpha = s.shapes.at(0).find("alpha");
    ASSERT_TRUE(alpha) << mode;
    for (const TextureDescription& t : s.textures) {
      if (t.name != alpha->strings[0]) continue;
      const std::vector<float> pixels = pixels_of(file_of(t, "filename"));
      EXPECT_EQ(pixels.at(0), 1);
      EXPECT_NEAR(pixels.at(1), second, 1e-4) << mode;
    }
  }
}

// The factor's largest component becomes the scale, and the rest goes into the image.
TEST_F(GltfTextures, EmissiveTexturesBecomeLightImages) {
  const auto s = textured(R"({ "emissiveFactor": [ 1, 0.25, 1 ], "emissiveTexture": { "index": 0 },
      "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 6 } } })",
                          png({255, 0, 0, 255, 0, 255, 0, 255}));
  const Directive& light = s.area_lights.at(0);
  EXPECT_EQ(light.find("scale")->numbers, (std::vector<double>{6}));
  EXPECT_FALSE(light.find("L"));
  const std::vector<float> pixels = pixels_of(file_of(light, "filename"));
  ASSERT_EQ(pixels.size(), 6u);
  EXPECT_EQ(pixels[0], 1);
  EXPECT_NEAR(pixels[4], 0.5371, 0.5 / 255);                                 // sRGB of 0.25
  EXPECT_EQ(diagnostics_.warning_count(), 1u) << diagnostics_.format_all();  // about the camera
}

TEST_F(GltfTextures, UnsupportedEmissionUsesItsMean) {
  const auto s = textured(R"({ "emissiveFactor": [ 1, 1, 1 ], "emissiveTexture": { "index": 0,
      "extensions": { "KHR_texture_transform": { "scale": [ 2, 2 ] } } } })",
                          png({255, 0, 0, 255, 0, 255, 0, 255}));
  const Parameter* L = s.area_lights.at(0).find("L");
  EXPECT_EQ(L->numbers, (std::vector<double>{0.5, 0.5, 0}));
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("are rendered as their mean"));
}

TEST_F(GltfTextures, BlackEmissionMakesNoLight) {
  const auto s = textured(R"({ "emissiveFactor": [ 1, 1, 1 ], "emissiveTexture": { "index": 0 } })",
                          png({0, 0, 0, 255, 0, 0, 0, 255}));
  EXPECT_TRUE(s.area_lights.empty());
}

TEST_F(GltfTextures, DamagedImagesAreGrey) {
  const auto s = textured(R"({ "pbrMetallicRoughness": { "baseColorFactor": [ 0.5, 1, 1, 1 ],
      "baseColorTexture": { "index": 0 } } })",
                          png(kTwo).substr(0, 40));
  EXPECT_TRUE(s.textures.empty());
  EXPECT_EQ(s.materials.at(0).find("reflectance")->numbers, (std::vector<double>{0.25, 0.5, 0.5}));
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("cannot read"));
  textured(R"({ "normalTexture": { "index": 0 } })", "no image");
  EXPECT_THAT(diagnostics_.format_all(), HasSubstr("image 0 has a format that cannot be read"));
}

// An image file that is absent, one of a format that cannot be read, and one that ends early.
TEST_F(GltfTextures, FilesThatCannotBeReadAreGrey) {
  write("packed.ktx2", "\xabKTX 20\xbb\r\n\x1a\n");
  write("cut.png", png(kTwo).substr(0, 40));
  for (const char* name : {"absent.png", "packed.ktx2", "cut.png"}) {
    const auto path = triangle(
        R"({ "pbrMetallicRoughness": { "metallicFactor": 0, "baseColorTexture": { "index": 0 } } })",
        fmt::format(R"(, "textures": [ {{ "source": 0 }} ], "images": [ {{ "uri": "{}" }} ])", name));
    diagnostics_ = Diagnostics();
    EXPECT_TRUE(load_scene(path, diagnostics_)) << name << diagnostics_.format_all();
    EXPECT_THAT(diagnostics_.format_all(), HasSubstr("grey")) << name;
    EXPECT_THAT(diagnostics_.format_all(), HasSubstr(name));
  }
}

// Without its texture a surface is taken for paint, of half the roughness: (0.5 x 1)^2 as the width of GGX.
TEST_F(GltfTextures, MetalnessThatCannotBeReadIsZero) {
  const auto s =
      describe(triangle(R"({ "pbrMetallicRoughness": { "metallicRoughnessTexture": { "index": 0 } } })",
                        R"(, "textures": [ { "source": 0 } ], "images": [ { "uri": "absent.png" } ])"));
  ASSERT_EQ(s.materials.size(), 1u);
  EXPECT_EQ(s.materials[0].type, "coateddiffuse");
  EXPECT_EQ(s.materials[0].find("roughness")->numbers, (std::vector<double>{0.25}));
}

// Normal maps are read at the mesh's own coordinates: their transform is applied to these, and other textures
// make up for it.
TEST_F(GltfTextures, TransformsOfNormalMapsAreThoseOfTheMesh) {
  const auto s = textured(R"({ "normalTexture": { "index": 0, "extensions": { "KHR_texture_transform": {
      "scale": [ 4, 2 ] } } }, "pbrMetallicRoughness": { "metallicFactor": 0, "baseColorTexture": { "index": 0 } } })",
                          png(kTwo));
  // The file has (0, 0), (1, 0) and (0, 0.25), which become (4 u, 1 - 2 v).
  EXPECT_EQ(s.shapes.at(0).find("uv")->numbers, (std::vector<double>{0, 1, 4, 1, 0, 0.5}));
  EXPECT_EQ(s.textures.at(0).find("uscale")->numbers, (std::vector<double>{0.25}));
  EXPECT_EQ(s.textures.at(0).find("vscale")->numbers, (std::vector<double>{0.5}));
  EXPECT_EQ(s.textures.at(0).find("vdelta")->numbers, (std::vector<double>{0.5}));
}

// A quarter turn: u' = v, v' = -u as v points down; in t, which points up, s' = 1 - t and t' = 1 + s.
TEST_F(GltfTextures, TransformsMayTurn) {
  const auto s =
      textured(R"({ "pbrMetallicRoughness": { "metallicFactor": 0, "baseColorTexture": { "index": 0,
      "extensions": { "KHR_texture_transform": { "rotation": 1.5707963267948966, "texCoord": 0 } } } } })",
               png(kTwo));
  const auto near = [&](const char* name, double expected) {
    EXPECT_NEAR(s.textures.at(0).find(name)->numbers.at(0), expected, 1e-12) << name;
  };
  near("uscale", 0), near("vscale", 0), near("ushear", -1), near("vshear", 1), near("udelta", 1),
      near("vdelta", 1);
}

}  // namespace
}  // namespace kaustik::pbrt
