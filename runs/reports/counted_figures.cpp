#include "runs/reports/counted_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "runs/base/json_blocks.h"
#include "runs/plan/counted_pixels.h"

namespace dwell {

std::optional<CountedFigures> counted_figures(const Job& job, const HeightMap& left) {
  const JobOptions& options = job.options;
  const bool clear = options.clear_aperture.kind != Aperture::Kind::Map;
  if (!clear && options.weight.empty()) return std::nullopt;
  const Part& part = *job.part;
  CountedFigures figures;
  figures.counted = part.map.valid_pixels();
  figures.measured = figures.counted + (part.beside.values.empty() ? 0 : part.beside.valid_pixels());
  if (clear) figures.clear_aperture = to_string(options.clear_aperture);
  figures.weight = options.weight;
  if (part.weights.empty()) return figures;
  figures.least = std::numeric_limits<double>::infinity();
  figures.most = 0.0;
  for (const Index pixel : finite_pixels(part.map)) {
    const double w = part.weights[static_cast<std::size_t>(pixel)];
    figures.least = std::min(figures.least, w);
    figures.most = std::max(figures.most, w);
  }
  figures.before_rms = weighted_rms(part, part.figure);
  figures.after_rms = weighted_rms(part, left);
  return figures;
}

std::string counted_lines(const std::optional<CountedFigures>& figures) {
  if (!figures) return "";
  const CountedFigures& f = *figures;
  std::string text = fmt::format("counts    {} of {} pixels{}{}{}\n", f.counted, f.measured,
                                 f.clear_aperture.empty() ? "" : fmt::format(", clear aperture {}", f.clear_aperture),
                                 f.weight.empty() ? "" : fmt::format(", weight {}", f.weight),
                                 f.counted < f.measured ? "; the others are shown and have no say" : "");
  if (f.before_rms && f.after_rms) {
    text += fmt::format("          weights {:.4g} to {:.4g}; RMS with them {:.4g} nm before, {:.4g} nm after\n",
                        f.least, f.most, *f.before_rms, *f.after_rms);
  }
  return text;
}

nlohmann::ordered_json counted_block(const CountedFigures& figures) {
  return {{"measured_pixels", figures.measured},
          {"counted_pixels", figures.counted},
          {"clear_aperture", figures.clear_aperture},
          {"weight", figures.weight},
          {"least_weight", figures.least},
          {"largest_weight", figures.most},
          {"weighted_rms_before_nm", finite_or_null(figures.before_rms)},
          {"weighted_rms_after_nm", finite_or_null(figures.after_rms)}};
}

}  // namespace dwell
