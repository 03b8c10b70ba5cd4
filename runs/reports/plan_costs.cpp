#include "runs/reports/plan_costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "runs/base/json_blocks.h"
#include "runs/base/percent_text.h"
#include "runs/reports/anatomy_lines.h"
#include "runs/reports/price_estimates.h"

namespace dwell {
namespace {

using Json = nlohmann::ordered_json;

/// How far the path reaches beyond the pixels with data, on the side where it least does [mm]; below zero where it ends
/// before. A map of one row or column has two ends and no other sides.
double overrun_of(const HeightMap& map, const ToolPath& path) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const Grid& g = map.grid;
  Point low{kInfinite, kInfinite}, high{-kInfinite, -kInfinite}, first = low, last = high;
  for (Index row = 0; row < g.rows; ++row) {
    for (Index col = 0; col < g.cols; ++col) {
      if (!std::isfinite(map.at(row, col))) continue;
      const Point p = g.centre(row, col);
      low = {std::min(low.x, p.x), std::min(low.y, p.y)}, high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  for (const Point p : path.points) {
    first = {std::min(first.x, p.x), std::min(first.y, p.y)}, last = {std::max(last.x, p.x), std::max(last.y, p.y)};
  }
  const double in_x = std::min(low.x - first.x, last.x - high.x), in_y = std::min(low.y - first.y, last.y - high.y);
  if (g.size() == 1 || (g.rows > 1 && g.cols > 1)) return std::min(in_x, in_y);
  return g.rows == 1 ? in_x : in_y;
}

/// The share of the mean square that a run that leaves `rms` would leave less than one that leaves `left`.
double share_above(double left, double rms) {
  return left > 0.0 ? std::max(0.0, 1.0 - rms * rms / (left * left)) : 0.0;
}

}  // namespace

AdviceFacts advice_facts(const PlannedJob& plan) {
  AdviceFacts facts;
  facts.fraction = plan.job.options.fraction;
  facts.blemishes_left_out = plan.dwell.left_out && !plan.dwell.left_out->pixels.empty();
  facts.overrun = overrun_of(plan.part().map, plan.laid.path);
  if (facts.fraction < 1.0) return facts;
  const auto estimates = price_estimates(plan);
  if (!estimates) return facts;
  const double left = left_by_fit(plan.dwell);
  facts.price_cost = share_above(left, estimates->least_rms);
  if (estimates->unsmoothed_rms)
    facts.smoothness_cost = std::max(0.0, share_above(left, *estimates->unsmoothed_rms) - *facts.price_cost);
  return facts;
}

std::string cost_line(const PlannedJob& plan) {
  const AdviceFacts facts = advice_facts(plan);
  if (!facts.price_cost) return "";
  return fmt::format(
      "cost      of the mean square about {} % for the time price{} (estimated on a model)\n",
      percent_text(*facts.price_cost),
      facts.smoothness_cost ? fmt::format(", at least {} % for smoothness", percent_text(*facts.smoothness_cost)) : "");
}

std::string left_out_line(const DwellPlan& plan) {
  if (!plan.left_out) return "";
  const LeftOut& l = *plan.left_out;
  if (l.pixels.empty()) return "left out  nothing: no blemishes were found\n";
  return fmt::format(
      "left out  of the fit {} pixels of {} blemishes; with them in it: RMS {:.4g} nm, {:.4g} nm without them\n",
      l.pixels.size(), l.blemishes, l.rms_before, l.rms_before_without);
}

Json plan_anatomy_block(const PlannedJob& plan, const WrittenPlan& written) {
  Json block = anatomy_block(written.anatomy, written.advice);
  const AdviceFacts facts = advice_facts(plan);
  if (facts.price_cost) block["price_cost"] = *facts.price_cost;
  if (facts.smoothness_cost) block["smoothness_cost"] = *facts.smoothness_cost;
  if (plan.dwell.left_out) {
    const LeftOut& l = *plan.dwell.left_out;
    block["left_out"] = {{"blemishes", l.blemishes},
                         {"pixels", l.pixels.size()},
                         {"fit_rms_nm", l.fit_rms},
                         {"before_rms_nm", l.rms_before},
                         {"before_without_rms_nm", l.rms_before_without}};
  }
  return block;
}

}  // namespace dwell
