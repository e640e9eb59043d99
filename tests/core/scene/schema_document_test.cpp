// Tests that docs/reference/scene_format.md holds the schema's own tables.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/scene/schema/schema.h"

namespace kaustik {
namespace {

TEST(SchemaDocument, ContainsTheTablesOfTheSchema) {
  std::ifstream in(KAUSTIK_SOURCE_DIR "/docs/reference/scene_format.md");
  ASSERT_TRUE(in) << "docs/reference/scene_format.md is missing";
  std::stringstream text;
  text << in.rdbuf();
  const std::string tables = schema_markdown();
  if (text.str().find(tables) == std::string::npos) {
    std::ofstream(KAUSTIK_TEST_OUTPUT_DIR "/scene_format_tables.md") << tables;
    FAIL() << "the reference in docs/reference/scene_format.md is out of date: replace it "
              "by " KAUSTIK_TEST_OUTPUT_DIR "/scene_format_tables.md";
  }
}

TEST(SchemaDocument, ListsEveryMaterialAndLight) {
  const std::string tables = schema_markdown();
  const auto has_row = [&](std::string_view directive, std::string_view name) {
    return tables.find(fmt::format("`{} \"{}\"`", directive, name)) != std::string::npos;
  };
  // Each BSDF has a row in the schema that makes it from its defaults.
  std::set<size_t> made;
  for (const MaterialRow& row : material_rows()) {
    EXPECT_TRUE(has_row("Material", row.spec.name));
    Directive nothing;
    if (row.make)
      made.insert(row.make(MaterialInputs(material_inputs(ParameterReader(nothing, row.spec)))).index());
  }
  EXPECT_EQ(made.size(), std::variant_size_v<Bsdf>);
  for (const std::string_view name :
       {PointLight::kName, SpotLight::kName, DistantLight::kName, InfiniteLight::kName}) {
    EXPECT_TRUE(has_row("LightSource", name));
  }
  EXPECT_TRUE(has_row("AreaLightSource", DiffuseAreaLight::kName));
}

}  // namespace
}  // namespace kaustik
