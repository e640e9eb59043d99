// Schema rows of film, sampler, accelerator and options, and the list of all categories.

#include <algorithm>

#include "core/scene/schema/parameter_spec.h"

namespace kaustik {
namespace {

using namespace spec;
using Type = ParameterType;

std::vector<TypeSpec> make_film_types() {
  ParameterSpec crop = list(Type::kFloat, "cropwindow", 4, "0 1 0 1", "",
                            "x min, x max, y min, y max, as shares of the image");
  crop.max_items = 4;
  crop.range = kUnit;
  ParameterSpec bounds =
      list(Type::kInteger, "pixelbounds", 4, "all", "pixels", "x min, x max, y min, y max, half open");
  bounds.max_items = 4;
  bounds.range = kNotNegative;
  const Range side{1, 1 << 20};
  TypeSpec rgb{
      "rgb",
      "The image.",
      {integer("xresolution", 1280, "pixels", side, "width"),
       integer("yresolution", 720, "pixels", side, "height"),
       text("filename", "named after the scene", "name of the image file; the command line may give another"),
       crop, bounds, number("diagonal", 35, "mm", kPositive, "affects only pbrt's realistic camera"),
       text("sensor", "cie1931",
            "only `cie1931` is available, in linear Rec. 709; pbrt's other sensors are replaced by it"),
       number("iso", 100, "", kPositive, "radiance is multiplied by iso / 100"),
       without_default(number("exposuretime", 1, "s", kPositive, "radiance is multiplied by it"),
                       "shutterclose - shutteropen"),
       number("whitebalance", 0, "K", {0, 25000},
              "colour temperature of the light that becomes white; 0: no white balance"),
       ignored("maxcomponentvalue", {Type::kFloat}, "samples are not clamped"),
       ignored("savefp16", {Type::kBool}, "layers are 32-bit floats")}};
  TypeSpec gbuffer = rgb, spectral = rgb;
  gbuffer.name = "gbuffer";
  gbuffer.approximated = "as \"rgb\"; the layers are chosen on the command line";
  gbuffer.parameters.push_back(
      ignored("coordinatesystem", {Type::kString}, "layers are in world coordinates"));
  spectral.name = "spectral";
  spectral.approximated = "as \"rgb\": light is rendered in three colours";
  spectral.parameters.push_back(ignored("nbuckets", {Type::kInteger}, "light is rendered in three colours"));
  for (const std::string_view name : {"lambdamin", "lambdamax"})
    spectral.parameters.push_back(ignored(name, {Type::kFloat}, "light is rendered in three colours"));
  return {std::move(rgb), std::move(gbuffer), std::move(spectral)};
}

std::vector<TypeSpec> make_sampler_types() {
  const ParameterSpec seed = ignored("seed", {Type::kInteger}, "the seed is chosen on the command line");
  const ParameterSpec scrambling =
      ignored("randomization", {Type::kString}, "the points are always Owen-scrambled Sobol points");
  const ParameterSpec samples = integer("pixelsamples", 16, "", {1, 1 << 30}, "samples per pixel");
  std::vector<TypeSpec> types;
  for (const std::string_view name : {"halton", "independent", "paddedsobol", "pmj02bn", "sobol", "zsobol"}) {
    types.push_back({name,
                     "Gives the samples per pixel; the points are always Owen-scrambled Sobol points.",
                     {samples, seed, scrambling}});
  }
  types.push_back({"stratified",
                   "Gives xsamples times ysamples samples per pixel.",
                   {integer("xsamples", 4, "", {1, 1 << 15}, "columns of strata"),
                    integer("ysamples", 4, "", {1, 1 << 15}, "rows of strata"), seed,
                    ignored("jitter", {Type::kBool}, "samples are always jittered")}});
  return types;
}

std::vector<TypeSpec> make_accelerator_types() {
  return {{"bvh",
           "Accepted; Embree builds its own BVH.",
           {ignored("maxnodeprims", {Type::kInteger}, "a parameter of pbrt's own accelerator"),
            ignored("splitmethod", {Type::kString}, "a parameter of pbrt's own accelerator")}},
          {"kdtree",
           "Accepted; Embree builds its own BVH.",
           {ignored("intersectcost", {Type::kInteger}, "a parameter of pbrt's own accelerator"),
            ignored("traversalcost", {Type::kInteger}, "a parameter of pbrt's own accelerator"),
            ignored("emptybonus", {Type::kFloat}, "a parameter of pbrt's own accelerator"),
            ignored("maxprims", {Type::kInteger}, "a parameter of pbrt's own accelerator"),
            ignored("maxdepth", {Type::kInteger}, "a parameter of pbrt's own accelerator")}}};
}

TypeSpec make_option_type() {
  TypeSpec type{"", "Settings of the program pbrt.", {}};
  for (const std::string_view name : {"disablepixeljitter", "disabletexturefiltering",
                                      "disablewavelengthjitter", "forcediffuse", "pixelstats", "wavefront"}) {
    type.parameters.push_back(ignored(name, {Type::kBool}, "a setting of the program pbrt", 0));
  }
  type.parameters.push_back(
      ignored("displacementedgescale", {Type::kFloat}, "a setting of the program pbrt", 1));
  for (const std::string_view name : {"msereferenceimage", "msereferenceout", "rendercoordsys"}) {
    type.parameters.push_back(ignored(name, {Type::kString}, "a setting of the program pbrt"));
  }
  type.parameters.push_back(ignored("seed", {Type::kInteger}, "the seed is chosen on the command line"));
  return type;
}

template <class Row>
std::vector<const TypeSpec*> specs_of(const std::vector<Row>& rows) {
  std::vector<const TypeSpec*> specs;
  for (const Row& row : rows) {
    if constexpr (std::is_same_v<Row, TypeSpec>) {
      specs.push_back(&row);
    } else {
      specs.push_back(&row.spec);
    }
  }
  return specs;
}

std::vector<Category> make_categories() {
  return {
      {"Camera", "camera", specs_of(camera_types()), {}},
      {"Film", "film", specs_of(film_types()), {}},
      {"Sampler", "sampler", specs_of(sampler_types()), {}},
      {"PixelFilter", "pixel filter", specs_of(filter_types()), {}},
      {"Accelerator", "accelerator", specs_of(accelerator_types()), {}},
      {"Material", "material", specs_of(material_rows()), {}},
      {"Texture", "texture", specs_of(texture_types()), {}},
      {"MakeNamedMedium", "medium", specs_of(medium_types()), {"cloud", "nanovdb", "rgbgrid"}},
      {"Shape", "shape", specs_of(shape_rows()), {}},
      {"AreaLightSource", "area light", specs_of(area_light_types()), {}},
      {"LightSource", "light", specs_of(light_rows()), {}},
  };
}

}  // namespace

const std::vector<TypeSpec>& film_types() {
  static const std::vector<TypeSpec> types = make_film_types();
  return types;
}
const std::vector<TypeSpec>& sampler_types() {
  static const std::vector<TypeSpec> types = make_sampler_types();
  return types;
}
const std::vector<TypeSpec>& accelerator_types() {
  static const std::vector<TypeSpec> types = make_accelerator_types();
  return types;
}
const TypeSpec& option_type() {
  static const TypeSpec type = make_option_type();
  return type;
}
const std::vector<Category>& categories() {
  static const std::vector<Category> all = make_categories();
  return all;
}
const Category& category(std::string_view directive) {
  return *std::find_if(categories().begin(), categories().end(),
                       [&](const Category& c) { return c.directive == directive; });
}

}  // namespace kaustik
