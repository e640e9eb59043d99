#pragma once
// What the live page asks for, as text and bytes; docs/reference/live_page.md describes the forms.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/live/live_render.h"
#include "apps/settings/table/settings.h"

namespace kaustik::app {

// What does not change while a render is shown, as JSON. `tone`: how the page shows the picture at first.
// `more`: an object whose members are added.
std::string info_json(const LiveRender& render, const ToneChoice& tone, const nlohmann::ordered_json& more);

// One event with the state of the render. number: of this render, counted from 1. version: of the pixels that
// the page shall show.
std::string status_event(const LiveRender& render, uint64_t number, uint64_t version);

// The tiles of a layer that changed since a version, as bytes. Nothing if there is no such layer; the empty
// name is that of all light.
std::optional<std::string> pixels_since(const LiveRender& render, uint64_t number, const std::string& layer,
                                        uint64_t version);

}  // namespace kaustik::app
