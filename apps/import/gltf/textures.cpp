#include "apps/import/gltf/textures.h"

#include <fmt/format.h>

#include <fstream>

#include "apps/import/common/derived_image.h"
#include "apps/import/common/make_parameter.h"
#include "apps/import/common/scene_files.h"

namespace kaustik::gltf {
namespace {

// The file extension that fits the image's first bytes: OpenImageIO chooses the format by it.
std::string extension_of(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return ".png";
  if (bytes.starts_with("\xff\xd8")) return ".jpg";
  if (bytes.size() > 12 && bytes.starts_with("RIFF") && bytes.substr(8, 4) == "WEBP") return ".webp";
  return "";
}

}  // namespace

Parameter Textures::parameter(const std::string& name, const std::string& texture) const {
  return make_parameter(ParameterType::kTexture, name, texture, warnings_.where());
}

Parameter Textures::file_parameter(const std::string& name, const ImageFile& file) {
  return make_parameter(ParameterType::kString, name, file.name, file.where);
}

std::optional<uint64_t> Textures::image_of(const View& info) {
  const auto texture = info["index"].index(document_.size("textures"));
  if (!texture) return std::nullopt;
  const View t = document_.item("textures", *texture);
  auto source = t["source"].index(document_.size("images"));
  if (!source) source = t["extensions"]["EXT_texture_webp"]["source"].index(document_.size("images"));
  if (!source)
    warnings_.say("textures without a PNG, JPEG or WebP image (such as KHR_texture_basisu) are ignored");
  return source;
}

ImageFile Textures::in_folder(const std::string& name) {
  if (!folder_) {
    folder_ = std::make_shared<TemporaryFolder>();
    scene_.keeps = folder_;
    folder_file_ = files_.add((folder_->path() / "embedded").string(), "");
  }
  return {name, {folder_file_, 0, 0}};
}

std::filesystem::path Textures::path_of(const ImageFile& file) const {
  return pbrt::resolve_path(file.name, files_.name(file.where.file), path_);
}

std::optional<ImageFile> Textures::file_of_image(uint64_t index) {
  const auto found = images_.find(index);
  if (found != images_.end()) return found->second;
  const View image = document_.item("images", index);
  const View uri = image["uri"];
  std::optional<std::string> data;
  if (uri) {
    data = Document::data_of_uri(uri);
    if (!data) return images_[index] = ImageFile{Document::file_of_uri(uri.text()), {document_.file(), 0, 0}};
  } else if (const auto view = image["bufferView"].index(document_.size("bufferViews"))) {
    data = std::string(document_.bytes_of_view(*view));
  }
  const std::string extension = data ? extension_of(*data) : "";
  if (extension.empty()) {
    warnings_.say(fmt::format("image {} is neither PNG nor JPEG nor WebP and is ignored", index));
    images_[index] = std::nullopt;
    return std::nullopt;
  }
  const ImageFile file = in_folder(fmt::format("image{}{}", index, extension));
  std::ofstream(path_of(file), std::ios::binary) << *data;
  return images_[index] = file;
}

std::optional<ImageFile> Textures::file(const View& info) {
  const auto image = info ? image_of(info) : std::nullopt;
  return image ? file_of_image(*image) : std::nullopt;
}

// Adds an "imagemap" with glTF's sampler and texture transform, as far as pbrt can express them. t points up
// in pbrt and down in glTF.
std::string Textures::add(const std::string& value_type, const ImageFile& file, const std::string& encoding,
                          const View& info) {
  DirectiveMaker<TextureDescription> texture("imagemap", warnings_.where());
  texture->name = fmt::format("texture {}", scene_.textures.size());
  texture->name_location = texture->value_type_location = warnings_.where();
  texture->value_type = value_type;
  texture.add(file_parameter("filename", file));
  if (!encoding.empty()) texture.text("encoding", encoding);
  const View t = document_.item("textures", *info["index"].index(document_.size("textures")));
  if (const auto sampler = t["sampler"].index(document_.size("samplers"))) {
    const View s = document_.item("samplers", *sampler);
    const uint64_t wrap = s["wrapS"].count(10497);
    if (wrap == 33071) texture.text("wrap", "clamp");
    if (wrap == 33648) warnings_.say("mirrored textures are repeated without mirroring");
  }
  if (const View transform = info["extensions"]["KHR_texture_transform"]) {
    const auto offset = transform["offset"].numbers(2, {0, 0}), scale = transform["scale"].numbers(2, {1, 1});
    if (transform["rotation"].number(0) != 0) warnings_.say("rotations of KHR_texture_transform are ignored");
    // glTF samples at v' = v scale + offset with v = 1 - t; in pbrt's t that is t' = 1 - v'.
    texture.number("uscale", scale[0]).number("vscale", scale[1]);
    texture.number("udelta", offset[0]).number("vdelta", 1 - scale[1] - offset[1]);
  }
  scene_.textures.push_back(std::move(*texture));
  return scene_.textures.back().name;
}

std::optional<std::string> Textures::colour(const View& info, const glm::dvec3& factor) {
  const auto image = tinted_file(info, factor);
  if (!image) return std::nullopt;
  return add("spectrum", *image, factor == glm::dvec3(1) ? "" : "sRGB", info);
}

std::optional<ImageFile> Textures::tinted_file(const View& info, const glm::dvec3& factor) {
  const auto image = file(info);
  if (!image || factor == glm::dvec3(1)) return image;
  const ImageFile tinted = in_folder(fmt::format("derived{}.png", derived_++));
  if (const auto error = write_tinted(path_of(*image), path_of(tinted), factor)) {
    warnings_.say(*error);
    return std::nullopt;
  }
  return tinted;
}

std::optional<std::string> Textures::channel(const View& info, int channel,
                                             const std::function<double(double)>& map) {
  const auto image = file(info);
  if (!image) return std::nullopt;
  const ImageFile grey = in_folder(fmt::format("derived{}.png", derived_++));
  if (const auto error = write_channel(path_of(*image), path_of(grey), channel, map)) {
    warnings_.say(*error);
    return std::nullopt;
  }
  return add("float", grey, "linear", info);
}

std::optional<glm::dvec3> Textures::mean(const View& info, bool srgb) {
  const auto image = file(info);
  if (!image) return std::nullopt;
  std::string error;
  const auto mean = mean_colour(path_of(*image), srgb, error);
  if (!mean) warnings_.say(error);
  return mean;
}

}  // namespace kaustik::gltf
