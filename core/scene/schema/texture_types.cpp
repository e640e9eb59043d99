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
  ParameterSpec p = rgb(name, value, "", kAnyNumber, "value at the (s, t) in its name");
  p.types.push_back(ParameterType::kFloat);
  return p;
}

ParameterSpec axis(std::string_view name, const glm::dvec3& v, std::string_view doc) {
  return of_type(ParameterType::kVector3, name, {v.x, v.y, v.z}, "1/m", kAnyNumber, doc);
}

std::vector<ParameterSpec> mapped(std::vector<ParameterSpec> own) {
  own.push_back(text("mapping", "uv", "`uv`, `spherical`, `cylindrical` or `planar`"));
  own.push_back(number("uscale", 1, "", kAnyNumber, "for `uv`: s = uscale u + udelta"));
  own.push_back(number("vscale", 1, "", kAnyNumber, "for `uv`: t = vscale v + vdelta"));
  own.push_back(number("udelta", 0, "", kAnyNumber, "for `uv` and `planar`: offset of s"));
  own.push_back(number("vdelta", 0, "", kAnyNumber, "for `uv` and `planar`: offset of t"));
  own.push_back(number("ushear", 0, "", kAnyNumber, "for `uv`: s grows by ushear v. Not in pbrt"));
  own.push_back(number("vshear", 0, "", kAnyNumber, "for `uv`: t grows by vshear u. Not in pbrt"));
  own.push_back(axis("v1", {1, 0, 0}, "for `planar`: s = v1 . p + udelta, p in texture space"));
  own.push_back(axis("v2", {0, 1, 0}, "for `planar`: t = v2 . p + vdelta"));
  return own;
}

// Adds the parameters of noise; each octave costs one evaluation.
std::vector<ParameterSpec> octaves(std::vector<ParameterSpec> own) {
  own.push_back(
      integer("octaves", 8, "", {1, 32}, "number of octaves of noise, each finer than the previous one"));
  own.push_back(
      number("roughness", 0.5, "", kNotNegative, "amplitude of each octave relative to the previous one"));
  return own;
}

std::vector<TypeSpec> make_texture_types() {
  return {
      {"constant", "One value everywhere.", {operand("value", 1, "the value")}},
      {"scale",
       "The product of two textures.",
       {operand("tex", 1, "the value to scale"),
        operand("scale", 1, "factor: a float texture, or for colours also a spectrum texture")}},
      {"mix",
       "Linear interpolation: (1 - amount) tex1 + amount tex2.",
       {operand("tex1", 0, "value where `amount` is 0"), operand("tex2", 1, "value where `amount` is 1"),
        textured(number("amount", 0.5, "", kAnyNumber, "share of tex2"))}},
      {"directionmix",
       "tex1 where the surface's normal lies along `dir`, tex2 where it is perpendicular.",
       {operand("tex1", 0, "value along `dir`"), operand("tex2", 1, "value across `dir`"),
        of_type(ParameterType::kVector3, "dir", {0, 1, 0}, "", kAnyNumber, "direction in texture space")}},
      {"checkerboard", "Fields of side one, averaged over the footprint of a pixel.",
       mapped({operand("tex1", 1, "value where floor(s) + floor(t) is even"),
               operand("tex2", 0, "value elsewhere"),
               integer("dimension", 2, "", {2, 3}, "2: squares of (s, t); 3: cubes in texture space")})},
      {"dots",
       "Discs of radius 0.35, at most one in each field of side one. `inside` and `outside` are swapped, as "
       "in "
       "pbrt-v4.",
       mapped(
           {operand("inside", 1, "value between the discs"), operand("outside", 0, "value on the discs")})},
      {"bilerp", "Bilinear interpolation between four values.",
       mapped({corner("v00", 0), corner("v01", 1), corner("v10", 0), corner("v11", 1)})},
      {"imagemap", "An image; t points up. Float textures use the first channel.",
       mapped(
           {text("filename", "required", "path, relative to the scene file"),
            text("wrap", "repeat", "outside [0, 1]: `repeat`, `black` or `clamp`; `mirror` is not in pbrt"),
            text("vwrap", "wrap", "the same along t. Not in pbrt"),
            text("filter", "bilinear", "`point`, `bilinear`, `trilinear` or `EWA`, with MIP levels"),
            number("maxanisotropy", 8, "", {1, 64}, "for `EWA`: limit on the longest over the shortest axis"),
            text(
                "encoding", "sRGB for integers",
                "encoding of integers: `sRGB`, `linear`, or `gamma` and a number, for example \"gamma 2.2\""),
            number("scale", 1, "", kAnyNumber, "factor on the value"),
            flag("invert", false, "replaces the value by one minus the value, after `scale`")})},
      {"fbm", "Noise in texture space, summed over octaves: fractional Brownian motion.", octaves({})},
      {"wrinkled", "The absolute value of noise in texture space, summed over octaves: turbulence.",
       octaves({})},
      {"windy", "Water waves.", {}},
      {"marble", "Marble veins across the y axis of texture space.",
       octaves({number("scale", 1, "1/m", kAnyNumber, "factor on the coordinates of the point"),
                number("variation", 0.2, "", kAnyNumber, "strength of the noise that displaces the veins")})},
      {"vertexcolor",
       "The colour of a mesh's vertices, interpolated; as a float texture their alpha. 1 where there is "
       "none. "
       "Not in pbrt.",
       {}},
  };
}

}  // namespace

const std::vector<TypeSpec>& texture_types() {
  static const std::vector<TypeSpec> types = make_texture_types();
  return types;
}

}  // namespace kaustik
