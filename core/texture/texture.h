#pragma once
// The textures of pbrt-v4 (Pharr 2023, chapter 10) as value types; float textures are grey. A texture refers
// to other textures by index, which must come before it.

#include <memory>
#include <string_view>
#include <variant>
#include <vector>

#include "core/math/index.h"
#include "core/texture/image_lookup.h"
#include "core/texture/mapping.h"
#include "core/texture/noise.h"

namespace kaustik {

class TextureSet;

// A constant, or the value of another texture.
struct TextureOperand {
  Rgb value{0};
  uint32_t texture = kNoIndex;
};

// Arguments that evaluate() of a texture reads.
struct TextureContext {
  const TextureSet& set;
  const Transform& to_world;  // from texture space
  const TexturePoint& x;

  Rgb operator()(const TextureOperand& operand) const;
  // The point and its footprint in texture space.
  struct SolidCoordinates {
    Point3 p;
    Vector3 dpdx, dpdy;
  };
  SolidCoordinates solid() const {
    return {to_world.inverse_point(x.p), to_world.inverse_vector(x.dpdx), to_world.inverse_vector(x.dpdy)};
  }
  TextureCoordinates coordinates(const TextureMapping& mapping) const {
    return map_to_texture(mapping, to_world, x);
  }
};

struct ConstantTexture {
  static constexpr std::string_view kName = "constant";
  TextureOperand value{Rgb(1)};
  Rgb evaluate(const TextureContext& c) const { return c(value); }
};

struct ScaleTexture {
  static constexpr std::string_view kName = "scale";
  TextureOperand tex{Rgb(1)}, scale{Rgb(1)};
  Rgb evaluate(const TextureContext& c) const { return c(tex) * c(scale); }
};

// Blends linearly: (1 - amount) tex1 + amount tex2.
struct MixTexture {
  static constexpr std::string_view kName = "mix";
  TextureOperand tex1{Rgb(0)}, tex2{Rgb(1)}, amount{Rgb(0.5f)};
  Rgb evaluate(const TextureContext& c) const;
};

// Blends by direction: tex1 where the normal is along dir, tex2 where it is perpendicular.
struct DirectionMixTexture {
  static constexpr std::string_view kName = "directionmix";
  TextureOperand tex1{Rgb(0)}, tex2{Rgb(1)};
  Vector3 dir{0, 1, 0};  // world, unit
  Rgb evaluate(const TextureContext& c) const;
};

// Checkerboard of fields with side one: tex1 where the floors of the coordinates add up to an even number,
// else tex2. The average over the footprint is exact for a triangle filter (Pharr 2023, section 10.4.3).
struct CheckerboardTexture {
  static constexpr std::string_view kName = "checkerboard";
  TextureMapping mapping;
  bool solid = false;  // cubes in texture space instead of squares in uv
  TextureOperand tex1{Rgb(1)}, tex2{Rgb(0)};
  Rgb evaluate(const TextureContext& c) const;
};

// Discs of radius 0.35 at random positions, at most one in each field of side one.
struct DotsTexture {
  static constexpr std::string_view kName = "dots";
  TextureMapping mapping;
  TextureOperand in_dots{Rgb(0)}, between_dots{Rgb(1)};
  Rgb evaluate(const TextureContext& c) const;
};

// Interpolates bilinearly between the values at st = (0, 0), (0, 1), (1, 0) and (1, 1).
struct BilerpTexture {
  static constexpr std::string_view kName = "bilerp";
  TextureMapping mapping;
  Rgb v00{0}, v01{1}, v10{0}, v11{1};
  Rgb evaluate(const TextureContext& c) const;
};

// Looks up an image; t points up in the image.
struct ImageTexture {
  static constexpr std::string_view kName = "imagemap";
  TextureMapping mapping;
  uint32_t image = 0;
  ImageSampling sampling;
  float scale = 1;
  bool invert = false;
  bool grey = false;  // float texture: uses the first channel
  Rgb evaluate(const TextureContext& c) const;
};

// Sums of noise in texture space (core/texture/noise.h).
struct FbmTexture {
  static constexpr std::string_view kName = "fbm";
  Octaves octaves;
  Rgb evaluate(const TextureContext& c) const;
};
struct WrinkledTexture {
  static constexpr std::string_view kName = "wrinkled";
  Octaves octaves;
  Rgb evaluate(const TextureContext& c) const;
};

// Water waves whose height follows the wind (Pharr 2004, section 11.6.4).
struct WindyTexture {
  static constexpr std::string_view kName = "windy";
  Rgb evaluate(const TextureContext& c) const;
};

// Veins across the y axis of texture space, displaced by noise (Pharr 2004, section 11.6.5).
struct MarbleTexture {
  static constexpr std::string_view kName = "marble";
  Octaves octaves;
  float scale = 1, variation = 0.2f;
  Rgb evaluate(const TextureContext& c) const;
};

// The colour of the mesh's vertices, interpolated. A float texture is their alpha.
struct VertexColourTexture {
  static constexpr std::string_view kName = "vertexcolor";
  bool alpha = false;
  Rgb evaluate(const TextureContext& c) const { return alpha ? Rgb(c.x.colour.w) : Rgb(c.x.colour); }
};

using Texture = std::variant<ConstantTexture, ScaleTexture, MixTexture, DirectionMixTexture,
                             CheckerboardTexture, DotsTexture, BilerpTexture, ImageTexture, FbmTexture,
                             WrinkledTexture, WindyTexture, MarbleTexture, VertexColourTexture>;

// All textures of a scene. Thread-safe once it is built and no longer changed.
class TextureSet {
 public:
  // Adds a texture and returns its index. Its operands must refer to textures already added.
  uint32_t add(Texture texture, const Transform& to_world);
  // Changes a texture's transform, for scenes that get a local origin after their textures were made.
  void set_transform(uint32_t texture, const Transform& to_world) { nodes_[texture].to_world = to_world; }
  void set_images(std::shared_ptr<const ImageLibrary> images) { images_ = std::move(images); }
  Texture& texture(uint32_t index) { return nodes_[index].texture; }

  Rgb evaluate(uint32_t texture, const TexturePoint& x) const;
  float evaluate_float(uint32_t texture, const TexturePoint& x) const { return evaluate(texture, x).x; }

  const ImageLibrary& images() const { return *images_; }
  uint64_t bytes_to_come() const { return images_ ? images_->bytes_to_come() : 0; }  // see ImageLibrary
  size_t size() const { return nodes_.size(); }

 private:
  struct Node {
    Texture texture;
    Transform to_world;
  };
  std::vector<Node> nodes_;
  std::shared_ptr<const ImageLibrary> images_;
};

}  // namespace kaustik
