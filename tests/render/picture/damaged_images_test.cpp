// Tests images that are damaged or forged in ways with which the libraries that decode them do not deal well.

#include <gmock/gmock.h>

#include <fstream>

#include "render/picture/exr_file.h"
#include "render/picture/image_io.h"
#include "tests/render/support/image_statistics.h"

namespace kaustik::render {
namespace {

using namespace std::string_literals;
using namespace test;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// The error of reading a picture with these bytes; empty if there is none.
std::string complaint_of(const std::string& name, const std::string& bytes) {
  const std::string path = output_file(name);
  std::ofstream(path, std::ios::binary) << bytes;
  try {
    read_image(path);
  } catch (const ImageError& e) {
    return e.what();
  }
  return {};
}

std::string bytes_of_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The user shall see only what kaustik says; libpng prints messages of its own about what it finds.
TEST(DamagedImages, PngPrintsNothing) {
  const std::string path = output_file("whole.png");
  Image image(16, 16);
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = Rgb(float(i % 7) / 7);
  write_image(path, image);
  const std::string whole = bytes_of_file(path);
  std::string flipped = whole;
  flipped[whole.find("IDAT") + 12] ^= 0x10;
  testing::internal::CaptureStderr();
  EXPECT_THAT(complaint_of("flipped.png", flipped), HasSubstr("does not match its checksum"));
  for (size_t cut = 8; cut + 14 < whole.size(); ++cut)
    EXPECT_THAT(complaint_of("cut.png", whole.substr(0, cut)), HasSubstr("it ends early"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  // What follows the pixels is not read.
  EXPECT_EQ(complaint_of("endless.png", whole.substr(0, whole.size() - 12)), "");
  EXPECT_EQ(complaint_of("cut-end.png", whole.substr(0, whole.size() - 5)), "");
}

std::string little_endian(uint32_t number) {
  return {reinterpret_cast<const char*>(&number), sizeof number};
}

// OpenEXR 3.1 allocates what the size of an attribute says: two gigabytes for a file of some bytes.
TEST(DamagedImages, SizesOfExrAttributesAreCheckedAgainstTheFile) {
  const std::string path = output_file("attributes.exr");
  write_image(path, Image(3, 2));
  const std::string whole = bytes_of_file(path);
  const auto with = [&](const std::string& attribute) { return std::string(whole).insert(8, attribute); };
  const std::string huge = little_endian(0x7fffffff), list = "tags\0stringvector\0"s + little_endian(9);
  const auto expect_refused = [&](const std::string& bytes, const std::string& attribute) {
    const auto expected = HasSubstr("its attribute \"" + attribute + "\" should have 2147483647 bytes");
    EXPECT_THAT(complaint_of("forged.exr", bytes), expected);
    try {
      read_exr_file(output_file("forged.exr"), 100);
      ADD_FAILURE() << "no error";
    } catch (const std::exception& e) {
      EXPECT_THAT(e.what(), expected);
    }
  };
  expect_refused(with("note\0string\0"s + huge), "note");
  expect_refused(with(list + huge + "abcde"), "tags");
  expect_refused(with(list + little_endian(1) + "a" + huge), "tags");
  // OpenEXR does not heed the size of a list of channels, and would find other attributes than this check.
  std::string shifted = whole;
  ++shifted[8 + "channels\0chlist\0"s.size()];
  EXPECT_THAT(complaint_of("shifted.exr", shifted),
              HasSubstr("its attribute \"channels\" should have 56 bytes"));
  EXPECT_THAT(complaint_of("fixed.exr", with("number\0int\0"s + little_endian(5) + "abcde")),
              HasSubstr("its attribute \"number\" should have 5 bytes, and has 4"));
  // A header with a list that is right is left to OpenEXR, which finds no rows where they were.
  EXPECT_THAT(complaint_of("valid.exr", with(list + little_endian(1) + "a" + little_endian(0))),
              AllOf(HasSubstr("pixel data"), Not(HasSubstr("attribute"))));
  EXPECT_THAT(complaint_of("cut.exr", whole.substr(0, 20)), HasSubstr("its header has no end"));
}

// OpenImageIO decodes runs when it opens the file, into memory for all pixels of the header.
TEST(DamagedImages, SizesOfRunsInBmpAreCheckedAgainstTheFile) {
  const auto bmp = [](uint32_t width, uint32_t height, const std::string& runs) {
    const std::string one = little_endian(1);
    const std::string info = little_endian(40) + little_endian(width) + little_endian(height) + "\1\0\10\0"s +
                             one + little_endian(0) + one + one + little_endian(2) + little_endian(2);
    const std::string colours = "\0\0\0\0\377\377\377\0"s;
    return "BM"s + little_endian(62 + uint32_t(runs.size())) + little_endian(0) + little_endian(62) + info +
           colours + runs;
  };
  std::string rows;
  for (int i = 0; i < 100; ++i) rows += "\377\1"s;
  EXPECT_EQ(complaint_of("runs.bmp", bmp(255, 100, rows + "\0\1"s)), "") << "the longest runs";
  const std::string forged = bmp(5, 0x190000f1, "");
  EXPECT_THAT(complaint_of("forged.bmp", forged), HasSubstr("it ends early"));
  EXPECT_THAT(complaint_of("forged.bmp", bmp(5, uint32_t(-0x190000f1), "")), HasSubstr("it ends early"));
}

// OpenImageIO's readers of these took gigabytes for forged sizes, or ended the program.
TEST(DamagedImages, OtherFormatsAreNotOpened) {
  for (const std::string& mark : {"8BPS\0\1"s, "\x01\xda\1\1\0\3"s, "GIF89a"s, "DDS |"s, "SIMPLE  ="s})
    EXPECT_THAT(complaint_of("other", mark + std::string(600, '\0')), HasSubstr("PNG, JPEG, EXR"));
}

}  // namespace
}  // namespace kaustik::render
