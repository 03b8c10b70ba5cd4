#pragma once

#include <string>
#include <string_view>

#include "runs/plan/uncertainty_spec.h"

namespace dwell {

/// What of a plan is uncertain, and how many truths are drawn of it.
struct SampledUncertainty {
  UncertaintySpec unsure;
  int samples = 200;
  unsigned seed = 1;

  friend bool operator==(const SampledUncertainty&, const SampledUncertainty&) = default;
};

/// Reads what parse_uncertainty_spec reads, and beside it samples=N (from 2 to 10000) and seed=N (from 0 to 2^31 - 1).
/// Throws InputError as that does, if nothing is uncertain, and for a drift, which is from run to run and has no
/// meaning for one plan.
SampledUncertainty parse_sampled_uncertainty(std::string_view text);

/// Text that reads back equal: the sizes, then samples, then seed.
std::string to_string(const SampledUncertainty& uncertainty);

}  // namespace dwell
