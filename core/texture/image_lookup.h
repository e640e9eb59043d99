#pragma once
// Images as textures read them. Core knows no file format: whoever builds a scene hands an ImageLibrary in,
// and the scene keeps it.

#include <compare>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "core/diagnostics/source_location.h"
#include "core/math/vec.h"

namespace kaustik {

enum class ImageWrap { kRepeat, kBlack, kClamp };
// Those of pbrt-v4: the nearest texel or four of them on one level, of two levels, or an elliptical average.
enum class ImageFilter { kPoint, kBilinear, kTrilinear, kEwa };

struct ImageSampling {
  ImageWrap wrap = ImageWrap::kRepeat;
  ImageFilter filter = ImageFilter::kBilinear;
  float max_anisotropy = 8;  // of kEwa: longer over shorter axis
};

// What the integers of an image file mean; floats are linear.
struct ImageEncoding {
  enum class Kind { kDefault, kSrgb, kLinear, kGamma } kind = Kind::kDefault;  // the default is sRGB
  float gamma = 1;  // of kGamma: linear = encoded^gamma

  auto operator<=>(const ImageEncoding&) const = default;
};

// Images that were read, by index.
class ImageLibrary {
 public:
  virtual ~ImageLibrary() = default;

  // The colour at st, (0, 0) being the upper left corner and (1, 1) the lower right one, averaged over the
  // ellipse of half axes dstdx and dstdy; both zero: the finest level. Images of one channel are grey. Never
  // anything but finite numbers. Thread-safe, and a pure function of its arguments.
  virtual Rgb lookup(uint32_t image, const ImageSampling& sampling, const Point2& st, const Vector2& dstdx,
                     const Vector2& dstdy) const = 0;
};

// What an image file gave: an index for lookup(), or why not.
struct ImageResult {
  uint32_t image = 0;
  std::string error;  // one sentence that names the file; empty on success
};

// How the images that a scene names are read while it is built.
struct ImageLoader {
  // Reads the image that the parameter at `where` names, in full, so that what is wrong with it is found now.
  // The same file with the same encoding is one image. Called from several threads at once.
  std::function<ImageResult(const std::string& filename, const SourceLocation& where, const ImageEncoding&)>
      load;
  // Kept by the scene. Called when all images are loaded; null is enough where there are none.
  std::function<std::shared_ptr<const ImageLibrary>()> library;
};

}  // namespace kaustik
