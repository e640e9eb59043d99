#pragma once
// A picture in progress as a file to download.

#include "apps/live/live_render.h"
#include "apps/settings/table/settings.h"
#include "apps/web/http_server.h"

namespace kaustik::app {

// The query says format=exr, with all layers, or format=png with exposure=STOPS and tonemap=NAME; without
// these, `tone` holds. An error response for other values.
HttpResponse saved_picture(const LiveRender& live, const HttpRequest& request, const ToneChoice& tone);

}  // namespace kaustik::app
