#include "render/image_io.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <filesystem>

#include "core/pending_file.h"

namespace kaustik::render {

namespace {

namespace fs = std::filesystem;

std::string lower_extension(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

bool is_exr(const std::string& path) {
  return lower_extension(path) == ".exr";
}

void write_pixels(const std::string& path, OIIO::ImageSpec spec, const Metadata& metadata,
                  OIIO::TypeDesc type, const void* pixels) {
  for (const auto& [key, value] : metadata) spec.attribute(key, value);
  // The library would write the time of day: the same picture would not give the same bytes.
  if (is_exr(path)) spec.attribute("DateTime", "");
  PendingFile file(path, unique_temporary_name(path));
  auto out = OIIO::ImageOutput::create(file.temporary());
  if (!out) throw ImageError(path, OIIO::geterror());
  out->threads(1);  // otherwise the library makes a pool of threads of its own
  if (!out->open(file.temporary(), spec)) throw ImageError(path, out->geterror());
  const bool written = out->write_image(type, pixels);
  const std::string message = written ? "" : out->geterror();
  const bool closed = out->close();
  if (!written || !closed) throw ImageError(path, message.empty() ? out->geterror() : message);
  if (const std::string error = file.commit(); !error.empty()) throw ImageError(path, error);
}

std::vector<std::string> channel_names(Layer layer) {
  const std::string name(kLayerNames[size_t(layer)]);
  switch (layer) {
    case Layer::kNormal:
      return {name + ".X", name + ".Y", name + ".Z"};
    case Layer::kDepth:
      return {name + ".Z"};
    case Layer::kPhotons:
      return {name + ".Y"};
    default:
      return {name + ".R", name + ".G", name + ".B"};
  }
}

void append_layer(const PixelResult& pixel, Layer layer, std::vector<float>* out) {
  const auto append = [out](const glm::vec3& v) { out->insert(out->end(), {v.x, v.y, v.z}); };
  switch (layer) {
    case Layer::kEmitted:
      return append(pixel.emitted);
    case Layer::kDirect:
      return append(pixel.direct);
    case Layer::kCaustic:
      return append(pixel.caustic);
    case Layer::kIndirect:
      return append(pixel.indirect);
    case Layer::kAlbedo:
      return append(pixel.albedo);
    case Layer::kNormal:
      return append(pixel.normal);
    case Layer::kDepth:
      return out->push_back(pixel.depth);
    case Layer::kPhotons:
      return out->push_back(pixel.photons);
    case Layer::kError:
      return append(pixel.error);
    case Layer::kBias:
      return append(pixel.bias);
  }
}

void write_exr(const std::string& path, const Film& film, const WriteOptions& options) {
  std::vector<std::string> names = {"R", "G", "B"};
  for (const Layer layer : options.layers)
    for (std::string& name : channel_names(layer)) names.push_back(std::move(name));
  OIIO::ImageSpec spec(film.width(), film.height(), int(names.size()), OIIO::TypeDesc::FLOAT);
  spec.channelnames = names;
  spec.x = film.x0();
  spec.y = film.y0();
  spec.full_width = film.full_width();
  spec.full_height = film.full_height();
  // Radiance has noise to its last bits: zip takes 75 ms to save 6 % of 512 x 512 pixels, run lengths 3 ms to
  // save 1 %, and all of an empty background. Other layers are smooth.
  spec.attribute("compression", options.layers.empty() ? "rle" : "zip");
  std::vector<float> pixels;
  pixels.reserve(size_t(film.width()) * size_t(film.height()) * names.size());
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const PixelResult& pixel = film.at(x, y);
      const Rgb total = pixel.radiance();
      pixels.insert(pixels.end(), {total.x, total.y, total.z});
      for (const Layer layer : options.layers) append_layer(pixel, layer, &pixels);
    }
  write_pixels(path, std::move(spec), options.metadata, OIIO::TypeDesc::FLOAT, pixels.data());
}

void write_exr(const std::string& path, const Image& image, const Metadata& metadata) {
  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::FLOAT);
  spec.attribute("compression", "zip");
  static_assert(sizeof(Rgb) == 3 * sizeof(float));
  write_pixels(path, std::move(spec), metadata, OIIO::TypeDesc::FLOAT, image.pixels.data());
}

void write_srgb8(const std::string& path, const Image& image, const ToneSettings& tone,
                 const Metadata& metadata) {
  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("compression", lower_extension(path) == ".png" ? "zip" : "jpeg:95");
  std::vector<uint8_t> pixels;
  pixels.reserve(3 * image.pixels.size());
  for (const Rgb& radiance : image.pixels) {
    const auto encoded = to_srgb8(radiance, tone);
    pixels.insert(pixels.end(), encoded.begin(), encoded.end());
  }
  write_pixels(path, std::move(spec), metadata, OIIO::TypeDesc::UINT8, pixels.data());
}

// First channel and number of channels that hold the colour: R, G, B of the default layer, else the first
// three, else one grey.
std::pair<int, int> colour_channels(const OIIO::ImageSpec& spec) {
  for (int c = 0; c + 2 < spec.nchannels; ++c)
    if (spec.channelnames[size_t(c)] == "R" && spec.channelnames[size_t(c) + 1] == "G" &&
        spec.channelnames[size_t(c) + 2] == "B")
      return {c, 3};
  return {0, spec.nchannels >= 3 ? 3 : 1};
}

// Refuses what a broken or hostile header may say.
void check_header(const std::string& path, const OIIO::ImageSpec& spec, uint64_t most_pixels) {
  constexpr int kLongestSide = 1 << 16;
  if (spec.deep || spec.depth > 1) throw ImageError(path, "deep or three-dimensional images are not read");
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) throw ImageError(path, "it holds no pixels");
  const uint64_t pixels = uint64_t(spec.width) * uint64_t(spec.height);
  if (spec.width > kLongestSide || spec.height > kLongestSide || pixels > most_pixels)
    throw ImageError(path,
                     fmt::format("{} x {} pixels are more than the {} that are read, or more than {} a side",
                                 spec.width, spec.height, most_pixels, kLongestSide));
}

}  // namespace

std::vector<Layer> layers_from_names(const std::vector<std::string>& names) {
  std::array<bool, kLayers> wanted{};
  for (const std::string& name : names) {
    const auto found = std::find(kLayerNames.begin(), kLayerNames.end(), name);
    if (name == "all")
      wanted.fill(true);
    else if (found != kLayerNames.end())
      wanted[size_t(found - kLayerNames.begin())] = true;
    else
      throw std::invalid_argument(
          fmt::format("unknown layer '{}'; there are: {}, all", name, fmt::join(kLayerNames, ", ")));
  }
  std::vector<Layer> layers;
  for (int i = 0; i < kLayers; ++i)
    if (wanted[size_t(i)]) layers.push_back(Layer(i));
  return layers;
}

void check_output_name(const std::string& path) {
  const std::string extension = lower_extension(path);
  if (extension != ".exr" && extension != ".png" && extension != ".jpg" && extension != ".jpeg")
    throw std::invalid_argument(path + ": the name must end in .exr, .png, .jpg or .jpeg");
}

void write_film(const std::string& path, const Film& film, const WriteOptions& options) {
  check_output_name(path);
  if (is_exr(path))
    write_exr(path, film, options);
  else
    write_srgb8(path, image_of(film), options.tone, options.metadata);
}

void write_image(const std::string& path, const Image& image, const ToneSettings& tone,
                 const Metadata& metadata) {
  check_output_name(path);
  if (is_exr(path))
    write_exr(path, image, metadata);
  else
    write_srgb8(path, image, tone, metadata);
}

Image read_image(const std::string& path, uint64_t most_pixels) {
  auto in = OIIO::ImageInput::open(path);
  if (!in) throw ImageError(path, OIIO::geterror());
  in->threads(1);
  const OIIO::ImageSpec spec = in->spec();
  check_header(path, spec, most_pixels);
  const auto [first, count] = colour_channels(spec);
  std::vector<float> values(size_t(spec.width) * size_t(spec.height) * size_t(count));
  if (!in->read_image(0, 0, first, first + count, OIIO::TypeDesc::FLOAT, values.data()))
    throw ImageError(path, in->geterror());
  const bool encoded = !spec.format.is_floating_point();
  Image image(spec.width, spec.height);
  for (size_t i = 0; i < image.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const float v = values[i * size_t(count) + size_t(count == 3 ? c : 0)];
      image.pixels[i][c] = encoded ? linear_from_srgb(v) : v;
    }
  return image;
}

}  // namespace kaustik::render
