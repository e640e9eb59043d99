#pragma once
// Image lookup for textures. Core knows no file formats: the caller that builds a scene provides an
// ImageLibrary, which the scene keeps.

#include <compare>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "core/diagnostics/source_location.h"
#include "core/math/vec.h"

namespace kaustik {

enum class ImageWrap { kRepeat, kBlack, kClamp, kMirror };
// The filters of pbrt-v4: the nearest texel, bilinear on one level, trilinear between two levels, or an
// elliptical average.
enum class ImageFilter { kPoint, kBilinear, kTrilinear, kEwa };

struct ImageSampling {
  ImageWrap wrap = ImageWrap::kRepeat, vwrap = ImageWrap::kRepeat;  // along s and t
  ImageFilter filter = ImageFilter::kBilinear;
  float max_anisotropy = 8;  // kEwa: limit on the ratio of the longer to the shorter axis
};

// How the integers of an image file encode values; floats are linear.
struct ImageEncoding {
  enum class Kind { kDefault, kSrgb, kLinear, kGamma } kind = Kind::kDefault;  // kDefault is sRGB
  float gamma = 1;  // kGamma: linear = encoded^gamma

  auto operator<=>(const ImageEncoding&) const = default;
};

// Loaded images, addressed by index.
class ImageLibrary {
 public:
  virtual ~ImageLibrary() = default;

  // The colour at st, averaged over the ellipse with half axes dstdx and dstdy; if both are zero, the finest
  // level is used. (0, 0) is the upper left corner and (1, 1) the lower right one. Images of one channel are
  // grey. The result is always finite. Thread-safe, and a pure function of its arguments.
  virtual Rgb lookup(uint32_t image, const ImageSampling& sampling, const Point2& st, const Vector2& dstdx,
                     const Vector2& dstdy) const = 0;

  // Bytes that levels and tiles which are made when they are first looked up will take, at most.
  virtual uint64_t bytes_to_come() const { return 0; }
};

// The result of loading an image: an index for lookup(), or an error.
struct ImageResult {
  uint32_t image = 0;
  std::string error;  // one sentence that names the file; empty on success
};

// Loads the images that a scene names while it is built.
struct ImageLoader {
  // Reads the whole image that the parameter at `where` names, so that errors in it are found at once. The
  // same file with the same encoding is one image. Called from several threads at once.
  std::function<ImageResult(const std::string& filename, const SourceLocation& where, const ImageEncoding&)>
      load;
  // Called when all images are loaded; the scene keeps the result. May return null if there are none.
  std::function<std::shared_ptr<const ImageLibrary>()> library;
};

}  // namespace kaustik
