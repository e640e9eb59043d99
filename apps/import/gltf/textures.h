#pragma once
// Images of a glTF file as textures of pbrt. Those that lie within the file, and those that pbrt has no words
// for (one channel of an image, a factor), are written to a folder that lives as long as the scene.

#include <functional>
#include <map>

#include "apps/import/gltf/document.h"
#include "apps/import/temporary_folder.h"
#include "apps/import/warnings.h"
#include "core/scene/description/description.h"

namespace kaustik::gltf {

// A file and the place whose folder its name is relative to.
struct ImageFile {
  std::string name;
  SourceLocation where;
};

class Textures {
 public:
  Textures(const Document& document, std::filesystem::path path, FileWarnings& warnings, SourceFiles& files,
           SceneDescription& scene)
      : document_(document), path_(std::move(path)), warnings_(warnings), files_(files), scene_(scene) {}

  // All of these take a textureInfo of glTF and give nothing when it names no image, or one that cannot be
  // read (with a warning). Names of textures that are added to the scene:
  std::optional<std::string> colour(const View& info, const glm::dvec3& factor);
  // A channel (0 to 3) as numbers; map is applied to each, and gives 0 to 1.
  std::optional<std::string> channel(const View& info, int channel, const std::function<double(double)>& map);
  // The image itself, and that of its colours times a factor.
  std::optional<ImageFile> file(const View& info);
  std::optional<ImageFile> tinted_file(const View& info, const glm::dvec3& factor);
  // Its mean colour: linear, or the mean of the numbers where they are not sRGB.
  std::optional<glm::dvec3> mean(const View& info, bool srgb = true);

  // "texture name" [ texture ]
  Parameter parameter(const std::string& name, const std::string& texture) const;
  static Parameter file_parameter(const std::string& name, const ImageFile& file);

 private:
  std::optional<uint64_t> image_of(const View& info);
  std::optional<ImageFile> file_of_image(uint64_t image);
  std::filesystem::path path_of(const ImageFile& file) const;
  ImageFile in_folder(const std::string& name);
  std::string add(const std::string& value_type, const ImageFile& file, const std::string& encoding,
                  const View& info);

  const Document& document_;
  std::filesystem::path path_;
  FileWarnings& warnings_;
  SourceFiles& files_;
  SceneDescription& scene_;
  std::shared_ptr<TemporaryFolder> folder_;
  uint32_t folder_file_ = 0;  // a name in the folder, which its files are beside
  std::map<uint64_t, std::optional<ImageFile>> images_;
  std::map<std::string, std::string> made_;  // textures by what they were made from
  uint64_t derived_ = 0;
};

}  // namespace kaustik::gltf
