// Tests malformed and hostile input: it must be refused, quickly and without a crash.
#include <gmock/gmock.h>

#include "tests/apps/import/import_support.h"

namespace kaustik::pbrt {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class ImportHostile : public ImportTest {};

constexpr std::string_view kSound =
    "# all of it\r\nLookAt 0 0 -5  0 0 0  0 1 0\r\nCamera \"perspective\" \"float fov\" [ 40 ]\r\n"
    "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" [ 8 ]\r\nWorldBegin\r\n"
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" \"true\"\r\n"
    "Shape \"disk\" \"float radius\" .5 AttributeEnd\r\nAttribute \"shape\" \"float radius\" 2\r\n"
    "MakeNamedMaterial \"m\" \"string type\" \"conductor\" \"rgb reflectance\" [.5 .5 .5]\r\nNamedMaterial "
    "\"m\"\r\n"
    "ObjectBegin \"o\" Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 1] ObjectEnd\r\n"
    "Translate 1 2 3 Rotate 30 0 1 0 ObjectInstance \"o\"\r\n";

TEST_F(ImportHostile, UndamagedSceneLoads) {
  EXPECT_EQ(messages(std::string(kSound)), "");
}

TEST_F(ImportHostile, EveryTruncationIsHandled) {
  for (size_t n = 0; n <= kSound.size(); ++n) {
    messages(std::string(kSound.substr(0, n)));  // messages() checks that there are errors or a scene
  }
}

TEST_F(ImportHostile, EveryByteChangedIsHandled) {
  for (size_t n = 0; n < kSound.size(); ++n) {
    for (const char c : {'\0', '"', '[', ']', '-', '9', '#', '\xff'}) {
      std::string text(kSound);
      text[n] = c;
      Diagnostics d;
      const auto loaded = load_scene(write("scene.pbrt", text), d);
      ASSERT_EQ(loaded.has_value(), !d.has_errors()) << n << " " << c;
    }
  }
}

TEST_F(ImportHostile, BinaryFilesAreOneError) {
  std::string bytes(100'000, '\0');
  for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>((i * 2654435761u) >> 13);
  const std::string message = messages(bytes);
  EXPECT_FALSE(loaded_);
  EXPECT_EQ(diagnostics_.error_count(), 1u);
  EXPECT_THAT(message, HasSubstr("it is a binary file, but a .pbrt scene is plain text"));
  Diagnostics d;
  EXPECT_FALSE(load_scene(write("scene.obj", bytes), d));
  ASSERT_EQ(d.entries().size(), 1u);
  EXPECT_THAT(d.entries().front().message, HasSubstr("it is a binary file, but OBJ files are plain text"));
}

TEST_F(ImportHostile, TextsWithManyErrorsStopAtSomeOfThem) {
  std::string text;
  for (int i = 0; i < 10'000; ++i) text += "nonsense\n";
  messages(text);
  EXPECT_FALSE(loaded_);
  EXPECT_LE(diagnostics_.error_count(), 1100u);
}

// Pictures and partial results are none of the formats of scenes, whatever their names say.
TEST_F(ImportHostile, PicturesAreOneErrorThatSaysSo) {
  struct Case {
    std::string bytes, what;
  };
  const std::string more("\0\1\2 8 8 rest\n", 14);
  const Case cases[] = {{"\x89PNG\r\n\x1a\n" + more, "it is a picture (PNG), not a scene"},
                        {"\xff\xd8\xff" + more, "it is a picture (JPEG), not a scene"},
                        {"\x76\x2f\x31\x01" + more, "it is a picture (EXR), not a scene"},
                        {"#?RADIANCE\n" + more, "it is a picture (HDR), not a scene"},
                        {"PF\n8 8\n-1\n" + more, "it is a picture (PNM or PFM), not a scene"},
                        {"KPART\r\n\x1a" + more, "it is a partial result of a render, not a scene"}};
  for (const char* name : {"a.exr", "a.pbrt", "a.obj", "a.glb", "a.ply", "a.stl"})
    for (const Case& c : cases) {
      Diagnostics d;
      EXPECT_FALSE(load_scene(write(name, c.bytes), d));
      ASSERT_EQ(d.entries().size(), 1u) << name;
      const std::string text = d.format_all();
      EXPECT_THAT(text, HasSubstr(c.what)) << name;
      EXPECT_TRUE(std::all_of(text.begin(), text.end(), [](char b) { return b == '\n' || b >= ' '; }))
          << name;
    }
}

TEST_F(ImportHostile, IncludedPicturesAreNamedWhereTheyAreIncluded) {
  write("a.png", "\x89PNG\r\n\x1a\n");
  EXPECT_THAT(messages("WorldBegin\nInclude \"a.png\"\n"),
              AllOf(HasSubstr("scene.pbrt:2:"), HasSubstr("it is a picture (PNG), not a scene")));
}

TEST_F(ImportHostile, NulBytesAreNamed) {
  const std::string nul(3, '\0');
  EXPECT_EQ(messages("WorldBegin " + nul + "\n"),
            "scene.pbrt:1:12: error: unexpected character 0x00: a scene is plain text\nWorldBegin    \n      "
            "     ^\n");
}

TEST_F(ImportHostile, DeepBlocksEndWithOneError) {
  std::string text;
  for (int i = 0; i < 1'000'000; ++i) text += "AttributeBegin\n";
  for (int i = 0; i < 1'000'000; ++i) text += "AttributeEnd\n";
  EXPECT_EQ(first_lines(text), "10002:1: error: more than 10000 nested blocks\n");
}

TEST_F(ImportHostile, DeepTransformsAndObjectsEndWithOneError) {
  std::string text;
  for (int i = 0; i < 1'000'000; ++i) text += "TransformBegin\n";
  messages("WorldBegin\n" + text);
  EXPECT_EQ(diagnostics_.error_count(), 1u);
  EXPECT_EQ(diagnostics_.warning_count(), 10u);  // for the unclosed blocks
}

TEST_F(ImportHostile, ManyParametersEndWithOneError) {
  std::string text = "Shape \"sphere\"\n";
  for (int i = 0; i < 200'000; ++i) text += "\"float a" + std::to_string(i) + "\" 1\n";
  messages("WorldBegin\n" + text);
  EXPECT_LE(diagnostics_.error_count(), 1002u);
  EXPECT_TRUE(std::ranges::any_of(diagnostics_.entries(),
                                  [](const auto& e) { return e.message == "more than 1000 parameters"; }));
}

// An object with many instances is small in the file but large in memory.
TEST_F(ImportHostile, InstancesThatMultiplyAreRefused) {
  std::string text = "WorldBegin\nObjectBegin \"a\"\n";
  for (int i = 0; i < 4'000; ++i) text += "Shape \"sphere\"\n";
  text += "ObjectEnd\n";
  for (int i = 0; i < 4'000; ++i) text += "ObjectInstance \"a\"\n";
  messages(text);
  ASSERT_EQ(diagnostics_.error_count(), 1u);
  EXPECT_EQ(diagnostics_.entries()[0].message, "instances place more than 10000000 shapes, the limit");
}

TEST_F(ImportHostile, CyclicIncludesAreRefused) {
  write("a.pbrt", "Include \"b.pbrt\"\n");
  write("b.pbrt", "Include \"a.pbrt\"\n");
  EXPECT_EQ(messages("WorldBegin\nInclude \"a.pbrt\"\n"),
            "b.pbrt:1:9: error: \"a.pbrt\" includes itself\nInclude \"a.pbrt\"\n        ^\n");
}

TEST_F(ImportHostile, DeepIncludesAreRefused) {
  for (int i = 0; i < 70; ++i) {
    write("f" + std::to_string(i) + ".pbrt", "Include \"f" + std::to_string(i + 1) + ".pbrt\"\n");
  }
  messages("WorldBegin Include \"f0.pbrt\"");
  ASSERT_EQ(diagnostics_.error_count(), 1u);
  EXPECT_EQ(diagnostics_.entries()[0].message, "more than 64 nested includes");
}

// Each of six levels includes ten files of the next.
TEST_F(ImportHostile, TooManyIncludesAreRefused) {
  for (int i = 0; i < 6; ++i) {
    std::string text;
    for (int k = 0; k < 10; ++k) text += "Include \"f" + std::to_string(i + 1) + ".pbrt\"\n";
    write("f" + std::to_string(i) + ".pbrt", text);
  }
  write("f6.pbrt", "");
  messages("WorldBegin Include \"f0.pbrt\"");
  ASSERT_EQ(diagnostics_.error_count(), 1u);
  EXPECT_EQ(diagnostics_.entries()[0].message,
            "the included files are too many or too large in total: reading stops here");
}

TEST_F(ImportHostile, LongTokensAreCut) {
  const std::string out = messages("WorldBegin\n" + std::string(1'000'000, 'x') + "\n");
  EXPECT_LT(out.size(), 1000u);
}

TEST_F(ImportHostile, HugeIndicesAreRefused) {
  EXPECT_EQ(
      first_lines(
          "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 4294967298]"),
      "2:76: error: index 4294967298 is out of range: there are 3 vertices\n");
  EXPECT_EQ(first_lines("Film \"rgb\" \"integer xresolution\" 99999999999999999999\n"),
            "2:1: warning: `Film` belongs before `WorldBegin`; it is read here, too\n"
            "2:34: error: `99999999999999999999` is too large for an integer\n");
}

TEST_F(ImportHostile, TinyNumbersBecomeZero) {
  const Scene scene = world("Translate 1e-400 0." + std::string(400, '0') + "1 3 Shape \"sphere\"");
  EXPECT_EQ(std::get<Sphere>(scene.shapes.at(0).geometry).to_world.translation, Vector3(0, 0, 3));
}

}  // namespace
}  // namespace kaustik::pbrt
