// Tests that docs/reference/scene_format.md holds the schema's own tables.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/scene/schema/schema.h"
#include "tests/core/light/light_cases.h"

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
  // The rows of lights make more than one type each: "infinite image" belongs to the row "infinite".
  for (const test::LightCase& c : test::light_cases()) {
    const std::string_view name = name_of(c.light).substr(0, name_of(c.light).find(' '));
    const bool is_surface = std::holds_alternative<DiffuseAreaLight>(c.light);
    EXPECT_TRUE(has_row(is_surface ? "AreaLightSource" : "LightSource", name)) << name;
  }
}

// A material keeps photons at all points when a texture decides which lobes it has there (Material::lobes).
// It knows such parameters by names that end with "roughness"; no other parameter may change the lobes.
TEST(MaterialRows, OnlyRoughnessDecidesTheLobes) {
  for (const MaterialRow& row : material_rows()) {
    if (!row.make) continue;
    const Directive nothing;
    for (const double roughness : {0.0, 0.5}) {
      std::vector<MaterialInput> inputs = material_inputs(ParameterReader(nothing, row.spec));
      const auto is_roughness = [](const MaterialInput& i) { return i.name.ends_with("roughness"); };
      for (MaterialInput& input : inputs)
        if (is_roughness(input) && input.name != "remaproughness") input.numbers = {roughness};
      const Lobes usual = lobes(row.make(MaterialInputs(inputs)));
      for (MaterialInput& input : inputs) {
        const ParameterSpec& spec = *row.spec.find(input.name);
        const bool takes_texture = std::ranges::count(spec.types, ParameterType::kTexture) > 0;
        if (is_roughness(input) || !takes_texture) continue;
        const MaterialInput before = input;
        for (const float value : {0.3f, 0.9f, 1.7f, 3.3f}) {
          // At the ends of a range a lobe may vanish, as for an index of one.
          if (!(value > input.low && value < input.high)) continue;
          input.given = true;
          input.rgb = Rgb(value);
          input.numbers = {double(value), double(value), double(value)};
          const Lobes changed = lobes(row.make(MaterialInputs(inputs)));
          EXPECT_EQ(changed.diffuse, usual.diffuse) << row.spec.name << " " << input.name << " " << value;
          EXPECT_EQ(changed.specular, usual.specular) << row.spec.name << " " << input.name << " " << value;
          EXPECT_EQ(changed.glossy, usual.glossy) << row.spec.name << " " << input.name << " " << value;
        }
        input = before;
      }
    }
  }
}

}  // namespace
}  // namespace kaustik
