#pragma once
// A sweep's result as texts: the JSON of a cell (what a finished cell leaves, and all that a later run needs
// of it), the whole as JSON and CSV. docs/cli.md explains the fields.

#include "apps/sweep/sweep_result.h"

namespace kaustik::app {

Json cell_json(const SweepCell& cell);
// The inverse but for point and flags, which the caller knows. Throws std::runtime_error or nlohmann's
// errors.
SweepCell cell_from_json(const Json& in);

// Indented, ends in a newline; with the Pareto front and the advice, which follow from the cells.
Json sweep_json(const SweepResult& result);

// One line a cell after the names of the columns; numbers as in the JSON, empty where that has null.
std::string sweep_csv(const SweepResult& result);

}  // namespace kaustik::app
