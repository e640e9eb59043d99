#pragma once
// Settings as JSON: `settings` of `--stats`, of `bench --json`, and the attributes of EXR files.

#include <functional>
#include <nlohmann/json_fwd.hpp>

#include "apps/settings/table/table.h"
#include "render/plan/plan.h"

namespace kaustik::app {

// The rows that `listed` picks, by their names with underscores ("cone_k"), in the order of the table. Counts
// and numbers are JSON numbers (64-bit counts exactly), settings of several values are arrays, all else is a
// string; a setting without a value is left out. `direct`, `caustics` and `indirect` are those of the plan.
nlohmann::ordered_json settings_json(const Settings& settings, const render::EstimatorPlan& plan,
                                     const std::function<bool(const Setting&)>& listed);

// Those that decide the sums over samples. `passes` is left out: a render says how many passes it had, which
// may be another number.
nlohmann::ordered_json statistics_settings(const Settings& settings, const render::EstimatorPlan& plan);

}  // namespace kaustik::app
