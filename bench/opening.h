#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace dwell::bench {

/// What a user wants to know of a run, in five sentences; one says so where the run did not measure what it is about.
std::string opening_sentences(const nlohmann::json& all);

/// The picture that goes with them: seconds to within 1 % against dwell points, of `auto` and of the fastest peer on
/// each scenario; and quality against time on one of them, all solvers. As a PNG file.
std::string opening_picture(const nlohmann::json& all);

}  // namespace dwell::bench
