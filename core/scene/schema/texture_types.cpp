// Schema rows of textures.

#include "core/scene/schema/parameter_spec.h"

namespace kaustik {
namespace {

using namespace spec;

// A number, a colour (in spectrum textures) or another texture.
ParameterSpec operand(std::string_view name, double value, std::string_view doc) {
  ParameterSpec p = rgb(name, value, "", kAnyNumber, doc);
  p.types.push_back(ParameterType::kFloat);
  return textured(std::move(p));
}
ParameterSpec corner(std::string_view name, double value) {
  ParameterSpec p = rgb(name, value, "", kAnyNumber, "value at s, t as its name says");
  p.types.push_back(ParameterType::kFloat);
  return p;
}

ParameterSpec axis(std::string_view name, const glm::dvec3& v, std::string_view doc) {
  return of_type(ParameterType::kVector3, name, {v.x, v.y, v.z}, "1/m", kAnyNumber, doc);
}

std::vector<ParameterSpec> mapped(std::vector<ParameterSpec> own) {
  own.push_back(text("mapping", "uv", "`uv`, `spherical`, `cylindrical` or `planar`"));
  own.push_back(number("uscale", 1, "", kAnyNumber, "of `uv`: s = uscale u + udelta"));
  own.push_back(number("vscale", 1, "", kAnyNumber, "of `uv`: t = vscale v + vdelta"));
  own.push_back(number("udelta", 0, "", kAnyNumber, "of `uv` and `planar`"));
  own.push_back(number("vdelta", 0, "", kAnyNumber, "of `uv` and `planar`"));
  own.push_back(axis("v1", {1, 0, 0}, "of `planar`: s = v1 . p + udelta, p in texture space"));
  own.push_back(axis("v2", {0, 1, 0}, "of `planar`: t = v2 . p + vdelta"));
  return own;
}

// Adds the parameters of noise; each octave costs one evaluation.
std::vector<ParameterSpec> octaves(std::vector<ParameterSpec> own) {
  own.push_back(integer("octaves", 8, "", {1, 32}, "how many sums of noise, each finer than the one before"));
  own.push_back(
      number("roughness", 0.5, "", kNotNegative, "strength of an octave over that of the one before"));
  return own;
}

std::vector<TypeSpec> make_texture_types() {
  return {
      {"constant", "One value everywhere.", {operand("value", 1, "the value")}},
      {"scale",
       "The product of two textures.",
       {operand("tex", 1, "what is scaled"),
        operand("scale", 1, "by what; a float texture, or of colours also a spectrum texture")}},
      {"mix",
       "(1 - amount) tex1 + amount tex2.",
       {operand("tex1", 0, "where amount is 0"), operand("tex2", 1, "where amount is 1"),
        textured(number("amount", 0.5, "", kAnyNumber, "share of tex2"))}},
      {"directionmix",
       "tex1 where the surface's normal lies along `dir`, tex2 where it is perpendicular.",
       {operand("tex1", 0, "along"), operand("tex2", 1, "across"),
        of_type(ParameterType::kVector3, "dir", {0, 1, 0}, "", kAnyNumber, "in texture space")}},
      {"checkerboard", "Fields of side one, averaged over the footprint of a pixel.",
       mapped({operand("tex1", 1, "where floor(s) + floor(t) is even"), operand("tex2", 0, "elsewhere"),
               integer("dimension", 2, "", {2, 3}, "3: cubes of texture space")})},
      {"dots",
       "Discs of radius 0.35, at most one in each field of side one. The names are exchanged, as pbrt-v4 "
       "renders them.",
       mapped({operand("inside", 1, "between the discs"), operand("outside", 0, "on the discs")})},
      {"bilerp", "Bilinear between four values.",
       mapped({corner("v00", 0), corner("v01", 1), corner("v10", 0), corner("v11", 1)})},
      {"imagemap", "An image; t points up. Of float textures the first channel counts.",
       mapped({text("filename", "required", "beside the scene file, unless absolute"),
               text("wrap", "repeat", "outside of 0 to 1: `repeat`, `black` or `clamp`"),
               text("filter", "bilinear", "`point`, `bilinear`, `trilinear` or `EWA`, on MIP levels"),
               number("maxanisotropy", 8, "", {1, 64}, "of `EWA`: longest over shortest axis"),
               text("encoding", "sRGB for integers",
                    "of integers: `sRGB`, `linear` or `gamma` and a number, as \"gamma 2.2\""),
               number("scale", 1, "", kAnyNumber, "multiplies the value"),
               flag("invert", false, "one minus the value, after `scale`")})},
      {"fbm", "Noise in texture space, summed over octaves: fractional Brownian motion.", octaves({})},
      {"wrinkled", "The same of the noise's absolute value.", octaves({})},
      {"windy", "Waves of water.", {}},
      {"marble", "Veins across y of texture space.",
       octaves({number("scale", 1, "1/m", kAnyNumber, "multiplies the point"),
                number("variation", 0.2, "", kAnyNumber, "how far noise displaces the veins")})},
  };
}

}  // namespace

const std::vector<TypeSpec>& texture_types() {
  static const std::vector<TypeSpec> types = make_texture_types();
  return types;
}

}  // namespace kaustik
