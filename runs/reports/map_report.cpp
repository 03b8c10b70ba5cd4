#include "runs/reports/map_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/memory.h"
#include "runs/reports/acceptance_report.h"

namespace dwell {
namespace {

/// Where lines are fitted and limits hold.
std::pair<double, double> counted_range(const PsdCurve& curve, const std::vector<double>& band_edges) {
  double from = curve.resolved_from, to = curve.resolved_to;
  if (band_edges.size() >= 2) {
    from = std::max(from, 1.0 / band_edges.front());
    to = std::min(to, 1.0 / band_edges.back());
  }
  return {from, to};
}

SpectrumReport spectrum_report(const HeightMap& figure, const MapReportOptions& options, const Progress& progress) {
  PsdOptions psd_options;
  psd_options.window = options.window;
  psd_options.threads = options.threads;
  progress.step("spectrum: transform");
  const ArealPsd psd = areal_psd(figure, psd_options);
  SpectrumReport report;
  report.window = options.window;
  report.rms = std::sqrt(psd.mean_square);
  report.longest_wavelength = psd.longest_wavelength();
  report.shortest_wavelength = psd.shortest_wavelength();
  report.bridged = psd.bridged;
  report.holes = psd.holes;
  report.split = band_rms(psd, options.band_edges);
  report.limit = options.limit;
  progress.step("spectrum: curves");
  for (PsdCurve& curve : std::vector<PsdCurve>{psd_along_x(psd), psd_along_y(psd), radial_psd(psd)}) {
    const auto [from, to] = counted_range(curve, options.band_edges);
    CurveReport c{std::move(curve), {}, {}};
    c.fit = fit_psd_line(c.curve, from, std::min(to, 0.5 * c.curve.resolved_to));
    if (options.limit && options.limit->radial == (c.curve.name == "radial")) {
      c.limit = check_psd_limit(c.curve, options.limit->line, from, to);
    }
    report.curves.push_back(std::move(c));
  }
  return report;
}

}  // namespace

bool SpectrumReport::limit_met() const {
  return std::all_of(curves.begin(), curves.end(), [](const CurveReport& c) { return !c.limit || c.limit->met(); });
}

std::vector<std::string> MapReport::broken_limits() const {
  std::vector<std::string> limits;
  for (std::string& unmet : unmet_limits(acceptance)) limits.push_back(std::move(unmet));
  if (!spectrum) return limits;
  for (const CurveReport& c : spectrum->curves) {
    if (!c.limit || c.limit->met()) continue;
    limits.push_back(fmt::format("the {} spectrum is up to {:.3g} times its limit, at {:.4g} /mm ({:.4g} mm)",
                                 c.curve.name, c.limit->worst_factor, c.limit->worst_frequency,
                                 1.0 / c.limit->worst_frequency));
  }
  return limits;
}

MapFigures map_figures(const MapReport& report, const std::string& file, const HeightMap& map, Index valid_pixels,
                       const std::string& aperture) {
  return {file, map.grid, map.history, valid_pixels, aperture, to_string(report.removed), report.statistics};
}

MapReport map_report(const HeightMap& map, const MapReportOptions& options, const Progress& progress) {
  constexpr double kCopies = 2.0;  // the figure, and what the robust PV leaves of it
  require_memory(kCopies * sizeof(double) * static_cast<double>(map.grid.size()),
                 fmt::format("the report of {} x {} pixels", map.grid.rows, map.grid.cols));
  MapReport report;
  report.removed = options.removed;
  report.figure = map;
  progress.step(fmt::format("removing {}", to_string(options.removed)));
  report.removed_fit = remove_polynomials(report.figure, options.removed, options.threads);
  report.statistics = map_statistics(report.figure, {}, options.threads);
  progress.step("robust PV: 36 Zernike terms");
  report.robust = robust_pv(report.figure, options.threads);
  if (report.robust) report.statistics.pvr = report.robust->pvr;
  progress.step("slopes");
  report.slope = slope_statistics(report.figure, options.threads);
  report.form = options.form;
  if (options.form) {
    progress.step(fmt::format("fitting {}", to_string(*options.form)));
    HeightMap residual = map;
    report.form_fit = remove_polynomials(residual, *options.form, options.threads);
    report.form_residual = with_robust_pv(map_statistics(residual, {}, options.threads), residual, options.threads);
  }
  if (options.spectrum) report.spectrum = spectrum_report(report.figure, options, progress);
  if (!options.accept.empty()) {
    progress.step("judging the map");
    report.acceptance = judge_surface(report.figure, {}, options.accept, options.threads, progress);
  }
  return report;
}

}  // namespace dwell
