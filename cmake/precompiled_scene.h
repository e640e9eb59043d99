// The headers of core/ that most sources above it include, compiled once: see precompiled.h.
#include "cmake/precompiled.h"
#include "core/scene/scene.h"
