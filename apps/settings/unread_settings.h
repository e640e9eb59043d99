#pragma once
// Finds settings of the command line that the chosen estimators do not read.

#include <string>
#include <vector>

#include "apps/settings/setting_options.h"
#include "render/plan/plan.h"

namespace kaustik::app {

// One warning for each setting that `given` sets and that nothing in a render by `plan` reads, such as
// --photons with method mc.
std::vector<std::string> unread_settings(const SettingOverrides& given, const render::EstimatorPlan& plan);

}  // namespace kaustik::app
