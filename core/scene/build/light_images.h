#pragma once
// The images that lights emit, each read once.

#include <map>
#include <memory>

#include "core/scene/build/builder.h"
#include "core/scene/schema/schema.h"

namespace kaustik {

class LightImages {
 public:
  LightImages(const LightImageLoader& load, DiagnosticList& diagnostics)
      : load_(load), diagnostics_(diagnostics) {}

  // The image that parameter `name` names; null, with an error added, when it cannot be read or has a pixel
  // that is not finite. Negative pixels become zero, with a warning that names the first.
  std::shared_ptr<const LightImage> get(const ParameterReader& parameters, std::string_view name);

  // The same as a map of all directions: square images are equal-area, those twice as wide as high
  // latitude-longitude, with a warning: pbrt-v4 refuses these. Others are errors. Of a light: by the mean of
  // the three channels. Of a sky: with its excess.
  enum class Around { kLight, kSky };
  std::shared_ptr<const DirectionMap> directions(const ParameterReader& parameters, std::string_view name,
                                                 Around around);

 private:
  std::shared_ptr<const LightImage> load(const std::string& file, const SourceLocation& where);

  const LightImageLoader& load_;
  DiagnosticList& diagnostics_;
  // By name and naming file, since names are relative to that. Null: it could not be read.
  std::map<std::pair<std::string, uint32_t>, std::shared_ptr<const LightImage>> images_;
};

}  // namespace kaustik
