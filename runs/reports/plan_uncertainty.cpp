#include "runs/reports/plan_uncertainty.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/numerics/quantile.h"

namespace dwell {
namespace {

SampledRange range_of(const std::vector<ProgramSample>& samples, double ProgramSample::*figure) {
  std::vector<double> values;
  values.reserve(samples.size());
  for (const ProgramSample& sample : samples) values.push_back(sample.*figure);
  std::sort(values.begin(), values.end());
  return {quantile(values, 0.05), quantile(values, 0.5), quantile(values, 0.95)};
}

/// The root of what is added to a mean square; below zero where it is taken off.
double added_rms(double square) { return std::copysign(std::sqrt(std::abs(square)), square); }

double sum_of(const std::array<double, kUncertainCauses>& alone) {
  return std::accumulate(alone.begin(), alone.end(), 0.0);
}

UncertainCause largest_of(const std::array<double, kUncertainCauses>& alone) {
  return static_cast<UncertainCause>(std::max_element(alone.begin(), alone.end()) - alone.begin());
}

bool is_uncertain(const UncertaintySpec& unsure, UncertainCause cause) {
  const std::array<double, kUncertainCauses> sizes{unsure.tif_rate, unsure.tif_width, unsure.position,
                                                   unsure.offset,   unsure.rotation,  unsure.metrology};
  return sizes[static_cast<std::size_t>(cause)] > 0.0;
}

}  // namespace

PlanUncertainty uncertainty_of_motion(const Part& part, const Program& motion, const RemovalKernel& kernel,
                                      const ExactResidual& exact, const SampledUncertainty& uncertainty,
                                      const Progress& progress) {
  const ProgramSampler sampler(part, motion, kernel, exact.surface, uncertainty.unsure, uncertainty.seed);
  PlanUncertainty result;
  result.of = uncertainty;
  result.nominal_rms = std::sqrt(sampler.nominal_square());
  result.nominal_pv = exact.statistics.pv;
  result.alone = sampler.alone(progress);
  result.drawn = sampler.sample(1, uncertainty.samples + 1, progress);
  return result;
}

SampledRange range_of_rms(const std::vector<ProgramSample>& samples) { return range_of(samples, &ProgramSample::rms); }
SampledRange range_of_pv(const std::vector<ProgramSample>& samples) { return range_of(samples, &ProgramSample::pv); }

double expected_rms(double nominal_rms, const std::array<double, kUncertainCauses>& alone) {
  return std::sqrt(std::max(0.0, nominal_rms * nominal_rms + sum_of(alone)));
}

double sampled_rms(const std::vector<ProgramSample>& samples) {
  double squares = 0.0;
  for (const ProgramSample& sample : samples) squares += sample.rms * sample.rms;
  return std::sqrt(squares / static_cast<double>(samples.size()));
}

std::string dominant_sentence(const std::array<double, kUncertainCauses>& alone) {
  const UncertainCause largest = largest_of(alone);
  const double square = alone[static_cast<std::size_t>(largest)], all = sum_of(alone);
  if (!(square > 0.0) || !(all > 0.0)) return "none of it adds to what is left";
  const std::string figures = fmt::format("{:.3g} of {:.3g} nm", std::sqrt(square), std::sqrt(all));
  constexpr double kMost = 0.5;
  if (square >= kMost * all) return fmt::format("{} is most of it: {}", name_of(largest), figures);
  return fmt::format("no source is most of it; {} is the largest: {}", name_of(largest), figures);
}

std::string uncertainty_lines(const PlanUncertainty& u) {
  const SampledRange rms = range_of_rms(u.drawn.samples), pv = range_of_pv(u.drawn.samples);
  std::string text =
      fmt::format("uncertain {}, {} samples, seed {}\n", to_string(u.of.unsure), u.of.samples, u.of.seed);
  text += fmt::format(
      "          RMS {:.4g} nm in the median, {:.4g} to {:.4g} nm in 90 % of them; {:.4g} nm if all is as "
      "it is thought\n",
      rms.median, rms.fifth, rms.ninety_fifth, u.nominal_rms);
  text += fmt::format("          PV {:.4g} nm in the median, {:.4g} to {:.4g} nm in 90 % of them; {:.4g} nm\n",
                      pv.median, pv.fifth, pv.ninety_fifth, u.nominal_pv);
  std::string each;
  for (std::size_t k = 0; k < kUncertainCauses; ++k) {
    const auto cause = static_cast<UncertainCause>(k);
    if (!is_uncertain(u.of.unsure, cause)) continue;
    each += fmt::format("{}{} {:.3g} nm", each.empty() ? "" : ", ", name_of(cause), added_rms(u.alone[k]));
  }
  text += fmt::format("          each alone adds, in squares: {}\n", each);
  text += fmt::format("          {}\n", dominant_sentence(u.alone));
  if (!u.plain) return text;
  const PlainUncertainty& plain = *u.plain;
  text += fmt::format(
      "robust    expected {:.5g} nm RMS, {:.4g} nm in the samples, {:.4g} nm if all is as it is thought; dwell {:.6g} "
      "s\n",
      expected_rms(u.nominal_rms, u.alone), sampled_rms(u.drawn.samples), u.nominal_rms, u.dwell_s);
  text += fmt::format("          the plan without --robust-plan: {:.5g} nm, {:.4g} nm, {:.4g} nm; {:.6g} s\n",
                      expected_rms(plain.nominal_rms, plain.alone), sampled_rms(plain.samples), plain.nominal_rms,
                      plain.dwell_s);
  if (plain.weight_share < 1.0) {
    text += fmt::format(
        "          with {:.3g} times its smoothness and time price: with all of them no less was expected\n",
        plain.weight_share);
  }
  return text;
}

nlohmann::ordered_json uncertainty_block(const PlanUncertainty& u) {
  using Json = nlohmann::ordered_json;
  const auto range = [](const SampledRange& r, double nominal) {
    return Json{{"nominal", nominal}, {"p5", r.fifth}, {"median", r.median}, {"p95", r.ninety_fifth}};
  };
  Json causes = Json::array();
  for (std::size_t k = 0; k < kUncertainCauses; ++k) {
    const auto cause = static_cast<UncertainCause>(k);
    if (!is_uncertain(u.of.unsure, cause)) continue;
    causes.push_back({{"cause", name_of(cause)}, {"adds_nm2", u.alone[k]}, {"adds_rms_nm", added_rms(u.alone[k])}});
  }
  Json samples = Json::array();
  for (const ProgramSample& s : u.drawn.samples)
    samples.push_back({{"sample", s.number}, {"rms_nm", s.rms}, {"pv_nm", s.pv}});
  Json block{{"of", to_string(u.of.unsure)},
             {"seed", u.of.seed},
             {"rms_nm", range(range_of_rms(u.drawn.samples), u.nominal_rms)},
             {"pv_nm", range(range_of_pv(u.drawn.samples), u.nominal_pv)},
             {"causes", std::move(causes)},
             {"all_add_nm2", sum_of(u.alone)},
             {"dominant", sum_of(u.alone) > 0.0 ? name_of(largest_of(u.alone)) : "none"},
             {"expected_rms_nm", expected_rms(u.nominal_rms, u.alone)},
             {"sampled_rms_nm", sampled_rms(u.drawn.samples)},
             {"samples", std::move(samples)}};
  if (u.plain) {
    block["without_robust_plan"] = {{"nominal_rms_nm", u.plain->nominal_rms},
                                    {"expected_rms_nm", expected_rms(u.plain->nominal_rms, u.plain->alone)},
                                    {"sampled_rms_nm", sampled_rms(u.plain->samples)},
                                    {"dwell_s", u.plain->dwell_s},
                                    {"weight_share", u.plain->weight_share}};
  }
  return block;
}

}  // namespace dwell
