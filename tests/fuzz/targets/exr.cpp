// EXR files, read by OpenEXR itself: pictures with layers, as `kaustik denoise` reads them.

#include "render/picture/exr_file.h"

#include "tests/fuzz/input_folder.h"

namespace kaustik::fuzz {

void fuzz_exr(Bytes input) {
  constexpr uint64_t kMostFuzzedPixels = uint64_t{1} << 14;
  try {
    const auto channels =
        render::read_exr_file(input_file("image.exr", as_text(input)).string(), kMostFuzzedPixels);
    for (const auto& values : channels.values)
      if (values.size() != size_t(channels.width) * size_t(channels.height))
        throw Violation("a channel has another number of values than its size says");
  } catch (const Violation&) {
    throw;
  } catch (const std::exception&) {  // documented
  }
}

}  // namespace kaustik::fuzz
