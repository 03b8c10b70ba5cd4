#include "runs/reports/residual_advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "runs/base/percent_text.h"

namespace dwell {
namespace {

/// A way to lower the mean square that is left, and by what share of it.
struct Remedy {
  double gain;
  std::string sentence;
};

Remedy mask(const ResidualAnatomy& a, double whole) {
  const double share = a.mean_square.blemishes / whole;
  return {share,
          fmt::format(
              "mask the blemishes (dwell plan --blemishes leave-out): they hold {:.3g} % of the mean square on {:.2g} "
              "% of the area",
              100.0 * share, 100.0 * static_cast<double>(a.blemish_pixels) / static_cast<double>(a.pixels))};
}

/// What the zone at the edge has beyond an interior of the same area.
Remedy overrun(const ResidualAnatomy& a, const AdviceFacts& facts, double whole) {
  const double edge = a.edge_density(), inside = a.interior_density();
  if (!(edge > inside)) return {0.0, ""};
  const double gain = a.mean_square.edge / whole * (1.0 - inside / edge);
  const std::string excess =
      inside > 0.0 ? fmt::format("the zone at the edge leaves {:.2g} times the interior's mean square", edge / inside)
                   : "all that is left is in the zone at the edge";
  if (facts.overrun && *facts.overrun >= a.fwhm) {
    return {gain,
            fmt::format("a smaller tool: {}, though the path overruns the part by {:.3g} mm", excess, *facts.overrun)};
  }
  return {gain, fmt::format(
                    "overrun: {}{}; a path that runs on by the FWHM, {:.3g} mm, removes all that the tool can", excess,
                    facts.overrun
                        ? fmt::format(" and the path reaches {:.3g} mm beyond the part", std::max(0.0, *facts.overrun))
                        : "",
                    a.fwhm)};
}

Remedy less_smoothness(const AdviceFacts& facts) {
  const double cost = facts.smoothness_cost.value_or(0.0);
  return {cost, fmt::format("less smoothness: it costs at least {} % of the mean square", percent_text(cost))};
}

Remedy longer_run(const AdviceFacts& facts) {
  const double cost = facts.price_cost.value_or(0.0);
  return {cost, fmt::format("a longer run: the time price costs about {} % of the mean square", percent_text(cost))};
}

/// Waves that the tool reaches, and that neither price nor smoothness leaves.
Remedy finer_path(const ResidualAnatomy& a, const AdviceFacts& facts, double whole) {
  const double long_waves = (a.mean_square.middle + a.mean_square.longer) / whole;
  const bool known = facts.price_cost.has_value();  // else the weights may leave them
  return {long_waves - facts.price_cost.value_or(0.0) - facts.smoothness_cost.value_or(0.0),
          fmt::format(
              "{}: {:.3g} % of the mean square is in waves longer than the tool's FWHM of {:.3g} mm, which it can "
              "reach",
              known ? "a finer path, or a machine of shorter dwell" : "a longer run, less smoothness or a finer path",
              100.0 * long_waves, a.fwhm)};
}

}  // namespace

std::string residual_advice(const ResidualAnatomy& a, const AdviceFacts& facts) {
  const double whole = a.mean_square.whole() - (facts.blemishes_left_out ? a.mean_square.blemishes : 0.0);
  if (!(whole > 0.0)) return "nothing is left";
  if (facts.fraction < 1.0) {
    return fmt::format("--fraction 1: {:.3g} % of the error is left on purpose", 100.0 * (1.0 - facts.fraction));
  }
  const Remedy masking = facts.blemishes_left_out ? Remedy{0.0, ""} : mask(a, whole);
  const std::array<Remedy, 5> remedies{masking, overrun(a, facts, whole), less_smoothness(facts), longer_run(facts),
                                       finer_path(a, facts, whole)};
  const auto best = std::max_element(remedies.begin(), remedies.end(),
                                     [](const Remedy& x, const Remedy& y) { return x.gain < y.gain; });
  if (best->gain >= kWorthAWord) return best->sentence;
  return fmt::format(
      "this tool can go no further: {:.3g} % of the mean square is in waves shorter than its FWHM of {:.3g} mm, which "
      "only a smaller tool reaches",
      100.0 * a.mean_square.shorter / whole, a.fwhm);
}

}  // namespace dwell
