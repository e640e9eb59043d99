// Tests image files: round trips, layers, crops, errors; and tone mapping against published values.

#include "render/picture/image_io.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/math/hash.h"
#include "core/spectrum/srgb.h"
#include "render/picture/exr_file.h"
#include "tests/render/support/image_statistics.h"
#include "tests/support/file_size_limit.h"

namespace kaustik::render {
namespace {

using namespace test;
namespace fs = std::filesystem;

Film numbered_film(int x0 = 0, int y0 = 0, int full = 5) {
  Film film(3, 2, x0, y0, full, full);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) {
      PixelResult& p = film.at(x, y);
      const float v = float(y * 3 + x + 1);
      p.emitted = Rgb(v, 0, 0);
      p.direct = Rgb(0.25f, v, 0);
      p.caustic = Rgb(0, 0, 1000 * v);
      p.indirect = Rgb(0, 0, 1e-30f);
      p.albedo = Rgb(0.5f);
      p.normal = Vector3(0, -1, 0);
      p.depth = 7 * v;
      p.photons = v;
      p.error = Rgb(0, 0.125f * v, 0);
      p.bias = Rgb(0, 0, -v);
      p.media_direct = Rgb(0.5f * v), p.media_caustic = Rgb(3 * v), p.media_indirect = Rgb(5 * v);
    }
  return film;
}

// All channels of an EXR by name.
struct Channels {
  OIIO::ImageSpec spec;
  std::vector<float> values;
  float at(int x, int y, const std::string& name) const {
    const int c = spec.channelindex(name);
    EXPECT_GE(c, 0) << name;
    return values[(size_t(y) * size_t(spec.width) + size_t(x)) * size_t(spec.nchannels) + size_t(c)];
  }
};

Channels read_channels(const std::string& path) {
  auto in = OIIO::ImageInput::open(path);
  EXPECT_TRUE(in);
  Channels out{in->spec(), {}};
  out.values.resize(size_t(out.spec.width) * size_t(out.spec.height) * size_t(out.spec.nchannels));
  EXPECT_TRUE(in->read_image(0, 0, 0, out.spec.nchannels, OIIO::TypeDesc::FLOAT, out.values.data()));
  return out;
}

TEST(ImageIo, ExrKeepsLayersMetadataAndTotal) {
  const std::string path = output_file("layers.exr");
  WriteOptions options;
  options.layers = layers_from_names({"all"});
  options.metadata = {{"kaustik:seed", "42"}};
  const Film film = numbered_film();
  write_film(path, film, options);
  const Channels file = read_channels(path);
  EXPECT_EQ(file.spec.nchannels, 3 + 3 * 14 + 3);
  EXPECT_EQ(file.spec.get_string_attribute("kaustik:seed"), "42");
  EXPECT_EQ(file.spec.get_string_attribute("DateTime"), "") << "the bytes must not depend on the time of day";
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) {
      const PixelResult& p = film.at(x, y);
      EXPECT_EQ(file.at(x, y, "R"), p.radiance().x);
      EXPECT_EQ(file.at(x, y, "B"), p.radiance().z);
      EXPECT_EQ(file.at(x, y, "direct.G"), p.direct.y);
      EXPECT_EQ(file.at(x, y, "caustic.B"), p.caustic.z);
      EXPECT_EQ(file.at(x, y, "indirect.B"), p.indirect.z);
      EXPECT_EQ(file.at(x, y, "emitted.R"), p.emitted.x);
      EXPECT_EQ(file.at(x, y, "albedo.G"), p.albedo.y);
      EXPECT_EQ(file.at(x, y, "normal.Y"), p.normal.y);
      EXPECT_EQ(file.at(x, y, "depth.Z"), p.depth);
      EXPECT_EQ(file.at(x, y, "photons.Y"), p.photons);
      EXPECT_EQ(file.at(x, y, "denoising_emitted.R"), p.denoising_emitted.x);
      EXPECT_EQ(file.at(x, y, "denoising_albedo.G"), p.denoising_albedo.y);
      EXPECT_EQ(file.at(x, y, "denoising_normal.Z"), p.denoising_normal.z);
      EXPECT_EQ(file.at(x, y, "denoising_depth.Z"), p.denoising_depth);
      EXPECT_EQ(file.at(x, y, "error.G"), p.error.y);
      EXPECT_EQ(file.at(x, y, "bias.B"), p.bias.z);
      EXPECT_EQ(file.at(x, y, "media_direct.R"), p.media_direct.x);
      EXPECT_EQ(file.at(x, y, "media_caustic.G"), p.media_caustic.y);
      EXPECT_EQ(file.at(x, y, "media_indirect.B"), p.media_indirect.z);
    }
  const Image image = read_image(path);
  EXPECT_EQ(image.at(2, 1), film.at(2, 1).radiance());
}

// The picture that is shown, the film's own as the layer `noisy`, and the halves of its samples.
TEST(ImageIo, ExrKeepsHalvesAndThePictureBeforeDenoising) {
  const std::string path = output_file("denoised.exr");
  const Film film = numbered_film();
  HalfFilm halves = window_of<HalfMeans>(film);
  halves.at(2, 1).mean[1][half_of(Layer::kDenoisingNormal) + 2] = 5;
  halves.at(2, 1).share = {0.25f, 0.75f};
  const Image shown(film.width(), film.height(), Rgb(1, 2, 3));
  WriteOptions options;
  options.picture = &shown, options.halves = &halves;
  write_film(path, film, options);
  const Channels file = read_channels(path);
  EXPECT_EQ(file.spec.nchannels, 3 + 3 + 2 * (int(kHalfChannels) + 1));
  EXPECT_EQ(file.at(2, 1, "G"), 2);
  EXPECT_EQ(file.at(2, 1, "noisy.G"), film.at(2, 1).radiance().y);
  EXPECT_EQ(file.at(2, 1, "half_b.denoising_normal.Z"), 5);
  EXPECT_EQ(file.at(2, 1, "half_a.share.Y"), 0.25f);
  const ExrChannels channels = read_exr_file(path, 100);
  ASSERT_NE(channels.find("half_b.share.Y"), nullptr);
  EXPECT_EQ((*channels.find("half_b.share.Y"))[size_t(film.width()) + 2], 0.75f);
  EXPECT_EQ(channels.find("half_c.share.Y"), nullptr);
  EXPECT_THROW(read_exr_file(path, 3), std::runtime_error);
  write_channels(output_file("copy.exr"), channels);
  EXPECT_EQ(read_exr_file(output_file("copy.exr"), 100).values, channels.values);
}

TEST(ImageIo, ReadsOneLayer) {
  const std::string path = output_file("one-layer.exr");
  const Film film = numbered_film();
  write_film(path, film, {layers_from_names({"all"}), {}, {}});
  const Image direct = read_layer(path, "direct"), normal = read_layer(path, "normal");
  const Image depth = read_layer(path, "depth");
  ASSERT_EQ(direct.width, 3);
  ASSERT_EQ(direct.height, 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) {
      EXPECT_EQ(direct.at(x, y), film.at(x, y).direct);
      EXPECT_EQ(normal.at(x, y), film.at(x, y).normal);
      EXPECT_EQ(depth.at(x, y), Rgb(film.at(x, y).depth));  // a single channel three times
    }
  EXPECT_THROW(read_layer(path, "dir"), ImageError);
  EXPECT_THROW(read_layer(path, ""), ImageError);
}

TEST(ImageIo, CropIsTheDataWindow) {
  const std::string path = output_file("crop.exr");
  const Film film = numbered_film(1, 3, 5);
  write_film(path, film);
  const OIIO::ImageSpec spec = read_channels(path).spec;
  EXPECT_EQ(spec.x, 1);
  EXPECT_EQ(spec.y, 3);
  EXPECT_EQ(spec.width, 3);
  EXPECT_EQ(spec.full_width, 5);
  EXPECT_EQ(spec.full_height, 5);
  EXPECT_EQ(spec.nchannels, 3);
  const Image image = read_image(path);
  EXPECT_EQ(image.width, 3);
  EXPECT_EQ(image.at(0, 0), film.at(0, 0).radiance());
  EXPECT_EQ(image.at(2, 1), film.at(2, 1).radiance());
}

TEST(ImageIo, EqualPicturesAreEqualBytes) {
  const std::string first = output_file("first.exr"), second = output_file("second.exr");
  WriteOptions options;
  options.layers = {Layer::kDepth};
  options.metadata = {{"kaustik:seed", "42"}};
  for (const std::string& path : {first, second}) write_film(path, numbered_film(), options);
  const auto bytes = [](const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(bytes(first), bytes(second));
}

// The old picture stays, and no temporary file is left. The picture is noise, so that it is not compressed to
// less than the limit in any format; libjpeg would end the process if it wrote to the disk itself.
TEST(ImageIo, FullDiskLeavesThePictureBefore) {
  Image noise(64, 64);
  for (size_t i = 0; i < noise.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) noise.pixels[i][c] = float(hash_combine(i, uint64_t(c)) >> 40) * 0x1p-24f;
  for (const std::string name : {"a.exr", "a.png", "a.jpg"}) {
    const std::string folder = output_file("full-" + name), path = folder + "/" + name;
    fs::remove_all(folder);
    fs::create_directories(folder);
    write_image(path, Image(4, 4, Rgb(0.25f)));
    try {
      const FileSizeLimit limit(2000);
      write_image(path, noise);
      FAIL() << "no error for " << path;
    } catch (const ImageError& e) {
      EXPECT_EQ(std::string(e.what()), path + ": " + std::strerror(EFBIG));
    }
    EXPECT_EQ(read_image(path).width, 4) << path;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1) << path;
  }
}

// Formats that files of others come in. Those that OpenImageIO cannot write, as built here, are left out.
TEST(ImageIo, ReadsTheFormatsOfPicturesAndTextures) {
  const std::vector<float> red = {0.5f, 0.25f, 0.125f, 0.5f, 0.25f, 0.125f};
  int read = 0;
  for (const char* extension : {"png", "jpg", "exr", "hdr", "tif", "pfm", "ppm", "webp", "tga", "bmp"}) {
    const std::string path = output_file(std::string("format.") + extension);
    fs::remove(path);
    const auto out = OIIO::ImageOutput::create(path);
    if (!out || !out->open(path, OIIO::ImageSpec(2, 1, 3, OIIO::TypeDesc::UINT8))) continue;
    out->write_image(OIIO::TypeDesc::FLOAT, red.data());
    if (!out->close()) continue;
    ++read;
    EXPECT_NO_THROW(EXPECT_EQ(read_image(path).width, 2) << path);
    // The contents decide, not the name, except for Targa, whose files have no mark.
    const std::string other = output_file(std::string("named-") + extension + ".png");
    fs::rename(path, other);
    if (std::string(extension) != "tga") {
      EXPECT_NO_THROW(EXPECT_EQ(read_image(other).width, 2) << other);
    }
  }
  EXPECT_GE(read, 8);
}

// OpenImageIO's reader of FITS ends the process on some files.
TEST(ImageIo, RefusesFormatsThatAreNoPictures) {
  const std::string path = output_file("x.fits");
  std::ofstream(path) << std::string(80, ' ').replace(0, 30, "SIMPLE  =                    T")
                      << std::string(2800, ' ');
  try {
    read_image(path);
    FAIL() << "no error";
  } catch (const ImageError& e) {
    EXPECT_NE(std::string(e.what()).find("none of the formats PNG, JPEG"), std::string::npos) << e.what();
  }
}

// An 8-bit level is at most half a level away from the encoded value.
TEST(ImageIo, PngRoundTripIsWithinHalfALevel) {
  Image image(16, 1);
  for (int x = 0; x < 16; ++x) image.at(x, 0) = Rgb(float(x) / 15, float(x * x) / 225, 0.5f);
  const std::string path = output_file("ramp.png");
  write_image(path, image);
  const Image back = read_image(path);
  for (int x = 0; x < 16; ++x)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(srgb_from_linear(back.at(x, 0)[c]), srgb_from_linear(image.at(x, 0)[c]), 0.5 / 255 + 1e-5);
}

TEST(ImageIo, JpegAndPfmAreRead) {
  const std::string jpeg = output_file("grey.jpg");
  write_image(jpeg, Image(16, 16, Rgb(0.2f)));
  EXPECT_NEAR(read_image(jpeg).at(8, 8).x, 0.2, 0.01);  // three levels of quantisation

  // PFM stores rows from bottom to top, little-endian if the scale is negative.
  const std::string pfm = output_file("two.pfm");
  std::ofstream out(pfm, std::ios::binary);
  out << "PF\n1 2\n-1.0\n";
  const float rows[] = {1, 2, 3, 4, 5, 6};
  out.write(reinterpret_cast<const char*>(rows), sizeof rows);
  out.close();
  EXPECT_EQ(read_image(pfm).at(0, 1), Rgb(1, 2, 3));
  EXPECT_EQ(read_image(pfm).at(0, 0), Rgb(4, 5, 6));
}

TEST(ImageIo, FailureNamesThePathAndLeavesNothing) {
  const std::string folder = output_file("unwritable");
  const std::string path = folder + "/no-such-folder/a.exr";
  fs::create_directories(folder);
  try {
    write_film(path, numbered_film());
    FAIL() << "no error";
  } catch (const ImageError& e) {
    EXPECT_EQ(std::string(e.what()).rfind(path + ": ", 0), 0u) << e.what();
    EXPECT_EQ(e.path(), path);
  }
  // The final name is a folder, so the file can be written but not renamed.
  fs::create_directories(folder + "/taken.exr/full");
  EXPECT_THROW(write_film(folder + "/taken.exr", numbered_film()), ImageError);
  size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder)) ++entries;
  EXPECT_EQ(entries, 1u);
  EXPECT_THROW(read_image(path), ImageError);
  EXPECT_THROW(write_film(output_file("a.tiff"), numbered_film()), std::invalid_argument);
}

TEST(ImageIo, ParsesLayerNames) {
  EXPECT_TRUE(layers_from_names({}).empty());
  EXPECT_EQ(layers_from_names({"all"}).size(), size_t(kLayers));
  EXPECT_EQ(layers_from_names({"depth", "caustic", "depth"}),
            (std::vector<Layer>{Layer::kCaustic, Layer::kDepth}));
  try {
    layers_from_names({"caustics"});
    FAIL() << "no error";
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("'caustics'"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("caustic, indirect"), std::string::npos);
  }
}

// IEC 61966-2-1: 0.5 linear is level 187.5 of 255; 0.0031308 is 0.04045; 0.2140, mid grey, is 0.5.
TEST(Tonemap, SrgbCurveMatchesTheStandard) {
  EXPECT_NEAR(srgb_from_linear(0.0031308f), 0.0404499f, 1e-6);
  EXPECT_NEAR(srgb_from_linear(0.2140411f), 0.5f, 1e-6);
  EXPECT_EQ(to_srgb8(Rgb(0, 0.5f, 1), {}), (std::array<uint8_t, 3>{0, 188, 255}));
  EXPECT_EQ(to_srgb8(Rgb(-1, 7, std::nanf("")), {}), (std::array<uint8_t, 3>{0, 255, 0}));
  for (const Tonemap operation : {Tonemap::kSrgb, Tonemap::kReinhard, Tonemap::kFilmic})
    EXPECT_EQ(tonemap(Rgb(-0.5f), {0, operation}), Rgb(0));
  EXPECT_EQ(to_srgb8(Rgb(kInfinity), {}), (std::array<uint8_t, 3>{255, 255, 255}));
  for (int level = 0; level < 256; ++level)
    EXPECT_EQ(to_srgb8(Rgb(linear_from_srgb(float(level) / 255)), {})[0], level);
}

TEST(Tonemap, ExposureIsInStops) {
  EXPECT_EQ(tonemap(Rgb(0.125f), {2, Tonemap::kSrgb}), Rgb(0.5f));
  EXPECT_EQ(tonemap(Rgb(0.5f), {-1, Tonemap::kSrgb}), Rgb(0.25f));
}

TEST(Tonemap, OperatorsMatchTheirFormulas) {
  // A grey of luminance 1 becomes 0.5; the hue stays.
  EXPECT_NEAR(tonemap(Rgb(1), {0, Tonemap::kReinhard}).x, 0.5f, 1e-6);
  const Rgb c = tonemap(Rgb(0.6f, 0.3f, 0), {0, Tonemap::kReinhard});
  EXPECT_NEAR(c.x / c.y, 2, 1e-5);
  // The filmic curve at 1 is (1 (2.51 + 0.03)) / (1 (2.43 + 0.59) + 0.14).
  EXPECT_NEAR(tonemap(Rgb(1), {0, Tonemap::kFilmic}).x, 2.54f / 3.16f, 1e-6);
  for (const Tonemap op : {Tonemap::kSrgb, Tonemap::kReinhard, Tonemap::kFilmic})
    EXPECT_EQ(tonemap(Rgb(kInfinity), {0, op}), Rgb(1)) << int(op);
  EXPECT_EQ(tonemap_from_name("filmic"), Tonemap::kFilmic);
  EXPECT_FALSE(tonemap_from_name("Filmic"));
}

}  // namespace
}  // namespace kaustik::render
