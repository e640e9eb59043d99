#pragma once
// The manifest of a partial result as JSON.

#include <nlohmann/json_fwd.hpp>

#include "render/passes/partial_result.h"

namespace kaustik::render {

nlohmann::ordered_json manifest_json(const PartialManifest& manifest, const PassSums& sums);

// Everything but the pixels, whose window is only described.
struct ReadManifest {
  PartialResult result;  // sums without pixels
  ExactUnits units;
  int width = 0, height = 0, x0 = 0, y0 = 0, full_width = 0, full_height = 0;
};
// Throws std::runtime_error, or nlohmann's errors, for what is missing or senseless.
ReadManifest manifest_from_json(const nlohmann::ordered_json& json);

}  // namespace kaustik::render
