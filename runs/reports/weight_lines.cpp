#include "runs/reports/weight_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/counted.h"
#include "core/base/duration_text.h"
#include "runs/base/json_blocks.h"
#include "runs/job/job.h"
#include "runs/plan/usual_smoothness.h"
#include "runs/reports/front_lines.h"
#include "runs/reports/price_estimates.h"

namespace dwell {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kIndent = "          ";

/// Of the objective's optimum [%]: gains below it are said to be little.
constexpr double kLittleGain = 0.1;

/// Where a weight comes from. A search for which there was no time leaves what Auto gives.
const char* source_of(const WeightGoal& goal, const DwellPlan& plan) {
  if (goal.kind == GoalKind::Fixed) return "given";
  if (goal.kind == GoalKind::Auto || !plan.search) return "auto";
  return goal.kind == GoalKind::Corner ? "corner" : "target";
}

std::string smoothness_line(const PlannedJob& plan) {
  const double fwhm = equivalent_fwhm(plan.part());
  return fmt::format(
      "{}smoothness: along the path, waves of dwell of {:.3g} mm ({} times the FWHM of the Gaussian of "
      "the tool's volume and energy) are held back by half\n",
      kIndent, kHalfHeldWave * fwhm, kHalfHeldWave);
}

std::string rule_in_words(const TimeWorth& worth, PriceRule rule) {
  return rule == PriceRule::Share
             ? fmt::format("one per cent more time would lower the mean square left by {} %", worth.share)
             : fmt::format("the next second is worth {} of the average one above the least dwell", worth.average);
}

std::string in_words(const PricedTradeOff& plan) {
  return fmt::format("{:.4g} nm in {}", plan.trade_off.residual_rms, duration_text(plan.trade_off.total));
}

/// Of what the estimates are, behind "RMS".
std::string of_what(const PlannedJob& plan) {
  return std::string(about_zero_in_words(plan.dwell.residual)) +
         (plan.job.options.fraction < 1.0 ? " of the fraction that is to be removed" : "") +
         (plan.dwell.left_out && !plan.dwell.left_out->pixels.empty() ? " without the blemishes left out" : "");
}

/// What a user wants to know who has to choose a price.
std::string price_lines(const PlannedJob& plan) {
  const TimePrice& worth = *plan.dwell.worth;
  if (!(worth.price > 0.0)) {
    return fmt::format("{}time price: no dwell above the least removes anything; this run is the least dwell\n",
                       kIndent);
  }
  std::string text = fmt::format("{}time price: {}\n", kIndent, rule_in_words(plan.job.options.time_worth, worth.rule));
  const auto estimates = price_estimates(plan);
  if (!estimates) {
    return text + fmt::format("{}            found with the smoothness {:.4g}\n", kIndent, plan.dwell.worth_smoothness);
  }
  text += fmt::format("{}            half of it: about {}; twice: about {} (RMS{}, dwell; estimated on a model)\n",
                      kIndent, in_words(estimates->half), in_words(estimates->twice), of_what(plan));
  text += fmt::format(
      "{}            the least that this tool leaves on this path at this smoothness is about {:.4g} nm RMS{} "
      "(estimated "
      "on a model)\n",
      kIndent, estimates->least_rms, of_what(plan));
  return text;
}

}  // namespace

std::string weight_lines(const PlannedJob& plan) {
  const JobOptions& options = plan.job.options;
  const DwellPlan& dwell = plan.dwell;
  std::string text = fmt::format(
      "weights   smoothness {:.4g} ({}), time price {:.4g} nm^2/s ({}){}\n", dwell.weights.smoothness,
      source_of(options.smoothness, dwell), dwell.weights.time_price, source_of(options.time_price_nm2_per_s, dwell),
      dwell.search ? fmt::format(", chosen from {}", counted(dwell.search->trials.size(), "solve"))
      : weights_are_searched(dwell_options(options)) ? "; there was no time for the search"
                                                     : "");
  if (options.smoothness.kind == GoalKind::Auto) text += smoothness_line(plan);
  if (dwell.worth) text += price_lines(plan);
  if (dwell.weights.time_price == 0.0 && !dwell.worth) {
    text += fmt::format(
        "{}at a time price of 0 the total is not determined: a constant dwell may be added at no cost\n", kIndent);
  }
  if (dwell.search) text += front_lines(*dwell.search, options.smoothness, options.time_price_nm2_per_s);
  return text;
}

std::string optimum_line(const DwellPlan& plan) {
  const double gap = plan.certificate.gap();
  if (!std::isfinite(gap)) return "optimum   no bound is proven\n";
  constexpr double kRough = 0.01;
  return fmt::format("optimum   this plan's objective is at most {:.3g} % above it: proven{}\n", 100.0 * gap,
                     gap > kRough ? " (a bound: --certify 1% goes on until it is that near)" : "");
}

std::optional<std::string> little_gained(const PlannedJob& plan, const MapStatistics& before,
                                         const MapStatistics& after) {
  const double was = before.rms_about_zero(), left = after.rms_about_zero();
  if (!(was > 0.0) || left > was || left < (1.0 - kLittleGain) * was) return std::nullopt;
  const auto estimates = price_estimates(plan);
  const std::string reach =
      estimates
          ? fmt::format("; about {:.4g} nm RMS{} is the least that this tool leaves on this path at this smoothness",
                        estimates->least_rms, of_what(plan))
          : "";
  return fmt::format("this run gains {:.2g} % of the RMS{}, from {:.4g} to {:.4g} nm{}", 100.0 * (1.0 - left / was),
                     about_zero_in_words(before), was, left, reach);
}

Json weights_block(const PlannedJob& plan) {
  const DwellPlan& dwell = plan.dwell;
  const JobOptions& options = plan.job.options;
  Json weights{{"smoothness", dwell.weights.smoothness},
               {"smoothness_from", source_of(options.smoothness, dwell)},
               {"time_price_nm2_per_s", dwell.weights.time_price},
               {"time_price_from", source_of(options.time_price_nm2_per_s, dwell)}};
  if (options.smoothness.kind == GoalKind::Auto) {
    weights["half_held_wave_mm"] = kHalfHeldWave * equivalent_fwhm(plan.part());
  }
  if (!dwell.worth) return weights;
  const auto estimate = [](const PricedTradeOff& p) {
    return Json{{"time_price_nm2_per_s", p.price},
                {"residual_rms_nm", p.trade_off.residual_rms},
                {"total_s", p.trade_off.total},
                {"step_rms_s", p.trade_off.step_rms}};
  };
  weights["worth"] = {{"rule", dwell.worth->rule == PriceRule::Share ? "share" : "average"},
                      {"smoothness", dwell.worth_smoothness},
                      {"least_dwell_rms_nm", dwell.worth->least.residual_rms},
                      {"least_dwell_total_s", dwell.worth->least.total}};
  if (const auto estimates = price_estimates(plan)) {
    weights["worth"]["estimates"] = {{"least_rms_nm", estimates->least_rms},
                                     {"half_price", estimate(estimates->half)},
                                     {"twice_price", estimate(estimates->twice)}};
  }
  return weights;
}

}  // namespace dwell
