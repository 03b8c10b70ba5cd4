#include "runs/campaigns/pareto_part.h"

#include "runs/base/exact_json.h"
#include "runs/campaigns/solver_fields.h"

namespace dwell {

template <class Visit>
void each_field(Weights& w, const Visit& visit) {
  visit("smoothness", w.smoothness), visit("time_price_nm2_per_s", w.time_price);
}

template <class Visit>
void each_field(TradeOff& t, const Visit& visit) {
  visit("residual_rms_nm", t.residual_rms), visit("total_s", t.total), visit("step_rms_s", t.step_rms);
}

template <class Visit>
void each_field(LiftTotals& l, const Visit& visit) {
  visit("lifts", l.lifts), visit("plunges", l.plunges), visit("lift_s", l.lift), visit("plunge_s", l.plunge);
  visit("settle_s", l.settle);
}

template <class Visit>
void each_field(TravelTimes& t, const Visit& visit) {
  visit("between_stops_s", t.between_stops), visit("lifted_s", t.lifted), visit("down_s", t.down);
  visit("rests", t.rests);
}

template <class Visit>
void each_field(ParetoRanges& r, const Visit& visit) {
  visit("smoothnesses", r.smoothnesses), visit("time_prices_nm2_per_s", r.time_prices);
}

/// All but the front, which only all points show.
template <class Visit>
void each_field(ParetoPoint& p, const Visit& visit) {
  visit("weights", p.weights), visit("trade_off", p.trade_off), visit("exact_rms_nm", p.exact_rms);
  visit("standard_error_nm", p.standard_error), visit("objective_nm2", p.objective), visit("solver", p.solver);
  visit("lattice_too_coarse", p.lattice_too_coarse);
}

SweepPart pareto_part(const ParetoSweep& sweep, const Shard& shard) {
  SweepPart part{kParetoCommand, shard, sweep.points.size(), sheet_json(sweep.sheet)};
  part.asked["path"] = sweep.path;
  part.asked["ranges"] = exact_json(sweep.ranges);
  part.asked["travel"] = exact_json(sweep.travel);
  for (const std::size_t task : shard.tasks_of(part.tasks)) part.results.push_back(exact_json(sweep.points[task - 1]));
  return part;
}

ParetoSweep merged_pareto(const MergedParts& parts) {
  ParetoSweep sweep;
  sweep.sheet = sheet_of_json(parts.asked);
  sweep.path = parts.asked.at("path");
  read_exact(parts.asked.at("ranges"), sweep.ranges);
  read_exact(parts.asked.at("travel"), sweep.travel);
  for (const auto& result : parts.results) read_exact(result, sweep.points.emplace_back());
  conclude(sweep);
  return sweep;
}

}  // namespace dwell
