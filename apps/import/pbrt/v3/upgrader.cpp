#include "apps/import/pbrt/v3/upgrader.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "apps/import/common/make_parameter.h"
#include "apps/import/pbrt/v3/materials.h"
#include "core/scene/schema/schema.h"

namespace kaustik::pbrt {
namespace {

struct Renaming {
  std::string_view word, from, to;
};

constexpr Renaming kTypes[] = {
    {"Film", "image", "rgb"},
    {"Sampler", "02sequence", "paddedsobol"},
    {"Sampler", "lowdiscrepancy", "paddedsobol"},
    {"Sampler", "maxmindist", "pmj02bn"},
    {"Sampler", "random", "independent"},
    {"Integrator", "ao", "ambientocclusion"},
    {"LightSource", "exinfinite", "infinite"},
    {"AreaLightSource", "area", "diffuse"},
    {"MakeNamedMedium", "heterogeneous", "uniformgrid"},
};

// Renamed parameters whose meaning is the same or nearly so.
constexpr Renaming kParameters[] = {
    {"PixelFilter", "xwidth", "xradius"},
    {"PixelFilter", "ywidth", "yradius"},
    {"LightSource", "mapname", "filename"},
    {"Shape", "st", "uv"},
};

struct Dropped {
  std::string_view word, name, why;
};

constexpr Dropped kDropped[] = {
    {"Film", "maxsampleluminance", "samples are not clamped"},
    {"Sampler", "dimensions", "sample points have as many dimensions as they need"},
    {"Sampler", "samplepixelcenter", "samples are spread over the pixel"},
    {"LightSource", "nsamples", "the number of samples holds for the whole render"},
    {"LightSource", "samples", "the number of samples holds for the whole render"},
    {"AreaLightSource", "nsamples", "the number of samples holds for the whole render"},
    {"AreaLightSource", "samples", "the number of samples holds for the whole render"},
    {"Texture", "trilinear", "textures are filtered in another way"},
    {"Texture", "aamode", "textures are filtered in another way"},
    {"Shape", "shadowalpha", "shadows follow `alpha`"},
    {"Shape", "discarddegenerateUVs", "degenerate uv coordinates do no harm"},
};

void add_default(ParameterType type, std::string_view name, const std::vector<double>& value, Directive& d) {
  if (!d.find(name)) d.parameters.push_back(make_parameter(type, std::string(name), value, d.type_location));
}

void erase(Directive& d, std::string_view name) {
  std::erase_if(d.parameters, [&](const Parameter& p) { return p.name == name; });
}

}  // namespace

void V3Upgrader::warn_once(const std::string& key, const SourceLocation& where, std::string message) {
  if (warned_.insert(key).second) diagnostics_.warning(where, std::move(message));
}

void V3Upgrader::rename_type(std::string_view word, std::string_view from, std::string_view to,
                             Directive& d) {
  if (d.type != from) return;
  d.type = to;
  warn_once(fmt::format("{}/{}", word, from), d.type_location,
            fmt::format("`{} \"{}\"` of pbrt-v3 becomes \"{}\"", word, from, to));
}

void V3Upgrader::rename(std::string_view word, std::string_view from, std::string_view to, Directive& d) {
  Parameter* p = d.find(from);
  if (!p || d.find(to)) return;
  p->name = to;
  warn_once(fmt::format("{}/{}", word, from), p->location,
            fmt::format("`{}` of pbrt-v3's `{}` becomes `{}`", from, word, to));
}

void V3Upgrader::drop(std::string_view word, std::string_view name, std::string_view why, Directive& d) {
  const Parameter* p = d.find(name);
  if (!p) return;
  warn_once(fmt::format("{}/{}", word, name), p->location,
            fmt::format("`{}` of pbrt-v3's `{}` is ignored: {}", name, word, why));
  erase(d, name);
}

void V3Upgrader::upgrade(std::string_view word, Directive& d) {
  if (word == "Film" && d.type == "image") add_film_defaults(d);
  if (word == "MakeNamedMedium" && d.type == "heterogeneous") add_medium_defaults(d);
  for (const Renaming& r : kTypes) {
    if (r.word == word) rename_type(word, r.from, r.to, d);
  }
  if (word == "Material") return upgrade_material(d);
  if (word == "Film") upgrade_film(d);
  if (word == "LightSource" || word == "AreaLightSource") upgrade_light(d);
  if (word == "Texture") upgrade_texture(d);
  if (word == "Camera") upgrade_camera(d);
  if (word == "Shape") upgrade_shape(d);
  if (word == "PixelFilter" && d.type == "gaussian") drop(word, "alpha", "the width is `sigma`", d);
  for (const Renaming& r : kParameters) {
    if (r.word == word) rename(word, r.from, r.to, d);
  }
  for (const Dropped& r : kDropped) {
    if (r.word == word) drop(word, r.name, r.why, d);
  }
}

void V3Upgrader::upgrade_material(Directive& m) {
  if (m.type == "hair") rename("Material", "color", "reflectance", m);
  const std::string from = m.type;
  const std::string change = upgrade_v3_material(m, &extras_);
  if (!change.empty())
    warn_once(fmt::format("Material/{}/{}", from, change), m.type_location,
              fmt::format("pbrt-v3's material \"{}\" becomes {}", from, change));
}

// v3's image has another size by default, and the time for which the shutter is open does not darken it.
void V3Upgrader::add_film_defaults(Directive& film) {
  for (const auto& [name, type, value] : {std::tuple{"xresolution", ParameterType::kInteger, 640.0},
                                          std::tuple{"yresolution", ParameterType::kInteger, 480.0},
                                          std::tuple{"exposuretime", ParameterType::kFloat, 1.0}}) {
    add_default(type, name, std::vector<double>{value}, film);
  }
}

// v3's coefficients are the same by default for all media: those of homogeneous ones.
void V3Upgrader::add_medium_defaults(Directive& medium) {
  if (medium.find("preset")) return;
  for (const char* name : {"sigma_a", "sigma_s"})
    add_default(ParameterType::kRgb, name, medium_types().front().find(name)->defaults, medium);
}

// v3's `scale` multiplies the image, as `iso` / 100 does.
void V3Upgrader::upgrade_film(Directive& film) {
  Parameter* scale = film.find("scale");
  if (!scale || scale->numbers.size() != 1 || film.find("iso")) return;
  warn_once("Film/scale", scale->location, "`scale` of pbrt-v3's `Film` becomes `iso`, multiplied by 100");
  scale->name = "iso";
  scale->numbers[0] *= 100;
}

// v3's "environment" is v4's "spherical" with the mapping "equirectangular".
void V3Upgrader::upgrade_camera(Directive& camera) {
  if (camera.type != "environment") return;
  rename_type("Camera", "environment", "spherical", camera);
  camera.parameters.push_back(
      make_parameter(ParameterType::kString, "mapping", "equirectangular", camera.type_location));
}

// In v3, uv coordinates were declared as floats.
void V3Upgrader::upgrade_shape(Directive& shape) {
  for (const std::string_view name : {"uv", "st"}) {
    Parameter* p = shape.find(name);
    if (!p || p->type != ParameterType::kFloat) continue;
    p->type = ParameterType::kPoint2;
    warn_once("Shape/float uv", p->location, "`float uv` of pbrt-v3's `Shape` becomes `point2 uv`");
  }
  if (shape.type == "loopsubdiv") rename("Shape", "nlevels", "levels", shape);
}

// v4's "projection" light takes its colour from the image alone, so the luminance of `I` moves into `scale`.
void V3Upgrader::fold_intensity(Directive& light) {
  const Parameter* I = light.find("I");
  if (!I || I->type != ParameterType::kRgb || I->numbers.size() != 3) return;
  warn_once("Light/projection", I->location,
            "`I` of pbrt-v3's light \"projection\" becomes `scale`: its luminance multiplies the image");
  const double Y = 0.2126 * I->numbers[0] + 0.7152 * I->numbers[1] + 0.0722 * I->numbers[2];
  Parameter* scale = light.find("scale");
  if (scale)
    for (double& v : scale->numbers) v *= Y;
  else
    light.parameters.push_back(
        make_parameter(ParameterType::kFloat, "scale", std::vector<double>{Y}, I->location));
  erase(light, "I");
}

// v3's "uv" shows u as red and v as green: a "bilerp" of four corner colours does the same.
void V3Upgrader::upgrade_uv(Directive& texture) {
  rename_type("Texture", "uv", "bilerp", texture);
  const auto corner = [&](std::string_view name, double u, double v) {
    texture.parameters.push_back(make_parameter(ParameterType::kRgb, std::string(name),
                                                std::vector<double>{u, v, 0}, texture.type_location));
  };
  corner("v00", 0, 0), corner("v01", 0, 1), corner("v10", 1, 0), corner("v11", 1, 1);
}

// In v3, a light's `scale` was a colour.
void V3Upgrader::upgrade_light(Directive& light) {
  if (light.type == "projection") fold_intensity(light);
  const Parameter* scale = light.find("scale");
  if (!scale || scale->type != ParameterType::kRgb || scale->numbers.size() != 3) return;
  const std::string_view name = light.type == "point" || light.type == "spot" ||
                                        light.type == "goniometric" || light.type == "projection"
                                    ? "I"
                                    : "L";
  const Parameter factor = *scale;
  const bool grey = factor.numbers[0] == factor.numbers[1] && factor.numbers[1] == factor.numbers[2];
  Parameter* colour = light.find(name);
  if (!grey && colour && colour->type != ParameterType::kRgb) return;  // the schema check reports it
  if (!grey && colour && colour->numbers.size() != 3) return;
  erase(light, "scale");
  warn_once("Light/scale", factor.location,
            "`scale` of pbrt-v3's lights is a colour: it multiplies the light's own");
  if (grey) {
    light.parameters.push_back(factor);
    light.parameters.back().type = ParameterType::kFloat;
    light.parameters.back().numbers.resize(1);
    return;
  }
  colour = light.find(name);
  if (!colour) {
    light.parameters.push_back(factor);
    light.parameters.back().name = name;
    return;
  }
  for (size_t i = 0; i < 3; ++i) colour->numbers[i] *= factor.numbers[i];
}

void V3Upgrader::upgrade_texture(Directive& texture) {
  if (texture.type == "uv") upgrade_uv(texture);
  Parameter* gamma = texture.find("gamma");
  if (gamma && gamma->type == ParameterType::kBool && gamma->numbers.size() == 1) {
    warn_once("Texture/gamma", gamma->location, "`gamma` of pbrt-v3's `Texture` becomes `encoding`");
    gamma->name = "encoding";
    gamma->type = ParameterType::kString;
    gamma->strings = {gamma->numbers[0] != 0 ? "sRGB" : "linear"};
    gamma->numbers.clear();
  }
  if (texture.type == "scale" && texture.find("tex1") && texture.find("tex2")) {
    rename("Texture", "tex1", "tex", texture);
    rename("Texture", "tex2", "scale", texture);
  }
}

}  // namespace kaustik::pbrt
