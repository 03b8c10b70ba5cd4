#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace dwell::bench {

/// docs/benchmarks.md from the JSON of a run: machine, micro results, one summary line and one table a scenario.
/// `picture` is its path relative to the Markdown file.
std::string markdown_report(const nlohmann::json& all, const std::string& picture);

/// The picture of the report, as a PNG file.
std::string chart_of(const nlohmann::json& all);

}  // namespace dwell::bench
