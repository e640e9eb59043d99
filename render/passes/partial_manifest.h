#pragma once
// Conversion of a partial result's manifest to and from JSON.

#include <nlohmann/json_fwd.hpp>

#include "render/passes/partial_result.h"

namespace kaustik::render {

nlohmann::ordered_json manifest_json(const PartialManifest& manifest, const PassSums& sums);

// A manifest as read: everything but the pixels, of which only the window is known.
struct ReadManifest {
  PartialResult result;  // without pixels
  ExactUnits units;
  int width = 0, height = 0, x0 = 0, y0 = 0, full_width = 0, full_height = 0;
};
// Throws std::runtime_error, or nlohmann's exceptions, if a value is missing or invalid.
ReadManifest manifest_from_json(const nlohmann::ordered_json& json);

}  // namespace kaustik::render
