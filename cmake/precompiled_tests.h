// The headers that most tests include, compiled once: see precompiled.h.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cmake/precompiled.h"
#include "core/scene/scene.h"
