#pragma once
// Converts the images of a glTF file to pbrt textures. Images embedded in the file, and those that pbrt
// cannot express (one channel of an image, a factor), are written to a temporary folder that lives as long as
// the scene.

#include <functional>
#include <map>

#include "apps/import/common/derived_image.h"
#include "apps/import/common/made_files.h"
#include "apps/import/common/make_parameter.h"
#include "apps/import/common/warnings.h"
#include "apps/import/gltf/file/document.h"
#include "core/scene/description/description.h"

namespace kaustik::gltf {

// Texture coordinates of a mesh: a set of the file's, and the matrix that is applied to (u, v, 1).
struct UvSource {
  uint64_t set = 0;
  glm::dmat3 transform{1};
};

// The matrix of a textureInfo's KHR_texture_transform.
glm::dmat3 uv_transform_of(const View& info);

// The set of texture coordinates that a textureInfo of glTF uses; KHR_texture_transform may override it.
uint64_t uv_set_of(const View& info);

// An image file; its name is relative to the folder of the file at `where`.
struct ImageFile {
  std::string name;
  SourceLocation where;
};

class Textures {
 public:
  // pixels: whether copies of images with other values are needed; otherwise the images themselves stand for
  // them.
  Textures(const Document& document, std::filesystem::path path, bool pixels, FileWarnings& warnings,
           SourceFiles& files, SceneDescription& scene)
      : document_(document),
        path_(std::move(path)),
        pixels_(pixels),
        warnings_(warnings),
        files_(files),
        scene_(scene) {}

  // The matrix that was applied to the texture coordinates of the mesh that the next textures are for; it has
  // an inverse. Textures make up for it.
  void set_uv_of_mesh(const glm::dmat3& transform) { uv_of_mesh_ = transform; }

  // The following functions take a textureInfo of glTF. They return nothing when it names no image or, with a
  // warning, when the image cannot be read.
  //
  // Adds a colour texture, raised to `exponent` and multiplied by `factor`, to the scene and returns its
  // name.
  std::optional<std::string> colour(const View& info, const glm::dvec3& factor, double exponent = 1);
  // Adds a float texture of one channel (0 to 3) and returns its name. `map` is applied to each value and
  // must return 0 to 1.
  std::optional<std::string> channel(const View& info, int channel, const std::function<double(double)>& map);
  // The image file; the second function returns a copy with its colours changed as colour() changes them.
  std::optional<ImageFile> file(const View& info);
  std::optional<ImageFile> tinted_file(const View& info, const glm::dvec3& factor, double exponent = 1);
  // The mean colour in linear light.
  std::optional<glm::dvec3> mean(const View& info);
  // The mean of the stored numbers of one channel (0 to 3).
  std::optional<double> mean_of_channel(const View& info, int channel);

  // Adds a texture of the colours of vertices, times a texture or else a constant, and returns its name. The
  // second function does so for their alpha.
  std::string by_vertex(const std::optional<std::string>& texture, const glm::dvec3& factor);
  std::string by_vertex_alpha(const std::optional<std::string>& texture, double factor);

  // The parameter `"texture name" [ texture ]`.
  Parameter parameter(const std::string& name, const std::string& texture) const;
  static Parameter file_parameter(const std::string& name, const ImageFile& file);

 private:
  std::optional<uint64_t> image_of(const View& info);
  // The file of an image, made on first use; nothing if there is none that can be read.
  std::optional<ImageFile> file_of_image(uint64_t image);
  std::optional<ImageFile> make_file(uint64_t image);
  std::optional<ImageFile> find_file(uint64_t image, const std::string& name);
  const std::optional<ImageMeans>& means(const ImageFile& file);
  std::string vertex_texture(const std::string& value_type);
  std::string scaled(const std::string& value_type, Parameter value, const std::string& scale);
  DirectiveMaker<TextureDescription> start(const std::string& type, const std::string& value_type);
  ReadableFile place_of(const ImageFile& file) const;
  ImageFile in_folder(const std::string& name);
  std::string add(const std::string& value_type, const ImageFile& file, const std::string& encoding,
                  const View& info);

  const Document& document_;
  std::filesystem::path path_;
  bool pixels_;
  FileWarnings& warnings_;
  SourceFiles& files_;
  SceneDescription& scene_;
  std::optional<MadeFiles> made_;  // embedded images, and those that are made from others
  std::map<uint64_t, std::optional<ImageFile>> images_;
  std::map<std::filesystem::path, std::optional<ImageMeans>> means_;
  std::map<std::string, std::string> vertex_textures_;  // names by the type of value
  uint64_t derived_ = 0;
  glm::dmat3 uv_of_mesh_{1};
};

}  // namespace kaustik::gltf
