#pragma once

#include <nlohmann/json.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/removal/exact_residual.h"
#include "runs/plan/program_samples.h"

namespace dwell {

/// The same of the plan without `robust plan`, by the same random numbers.
struct PlainUncertainty {
  double nominal_rms = 0.0;  // [nm]
  std::array<double, kUncertainCauses> alone{};
  std::vector<ProgramSample> samples;
  double dwell_s = 0.0;
  double weight_share = 1.0;  // of its weights that the robust plan has
};

/// What a plan's program may leave, by what of it is uncertain.
struct PlanUncertainty {
  SampledUncertainty of;
  double nominal_rms = 0.0, nominal_pv = 0.0;    // if all is as it is thought; RMS about zero [nm]
  std::array<double, kUncertainCauses> alone{};  // what each adds to the mean square, in expectation [nm^2]
  ProgramSamples drawn;
  std::optional<PlainUncertainty> plain{};  // of a robust plan
  double dwell_s = 0.0;                     // of the plan
};

/// Samples a motion on a part, whose prediction is `exact`. Throws as ProgramSampler, which states the cost.
PlanUncertainty uncertainty_of_motion(const Part& part, const Program& motion, const RemovalKernel& kernel,
                                      const ExactResidual& exact, const SampledUncertainty& uncertainty,
                                      const Progress& progress = {});

/// The middle and the range of a figure over samples.
struct SampledRange {
  double fifth = 0.0, median = 0.0, ninety_fifth = 0.0;  // 5 %, 50 % and 95 % [nm]
};
SampledRange range_of_rms(const std::vector<ProgramSample>& samples);
SampledRange range_of_pv(const std::vector<ProgramSample>& samples);

/// Root of the mean square that is expected, which a robust plan makes small: what is left if all is as it is thought
/// and what each cause adds [nm]. It has no error of sampling.
double expected_rms(double nominal_rms, const std::array<double, kUncertainCauses>& alone);

/// Root of the mean square that the samples leave [nm].
double sampled_rms(const std::vector<ProgramSample>& samples);

/// Which cause is most of it, one sentence with what it adds of what all add, both as roots of mean squares: "position
/// is most of it: 0.31 of 0.35 nm".
std::string dominant_sentence(const std::array<double, kUncertainCauses>& alone);

/// Lines of a table, the first beginning with "uncertain", each ending with a new line.
std::string uncertainty_lines(const PlanUncertainty& uncertainty);

/// The block "uncertainty" of the JSON (docs/json.md).
nlohmann::ordered_json uncertainty_block(const PlanUncertainty& uncertainty);

}  // namespace dwell
