#pragma once
// Values in the manifests of partial results and of map files, as JSON. The functions that read throw
// std::runtime_error, or the JSON library's exceptions, if a value is missing or invalid.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "render/maps/gather_radii.h"
#include "render/passes/partial_result.h"

namespace kaustik::render {

using ManifestJson = nlohmann::ordered_json;

// Exact texts of floats, in C's hexadecimal notation.
std::string hex_text(float value);
float finite_from_hex(const ManifestJson& json);

// An exponent in a member of an object, whose power of two is representable as a double.
int exponent_from(const ManifestJson& object, const char* key);

ManifestJson settings_json(const SettingTexts& settings);
SettingTexts settings_from(const ManifestJson& json);

ManifestJson radii_json(const std::optional<GatherRadii>& radii);  // null if unknown
std::optional<GatherRadii> radii_from(const ManifestJson& json);

// Counts, seconds, energy and examples of dropped samples.
ManifestJson statistics_values(const RenderStatistics& statistics);
RenderStatistics statistics_from(const ManifestJson& json);

}  // namespace kaustik::render
