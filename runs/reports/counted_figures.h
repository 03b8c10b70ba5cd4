#pragma once

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

#include "runs/job/job.h"

namespace dwell {

/// Which pixels of a map count, how much, and what they leave as the fit counts it.
struct CountedFigures {
  Index measured = 0, counted = 0;              // pixels with data in the aperture, and of these with a weight above 0
  double least = 1.0, most = 1.0;               // weights of the counted ones, as given
  std::string clear_aperture, weight;           // as the user gave them; empty: not given
  std::optional<double> before_rms, after_rms;  // about zero, weighted [nm]; nothing if all that count have one weight
};

/// Of a job and the surface that is left of its part, form terms removed [nm]; nothing where neither a clear aperture
/// nor weights are given. Cost O(pixels).
std::optional<CountedFigures> counted_figures(const Job& job, const HeightMap& left);

/// Lines of a table that say so, the first beginning with "counts", each ending with a new line; empty without figures.
std::string counted_lines(const std::optional<CountedFigures>& figures);

/// The block "counted" of the JSON (docs/json.md).
nlohmann::ordered_json counted_block(const CountedFigures& figures);

}  // namespace dwell
