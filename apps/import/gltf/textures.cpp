#include "apps/import/gltf/textures.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "apps/import/common/derived_image.h"
#include "apps/import/common/scene_files.h"
#include "core/files/pending_file.h"

namespace kaustik::gltf {
namespace {

bool is_ktx(const ReadableFile& file) {
  return pbrt::first_bytes(file, 8).find("KTX") != std::string::npos;
}

// The file extension that fits the image's first bytes; empty for formats that cannot be read, such as KTX2.
std::string extension_of(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return ".png";
  if (bytes.starts_with("\xff\xd8")) return ".jpg";
  if (bytes.size() > 12 && bytes.starts_with("RIFF") && bytes.substr(8, 4) == "WEBP") return ".webp";
  if (bytes.size() > 12 && bytes.substr(4, 8) == "ftypavif") return ".avif";
  if (bytes.starts_with("GIF8")) return ".gif";
  if (bytes.starts_with("BM")) return ".bmp";
  if (bytes.starts_with("DDS ")) return ".dds";
  return "";
}

// The name of a wrap mode of glTF.
std::string wrap_of(const View& mode) {
  const uint64_t number = mode.count(10497);
  return number == 33071 ? "clamp" : number == 33648 ? "mirror" : "repeat";
}

// The image of a texture: the extensions name images of other formats, which are better or the only ones.
std::optional<uint64_t> source_of(const View& texture, uint64_t images) {
  auto source = texture["source"].index(images);
  for (const char* name : {"EXT_texture_webp", "EXT_texture_avif", "MSFT_texture_dds", "KHR_texture_basisu"})
    if (!source) source = texture["extensions"][name]["source"].index(images);
  return source;
}

// Samples at m (u, v, 1), where v = 1 - t and t points up, as that of the result does.
void add_transform(const glm::dmat3& m, DirectiveMaker<TextureDescription>& texture) {
  texture.number("uscale", m[0][0]).number("vscale", m[1][1]);
  texture.number("udelta", m[1][0] + m[2][0]).number("vdelta", 1 - m[1][1] - m[2][1]);
  if (m[1][0] != 0 || m[0][1] != 0) texture.number("ushear", -m[1][0]).number("vshear", -m[0][1]);
}

}  // namespace

// offset + R (scale * (u, v)), where R turns counter-clockwise as v points down.
glm::dmat3 uv_transform_of(const View& info) {
  const View transform = info["extensions"]["KHR_texture_transform"];
  const auto offset = transform["offset"].numbers(2, {0, 0}), scale = transform["scale"].numbers(2, {1, 1});
  const double angle = transform["rotation"].number(0), c = std::cos(angle), s = std::sin(angle);
  return {c * scale[0], -s * scale[0], 0, s * scale[1], c * scale[1], 0, offset[0], offset[1], 1};
}

uint64_t uv_set_of(const View& info) {
  return info["extensions"]["KHR_texture_transform"]["texCoord"].count(info["texCoord"].count(0));
}

Parameter Textures::parameter(const std::string& name, const std::string& texture) const {
  return make_parameter(ParameterType::kTexture, name, texture, warnings_.where());
}

Parameter Textures::file_parameter(const std::string& name, const ImageFile& file) {
  return make_parameter(ParameterType::kString, name, file.name, file.where);
}

std::optional<uint64_t> Textures::image_of(const View& info) {
  const auto texture = info["index"].index(document_.size("textures"));
  if (!texture) return std::nullopt;
  const auto source = source_of(document_.item("textures", *texture), document_.size("images"));
  if (!source) warnings_.say("textures without an image are shown as grey");
  return source;
}

ImageFile Textures::in_folder(const std::string& name) {
  if (!made_) made_.emplace(files_, scene_);
  return {name, made_->where()};
}

ReadableFile Textures::place_of(const ImageFile& file) const {
  return pbrt::find_named_file(files_.root(), file.name, files_.name(file.where.file), path_);
}

std::optional<ImageFile> Textures::file_of_image(uint64_t index) {
  auto found = images_.find(index);
  if (found == images_.end()) found = images_.emplace(index, make_file(index)).first;
  return found->second;
}

std::optional<ImageFile> Textures::make_file(uint64_t index) {
  const View image = document_.item("images", index);
  const View uri = image["uri"];
  std::optional<std::string> data;
  if (uri) {
    data = Document::data_of_uri(uri);
    if (!data) return find_file(index, Document::file_of_uri(uri.text()));
  } else if (const auto view = image["bufferView"].index(document_.size("bufferViews"))) {
    data = std::string(document_.bytes_of_view(*view));
  }
  const std::string extension = data ? extension_of(*data) : "";
  if (extension.empty()) {
    warnings_.say(fmt::format("image {} has a format that cannot be read and is shown as grey", index));
    return std::nullopt;
  }
  const ImageFile file = in_folder(fmt::format("image{}{}", index, extension));
  const std::filesystem::path path = made_->path(file.name);
  try {
    write_file(path, *data);
  } catch (const FileError& error) {
    throw std::runtime_error(fmt::format("cannot write {}: {}", path.string(), error.what()));
  }
  return file;
}

// The file of this name, or else one of its last name beside the glTF file. Nothing, with a warning, when
// there is none or its format cannot be read.
std::optional<ImageFile> Textures::find_file(uint64_t index, const std::string& name) {
  const SourceLocation beside{document_.file(), 0, 0};
  const auto last = std::filesystem::path(name).filename().string();
  for (const std::string& candidate : {name, last}) {
    const ImageFile file{candidate, beside};
    const ReadableFile place = place_of(file);
    if (!place.exists()) continue;
    if (!is_ktx(place)) return file;
    warnings_.say(
        fmt::format("image {}, \"{}\", is KTX, which cannot be read, and is shown as grey", index, name));
    return std::nullopt;
  }
  std::string error;
  if (const ReadableFile file = place_of({name, beside}); file.refused()) {
    pbrt::read_bytes(file, 0, error);
    document_.item("images", index).fail(error);
  }
  warnings_.say(fmt::format("image {}, \"{}\", does not exist and is shown as grey", index, name));
  return std::nullopt;
}

std::optional<ImageFile> Textures::file(const View& info) {
  const auto image = info ? image_of(info) : std::nullopt;
  return image ? file_of_image(*image) : std::nullopt;
}

DirectiveMaker<TextureDescription> Textures::start(const std::string& type, const std::string& value_type) {
  DirectiveMaker<TextureDescription> texture(type, warnings_.where());
  texture->name = fmt::format("texture {}", scene_.textures.size());
  texture->name_location = texture->value_type_location = warnings_.where();
  texture->value_type = value_type;
  return texture;
}

// The texture of the colours ("spectrum") or the alpha ("float") of vertices, made on first use.
std::string Textures::vertex_texture(const std::string& value_type) {
  std::string& name = vertex_textures_[value_type];
  if (name.empty()) {
    auto texture = start("vertexcolor", value_type);
    name = texture->name;
    scene_.textures.push_back(std::move(*texture));
  }
  return name;
}

std::string Textures::scaled(const std::string& value_type, Parameter value, const std::string& scale) {
  auto texture = start("scale", value_type);
  texture.add(std::move(value)).add(parameter("scale", scale));
  scene_.textures.push_back(std::move(*texture));
  return scene_.textures.back().name;
}

std::string Textures::by_vertex(const std::optional<std::string>& texture, const glm::dvec3& factor) {
  const std::string colours = vertex_texture("spectrum");
  if (texture) return scaled("spectrum", parameter("tex", *texture), colours);
  if (factor == glm::dvec3(1)) return colours;
  return scaled("spectrum",
                make_parameter(ParameterType::kRgb, "tex", std::vector<double>{factor.x, factor.y, factor.z},
                               warnings_.where()),
                colours);
}

std::string Textures::by_vertex_alpha(const std::optional<std::string>& texture, double factor) {
  const std::string alpha = vertex_texture("float");
  if (texture) return scaled("float", parameter("tex", *texture), alpha);
  if (factor == 1) return alpha;
  return scaled("float",
                make_parameter(ParameterType::kFloat, "tex", std::vector<double>{factor}, warnings_.where()),
                alpha);
}

// Adds an "imagemap" with glTF's sampler and texture transform, as far as pbrt can express them. t points up
// in pbrt and down in glTF.
std::string Textures::add(const std::string& value_type, const ImageFile& file, const std::string& encoding,
                          const View& info) {
  auto texture = start("imagemap", value_type);
  texture.add(file_parameter("filename", file));
  if (!encoding.empty()) texture.text("encoding", encoding);
  const View t = document_.item("textures", *info["index"].index(document_.size("textures")));
  if (const auto sampler = t["sampler"].index(document_.size("samplers"))) {
    const View s = document_.item("samplers", *sampler);
    const std::string wrap = wrap_of(s["wrapS"]), vwrap = wrap_of(s["wrapT"]);
    if (wrap != "repeat") texture.text("wrap", wrap);
    if (vwrap != wrap) texture.text("vwrap", vwrap);
  }
  if (const glm::dmat3 own = uv_transform_of(info); own != uv_of_mesh_)
    add_transform(own * glm::inverse(uv_of_mesh_), texture);
  scene_.textures.push_back(std::move(*texture));
  return scene_.textures.back().name;
}

std::optional<std::string> Textures::colour(const View& info, const glm::dvec3& factor, double exponent) {
  const auto image = tinted_file(info, factor, exponent);
  if (!image) return std::nullopt;
  return add("spectrum", *image, factor == glm::dvec3(1) && exponent == 1 ? "" : "sRGB", info);
}

std::optional<ImageFile> Textures::tinted_file(const View& info, const glm::dvec3& factor, double exponent) {
  const auto image = file(info);
  if (!image || (factor == glm::dvec3(1) && exponent == 1) || !pixels_) return image;
  const ImageFile tinted = in_folder(fmt::format("derived{}.png", derived_++));
  if (const auto error = write_tinted(place_of(*image), made_->path(tinted.name), factor, exponent)) {
    warnings_.say(*error);
    return std::nullopt;
  }
  return tinted;
}

std::optional<std::string> Textures::channel(const View& info, int channel,
                                             const std::function<double(double)>& map) {
  const auto image = file(info);
  if (!image) return std::nullopt;
  if (!pixels_) return add("float", *image, "linear", info);
  const ImageFile grey = in_folder(fmt::format("derived{}.png", derived_++));
  if (const auto error = write_channel(place_of(*image), made_->path(grey.name), channel, map)) {
    warnings_.say(*error);
    return std::nullopt;
  }
  return add("float", grey, "linear", info);
}

// Means are read once a file.
const std::optional<ImageMeans>& Textures::means(const ImageFile& file) {
  const ReadableFile readable = place_of(file);
  const auto [found, is_new] = means_.try_emplace(readable.path());
  if (!is_new) return found->second;
  std::string error;
  found->second = image_means(readable, error);
  if (!found->second) warnings_.say(error + ": grey is shown in its place");
  return found->second;
}

std::optional<glm::dvec3> Textures::mean(const View& info) {
  const auto image = file(info);
  const auto means_of_file = image ? means(*image) : std::nullopt;
  return means_of_file ? std::optional(means_of_file->linear) : std::nullopt;
}

std::optional<double> Textures::mean_of_channel(const View& info, int channel) {
  const auto image = file(info);
  const auto means_of_file = image ? means(*image) : std::nullopt;
  return means_of_file ? std::optional(means_of_file->stored[channel]) : std::nullopt;
}

}  // namespace kaustik::gltf
