#pragma once

#include <nlohmann/json.hpp>

#include "bench/budget.h"

namespace dwell::bench {

/// Times every planner on one thread. Each line of the result has "path" (as --path takes it), "points", "repetitions",
/// "seconds" (median), "fastest" and "slowest", "lifts", "length_ratio" (length from point to point over that of as
/// many steps of a pitch), "notes"; or "skipped" where there was no time. Maps have 512^2 pixels (for cells, one pixel
/// a cell), paths about 10^6 points, with `quick` 10^5. The last two lines are a nearest-neighbour path over the cells
/// of a random map above a critical value, some 10^5 (10^4) of 2 10^5, and the same path shortened. Starts none after
/// `share` of the budget.
nlohmann::json run_planners(bool quick, const Budget& budget, double share);

/// As a Markdown table.
std::string planner_table(const nlohmann::json& planners);

}  // namespace dwell::bench
