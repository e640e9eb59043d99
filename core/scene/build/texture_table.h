#pragma once
// The textures of a description, made and found by name.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/schema/schema.h"
#include "core/texture/texture.h"

namespace kaustik {

// What is made of a texture: float textures and spectrum textures have names of their own, as in pbrt.
enum class TextureValue { kFloat, kSpectrum };

class TextureTable {
 public:
  // Makes every texture and reads its images, in parallel; reports bad ones, and names that are given twice.
  // A texture may name those that are defined before it. images.load may be empty: then images are errors.
  TextureTable(const SceneDescription& description, const ImageLoader& images, WarnedOnce& warned,
               DiagnosticList& diagnostics);

  // The texture that a parameter of type kTexture names; kNoIndex, with an error, where nobody defined it.
  uint32_t find(const Parameter& parameter, TextureValue value, DiagnosticList& diagnostics) const;
  // Of a normal map: an image without encoding. Nothing after an error.
  std::optional<uint32_t> load_linear_image(const std::string& filename, const SourceLocation& where,
                                            DiagnosticList& diagnostics) const;

  const TextureSet& set() const { return *set_; }
  // For what looks textures up when the scene is complete.
  std::shared_ptr<const TextureSet> shared_set() const { return set_; }
  // Hands the textures over, for a scene around this origin.
  std::shared_ptr<const TextureSet> finish(const glm::dvec3& origin);

 private:
  // Images are read when all textures are known.
  struct ImageRequest {
    uint32_t texture = 0;
    std::string filename;
    SourceLocation where;
    ImageEncoding encoding;
    ImageResult result;
  };
  class Maker;

  void add(const TextureDescription& texture, WarnedOnce& warned, DiagnosticList& diagnostics);
  void load_images(DiagnosticList& diagnostics);
  auto& names(TextureValue value) { return by_name_[value == TextureValue::kSpectrum]; }
  const auto& names(TextureValue value) const { return by_name_[value == TextureValue::kSpectrum]; }

  const SceneDescription& description_;
  const ImageLoader& images_;
  std::shared_ptr<TextureSet> set_ = std::make_shared<TextureSet>();
  std::vector<glm::dmat4> to_world_;  // of the set's textures
  std::vector<uint64_t> cost_;        // lookups that an evaluation takes, of the set's textures
  std::vector<ImageRequest> requests_;
  std::map<std::string, uint32_t, std::less<>> by_name_[2];
};

}  // namespace kaustik
