// Reads and writes images by means of OpenImageIO.

#include "images/openimageio.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "images/open_image.h"
#include "images/texture_cache.h"

namespace kaustik::images {

namespace {

using render::Channels;
using render::ImageNumbers;
using render::Metadata;

std::string reason(const std::unique_ptr<OIIO::ImageOutput>& out) {
  return out ? out->geterror() : OIIO::geterror();
}

// The bytes of a file of this format, "png" or "jpeg".
std::optional<std::string> encode(const std::string& format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                                  const void* pixels, std::string& error) {
  auto out = OIIO::ImageOutput::create(format);
  const auto fail = [&](const std::string& why) {
    error = why.empty() ? "the image cannot be encoded" : why;
    return std::nullopt;
  };
  if (!out) return fail(reason(out));
  out->threads(1);  // otherwise the library starts a thread pool of its own
  OIIO::Filesystem::IOVecOutput memory;
  if (!out->set_ioproxy(&memory)) return fail("OpenImageIO cannot write this format to memory");
  if (!out->open("memory." + format, spec)) return fail(reason(out));
  const bool written = out->write_image(type, pixels);
  const std::string message = written ? "" : reason(out);
  const bool closed = out->close();
  if (!written) return fail(message);
  if (!closed) return fail(reason(out));
  return std::string(memory.buffer().begin(), memory.buffer().end());
}

// First channel and number of channels that hold the colour: R, G and B of the default layer, else the first
// three channels, else one grey channel.
std::pair<int, int> colour_channels(const OIIO::ImageSpec& spec) {
  for (int c = 0; c + 2 < spec.nchannels; ++c)
    if (spec.channelnames[size_t(c)] == "R" && spec.channelnames[size_t(c) + 1] == "G" &&
        spec.channelnames[size_t(c) + 2] == "B")
      return {c, 3};
  return {0, spec.nchannels >= 3 ? 3 : 1};
}

// The names of all layers: what stands before the last dot of a channel's name.
std::set<std::string> layers_of(const OIIO::ImageSpec& spec) {
  std::set<std::string> names;
  for (const std::string& channel : spec.channelnames)
    if (const size_t dot = channel.rfind('.'); dot != std::string::npos) names.insert(channel.substr(0, dot));
  return names;
}

// Indices of a layer's channels R, G, B or X, Y, Z, or of its only one; none if there is no such layer, or if
// its channels are others.
std::vector<int> channels_of(const OIIO::ImageSpec& spec, const std::string& layer) {
  for (const char* const letters : {"RGB", "XYZ"}) {
    std::vector<int> found;
    for (int c = 0; c < 3; ++c) found.push_back(spec.channelindex(layer + '.' + letters[c]));
    if (*std::min_element(found.begin(), found.end()) >= 0) return found;
  }
  std::vector<int> found;
  for (int c = 0; c < spec.nchannels; ++c) {
    const std::string& name = spec.channelnames[size_t(c)];
    if (name.starts_with(layer + '.') && name.rfind('.') == layer.size()) found.push_back(c);
  }
  return found.size() == 1 ? found : std::vector<int>{};
}

std::string no_layer(const OIIO::ImageSpec& spec, const std::string& layer) {
  const std::set<std::string> there = layers_of(spec);
  if (there.empty()) return fmt::format("it has no layer `{}`, nor any other", layer);
  if (there.contains(layer))
    return fmt::format("the layer `{}` has neither channels R, G, B nor X, Y, Z nor a single one", layer);
  return fmt::format("it has no layer `{}`; there are: {}", layer, fmt::join(there, ", "));
}

// Why an image is refused by its header, which may be broken or hostile; empty if it is accepted.
std::string refusal(const OIIO::ImageSpec& spec, Channels channels, uint64_t most_pixels) {
  constexpr int kLongestSide = 1 << 16;
  if (spec.deep || spec.depth > 1) return "deep and three-dimensional images are not supported";
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) return "it has no pixels";
  const uint64_t pixels = uint64_t(spec.width) * uint64_t(spec.height);
  if (spec.width > kLongestSide || spec.height > kLongestSide || pixels > most_pixels)
    return fmt::format("{} x {} pixels are too large: at most {} pixels and {} a side are supported",
                       spec.width, spec.height, most_pixels, kLongestSide);
  if (channels == Channels::kAll && spec.nchannels > 4)
    return fmt::format("{} channels are too many: at most 4 are supported", spec.nchannels);
  return {};
}

// The attributes by which kaustik says how it made a picture.
Metadata texts_of(const OIIO::ImageSpec& spec) {
  Metadata texts;
  for (const OIIO::ParamValue& value : spec.extra_attribs)
    if (value.name().string().starts_with("kaustik:"))
      texts.emplace_back(value.name().string(), value.get_string());
  return texts;
}

// Where the data window is a part of the display window; nothing if it is all of it or reaches beyond it.
std::optional<render::PartOf> part_of(const OIIO::ImageSpec& spec) {
  const int x = spec.x - spec.full_x, y = spec.y - spec.full_y;
  const bool inside =
      x >= 0 && y >= 0 && spec.width <= spec.full_width - x && spec.height <= spec.full_height - y;
  if (!inside || (spec.width == spec.full_width && spec.height == spec.full_height)) return std::nullopt;
  return render::PartOf{x, y, spec.full_width, spec.full_height};
}

class OpenImageIo final : public render::ImageFormats {
 public:
  // Keeps OpenEXR's thread pool empty. OpenImageIO's own pool is never made: to set its attribute "threads"
  // would first make a pool with a thread per core and then shrink it.
  OpenImageIo() { OIIO::attribute("exr_threads", -1); }

  std::string version() const override {
    const int v = OIIO::openimageio_version();  // 10000 major + 100 minor + patch
    return fmt::format("{}.{}.{}", v / 10000, v / 100 % 100, v % 100);
  }

  std::optional<ImageNumbers> read(const std::string& path, Channels channels, uint64_t most_pixels,
                                   std::string& error) const override {
    const auto fail = [&](std::string why) {
      error = std::move(why);
      return std::nullopt;
    };
    // PFM files begin with the bottom row. OpenImageIO 2.5 forgets to turn them over if it is opened without
    // a configuration.
    OIIO::ImageSpec configuration;
    configuration.attribute("pnm:pfmflip", 1);
    const auto in = open_image(path, Reads::kPixels, configuration, error);
    if (!in) return std::nullopt;
    const OIIO::ImageSpec spec = in->spec();
    if (std::string why = refusal(spec, channels, most_pixels); !why.empty()) return fail(std::move(why));
    const auto [first, count] =
        channels == Channels::kAll ? std::pair(0, spec.nchannels) : colour_channels(spec);
    ImageNumbers out{spec.width, spec.height,    count,        !spec.format.is_floating_point(),
                     {},         texts_of(spec), part_of(spec)};
    out.values.resize(out.count() * size_t(count));
    if (!read_channels(*in, first, first + count, out.values.data(), OIIO::AutoStride, error))
      return std::nullopt;
    return out;
  }

  std::optional<ImageNumbers> read_layer(const std::string& path, const std::string& layer,
                                         uint64_t most_pixels, std::string& error) const override {
    const auto fail = [&](std::string why) {
      error = std::move(why);
      return std::nullopt;
    };
    const auto in = open_image(path, Reads::kPixels, {}, error);
    if (!in) return std::nullopt;
    const OIIO::ImageSpec spec = in->spec();
    if (std::string why = refusal(spec, Channels::kColour, most_pixels); !why.empty())
      return fail(std::move(why));
    const std::vector<int> chosen = channels_of(spec, layer);
    if (chosen.empty()) return fail(no_layer(spec, layer));
    ImageNumbers out{spec.width, spec.height, int(chosen.size()), !spec.format.is_floating_point(),
                     {},         {},          part_of(spec)};
    out.values.resize(out.count() * chosen.size());
    for (size_t c = 0; c < chosen.size(); ++c)
      if (!read_channels(*in, chosen[c], chosen[c] + 1, out.values.data() + c,
                         OIIO::stride_t(chosen.size() * sizeof(float)), error))
        return std::nullopt;
    return out;
  }

  std::optional<std::string> encode_srgb8(render::Encoding encoding, int width, int height,
                                          const std::vector<uint8_t>& pixels, const Metadata& metadata,
                                          std::string& error) const override {
    const bool png = encoding == render::Encoding::kPng;
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("compression", png ? "zip" : "jpeg:95");
    for (const auto& [key, value] : metadata) spec.attribute(key, value);
    return encode(png ? "png" : "jpeg", spec, OIIO::TypeDesc::UINT8, pixels.data(), error);
  }

  std::optional<std::string> encode_numbers(const ImageNumbers& image, int bits,
                                            std::string& error) const override {
    const OIIO::TypeDesc type = bits == 8 ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::UINT16;
    OIIO::ImageSpec spec(image.width, image.height, image.channels, type);
    spec.attribute("png:compressionLevel", 1);  // takes most of the time, and the file is read again soon
    return encode("png", spec, OIIO::TypeDesc::FLOAT, image.values.data(), error);
  }

  std::string texture_trouble(const std::string& path) const override {
    std::string error;
    open_texture(path, Reads::kHeader, error);
    return error;
  }

  std::shared_ptr<render::TextureImages> make_textures() const override {
    return std::make_shared<TextureCache>();
  }
};

}  // namespace

const render::ImageFormats& openimageio() {
  static const OpenImageIo formats;
  return formats;
}

}  // namespace kaustik::images
