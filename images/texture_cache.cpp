// Passes decoded images to OpenImageIO's cache, and looks them up there.

#include "images/texture_cache.h"

#include <OpenImageIO/imagecache.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace kaustik::images {

namespace {

using Options = OIIO::TextureOpt;

constexpr const char* kPixels = "kaustik:pixels";  // name of the attribute that carries a DecodedImage*
constexpr int kTile = 64;

// An ImageInput that passes decoded pixels to OpenImageIO's cache.
class DecodedInput final : public OIIO::ImageInput {
 public:
  const char* format_name() const override { return "decoded"; }
  bool open(const std::string& /*name*/, OIIO::ImageSpec& /*spec*/) override { return false; }
  bool open(const std::string& /*name*/, OIIO::ImageSpec& spec, const OIIO::ImageSpec& config) override {
    const auto* attribute = config.find_attribute(kPixels);
    if (!attribute) return false;
    std::memcpy(&image_, attribute->data(), sizeof image_);
    spec = m_spec = image_->spec;
    return true;
  }
  bool read_native_scanline(int /*subimage*/, int /*level*/, int y, int /*z*/, void* row) override {
    if (image_->pixels.empty()) return false;
    std::memcpy(row, image_->pixels.data() + static_cast<size_t>(y) * image_->row_bytes(),
                image_->row_bytes());
    return true;
  }
  bool close() override { return true; }

  static OIIO::ImageInput* create() { return new DecodedInput; }

 private:
  const DecodedImage* image_ = nullptr;
};

// OpenImageIO returns raw pointers before version 3 and shared pointers from then on; owned() and lent() hide
// it.
template <class T>
auto owned(T* library) {
  return std::unique_ptr<T, void (*)(T*)>(library, [](T* l) { T::destroy(l); });
}
template <class T>
auto owned(std::shared_ptr<T> library) {
  return library;
}
template <class T, class Destroy>
T* lent(const std::unique_ptr<T, Destroy>& library) {
  return library.get();
}
template <class T>
std::shared_ptr<T> lent(const std::shared_ptr<T>& library) {
  return library;
}

Options::Wrap wrap_of(ImageWrap wrap) {
  switch (wrap) {
    case ImageWrap::kBlack:
      return Options::WrapBlack;
    case ImageWrap::kClamp:
      return Options::WrapClamp;
    case ImageWrap::kMirror:
      return Options::WrapMirror;
    case ImageWrap::kRepeat:
      break;
  }
  return Options::WrapPeriodic;
}

Options options_of(const ImageSampling& sampling, bool point) {
  Options o;
  o.swrap = wrap_of(sampling.wrap);
  o.twrap = wrap_of(sampling.vwrap);
  const bool nearest = sampling.filter == ImageFilter::kPoint;
  o.interpmode = nearest ? Options::InterpClosest : Options::InterpBilinear;
  o.mipmode = sampling.filter == ImageFilter::kEwa         ? Options::MipModeAniso
              : sampling.filter == ImageFilter::kTrilinear ? Options::MipModeTrilinear
                                                           : Options::MipModeOneLevel;
  if (point) o.mipmode = Options::MipModeNoMIP;
  o.anisotropic = static_cast<int>(sampling.max_anisotropy);
  return o;
}

// Moves a coordinate into the range in which the library computes accurately; the texels read are the same.
float reduced(float x, ImageWrap wrap) {
  if (wrap == ImageWrap::kRepeat) return x - std::floor(x);
  if (wrap == ImageWrap::kMirror) return x - 2 * std::floor(x / 2);
  return std::clamp(x, -2.0f, 3.0f);
}

// Clamps a footprint to the size of the image, beyond which it averages the whole image anyway.
Vector2 reduced(const Vector2& v) {
  return {std::clamp(v.x, -1.0f, 1.0f), std::clamp(v.y, -1.0f, 1.0f)};
}

bool is_finite(const Point2& p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

}  // namespace

// One cache for the process, never destroyed: OpenImageIO keeps a record per thread and cache, which outlives
// the cache and would be mistaken for that of a later cache at the same address.
struct TextureCache::System {
  using Cache = decltype(owned(OIIO::ImageCache::create(false)));
  using Textures = decltype(owned(OIIO::TextureSystem::create(false)));

  Cache cache = owned(OIIO::ImageCache::create(false));
  Textures textures = owned(OIIO::TextureSystem::create(false, lent(cache)));
  std::mutex mutex;  // guards bytes and files
  uint64_t bytes = 0;
  uint64_t files = 0;  // number of files ever added; names are not reused

  static System& get() {
    static System* const system = new System;
    return *system;
  }

  System() {
    cache->attribute("autotile", kTile);
    cache->attribute("automip", 1);
    cache->attribute("deduplicate", 0);
  }

  OIIO::ustring add(uint64_t image_bytes) {
    const std::lock_guard lock(mutex);
    bytes += image_bytes;
    // MIP levels add a third of an image, and tiles at its edges are stored whole.
    constexpr float kMegabyte = 1 << 20, kSpare = 256;
    cache->attribute("max_memory_MB", 2 * static_cast<float>(bytes) / kMegabyte + kSpare);
    return OIIO::ustring(fmt::format("image {}", files++));
  }

  void remove(const std::vector<OIIO::ustring>& names, uint64_t image_bytes) {
    for (const OIIO::ustring& name : names) cache->invalidate(name);
    const std::lock_guard lock(mutex);
    bytes -= image_bytes;
  }
};

TextureCache::TextureCache() : system_(System::get()) {}
TextureCache::~TextureCache() {
  system_.remove(names_, bytes_);
}

ImageResult TextureCache::load(const std::string& path, const ImageEncoding& encoding,
                               const std::function<uint64_t()>& memory_left) {
  ImageResult result;
  {
    const std::lock_guard lock(mutex_);
    const auto found = loaded_.find({path, encoding});
    if (found != loaded_.end()) return found->second;
  }
  DecodingMemory::Part memory(decoding_, memory_left);
  const auto image = decode_image(path, encoding, memory, result.error);
  const std::lock_guard lock(mutex_);
  const auto found = loaded_.find({path, encoding});  // another thread may have loaded it meanwhile
  if (found != loaded_.end()) return found->second;
  if (image) add(*image, path, &result);
  loaded_.emplace(Key{path, encoding}, result);
  return result;
}

void TextureCache::add(const DecodedImage& image, const std::string& path, ImageResult* result) {
  if (bytes_ + image.pixels.size() > kMostImageBytes) {
    result->error =
        fmt::format("cannot read the image \"{}\": the images of the scene exceed {} bytes in all", path,
                    kMostImageBytes);
    return;
  }
  bytes_ += image.pixels.size();
  const OIIO::ustring name = names_.emplace_back(system_.add(image.pixels.size()));
  const DecodedImage* pointer = &image;
  OIIO::ImageSpec config;
  config.attribute(kPixels, OIIO::TypeDesc::PTR, &pointer);
  bool ok = system_.cache->add_file(name, DecodedInput::create, &config);
  // The pixels are not kept, so all tiles are made now, a row of them at a time.
  std::vector<unsigned char> strip(image.row_bytes() * kTile);
  for (int y = 0; ok && y < image.spec.height; y += kTile) {
    const int end = std::min(y + kTile, image.spec.height);
    ok = system_.cache->get_pixels(name, 0, 0, 0, image.spec.width, y, end, 0, 1, image.spec.format,
                                   strip.data());
  }
  system_.cache->close(name);
  auto* handle = system_.textures->get_texture_handle(name);
  if (!ok || !system_.textures->good(handle)) {
    result->error = fmt::format("cannot read the image \"{}\": {}", path, system_.cache->geterror());
    return;
  }
  result->image = static_cast<uint32_t>(entries_.size());
  entries_.push_back({handle, image.spec.nchannels});
}

Rgb TextureCache::lookup(uint32_t image, const ImageSampling& sampling, const Point2& st,
                         const Vector2& dstdx, const Vector2& dstdy) const {
  if (!images::is_finite(st)) return Rgb(0);
  const bool has_footprint = images::is_finite(dstdx) && images::is_finite(dstdy);
  const Vector2 dx = has_footprint ? reduced(dstdx) : Vector2(0);
  const Vector2 dy = has_footprint ? reduced(dstdy) : Vector2(0);
  const bool point = dx == Vector2(0) && dy == Vector2(0);
  Options options = options_of(sampling, point);
  const Entry& entry = entries_[image];
  float value[3] = {};
  system_.textures->texture(entry.handle, nullptr, options, reduced(st.x, sampling.wrap),
                            reduced(st.y, sampling.vwrap), dx.x, dx.y, dy.x, dy.y, entry.channels, value);
  return entry.channels == 1 ? Rgb(value[0]) : Rgb(value[0], value[1], value[2]);
}

}  // namespace kaustik::images
