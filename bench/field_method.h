#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "bench/budget.h"
#include "bench/measurements.h"
#include "bench/suite.h"

namespace dwell::bench {

/// The field's method on the scenarios whose dwell points lie on a lattice: iterative Fourier inversion with
/// thresholding, as bench/peers/rifta.py has it from the paper (Wang et al., Sci. Rep. 10:8135, 2020). It has no
/// objective to be compared by, so what it leaves and takes is measured: one entry each with
///   scenario, seconds, gamma, iterations   of the script
///   residual_rms, total_dwell              of its dwell [nm], [s], by the scenario's own removal operator
/// or "skipped" or "failed" with the reason.
nlohmann::json run_field_method(const SuiteOptions& options, const Budget& budget, Measurements& measurements);

/// As a Markdown table, beside `auto` on the same data, from the results of the whole run.
std::string field_table(const nlohmann::json& all);

}  // namespace dwell::bench
