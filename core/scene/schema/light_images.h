#pragma once
// The images that lights emit, each loaded once.

#include <map>
#include <memory>

#include "core/light/image/direction_map.h"
#include "core/scene/schema/schema.h"

namespace kaustik {

class LightImages {
 public:
  LightImages(const LightImageLoader& load, DiagnosticList& diagnostics)
      : load_(load), diagnostics_(diagnostics) {}

  // Returns the image named by parameter `name`, or null, with an error added, if it cannot be read or has a
  // pixel that is not finite. Negative pixels become zero, with a warning that names the first one.
  std::shared_ptr<const LightImage> get(const ParameterReader& parameters, std::string_view name);

  // Returns the image as a map of all directions. A square image uses the equal-area layout; all others use
  // the latitude-longitude layout, with a warning because pbrt-v4 rejects it. kLight: a grey map, the mean of
  // the three channels. kSky: with its excess sampled. factor: on all pixels.
  enum class Around { kLight, kSky };
  std::shared_ptr<const DirectionMap> directions(const ParameterReader& parameters, std::string_view name,
                                                 Around around, const Rgb& factor = Rgb(1));

 private:
  std::shared_ptr<const LightImage> load(const std::string& file, const SourceLocation& where);

  const LightImageLoader& load_;
  DiagnosticList& diagnostics_;
  // By file name and the scene file that names it, since names are relative to that file. Null if the image
  // could not be read.
  std::map<std::pair<std::string, uint32_t>, std::shared_ptr<const LightImage>> images_;
};

}  // namespace kaustik
