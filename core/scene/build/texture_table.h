#pragma once
// The textures of a description, by name.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/schema/schema.h"
#include "core/texture/texture.h"

namespace kaustik {

// Type of a texture's value. Float and spectrum textures have separate names, as in pbrt.
enum class TextureValue { kFloat, kSpectrum };

class TextureTable {
 public:
  // Makes every texture and reads the images in parallel; reports invalid textures and names defined twice. A
  // texture may refer to textures defined before it. If images.load is empty, image textures are errors.
  TextureTable(const SceneDescription& description, const ImageLoader& images, WarnedOnce& warned,
               DiagnosticList& diagnostics);

  // The texture named by a parameter of type kTexture, or kNoIndex, with an error, if it is not defined. A
  // texture of the other type stands in, with a warning.
  uint32_t find(const Parameter& parameter, TextureValue value, DiagnosticList& diagnostics) const;
  // Loads the image of a normal map, without decoding its values. Returns nothing after an error.
  std::optional<uint32_t> load_linear_image(const std::string& filename, const SourceLocation& where,
                                            DiagnosticList& diagnostics) const;

  const TextureSet& set() const { return *set_; }
  // The textures, for objects that look them up once the scene is complete.
  std::shared_ptr<const TextureSet> shared_set() const { return set_; }
  // Returns the finished textures, relative to this origin; call it once, at the end.
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
  ImageResult load_image(const std::string& filename, const SourceLocation& where,
                         const ImageEncoding& encoding) const;
  // Gives the set the library, which exists from the first image on.
  void share_library() const;
  void load_images(DiagnosticList& diagnostics);
  void report_unreadable(const SourceLocation& where, const std::string& error,
                         DiagnosticList& diagnostics) const;
  auto& names(TextureValue value) { return by_name_[value == TextureValue::kSpectrum]; }
  const auto& names(TextureValue value) const { return by_name_[value == TextureValue::kSpectrum]; }

  const SceneDescription& description_;
  const ImageLoader& images_;
  std::shared_ptr<TextureSet> set_ = std::make_shared<TextureSet>();
  std::vector<glm::dmat4> to_world_;  // transforms of the set's textures
  std::vector<uint64_t> cost_;        // lookups per evaluation, for each of the set's textures
  std::vector<ImageRequest> requests_;
  std::map<std::string, uint32_t, std::less<>> by_name_[2];
  // By type of value and name, where each texture is defined first.
  std::map<std::pair<std::string_view, std::string_view>, SourceLocation> first_;
};

}  // namespace kaustik
