#pragma once
// Writes a sweep's result as JSON and CSV, and single cells as JSON, from which a later run reads them.
// docs/reference/command_line.md explains the fields.

#include "apps/sweep/sweep_result.h"

namespace kaustik::app {

Json cell_json(const SweepCell& cell);
// The inverse of cell_json, except that point and flags are left for the caller to set. Throws
// std::runtime_error or nlohmann::json exceptions.
SweepCell cell_from_json(const Json& in);

// The whole result, with the Pareto front and the advice computed from the cells.
Json sweep_json(const SweepResult& result);

// A header line, then one line per cell. Numbers are written as in the JSON; null becomes an empty field.
std::string sweep_csv(const SweepResult& result);

}  // namespace kaustik::app
