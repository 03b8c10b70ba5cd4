#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "runs/drawing/line_chart.h"
#include "runs/reports/map_report.h"

namespace dwell {
namespace {

constexpr Colour kLimit{200, 30, 30}, kBlue{33, 102, 172}, kGreen{27, 120, 55}, kViolet{118, 42, 131};

Colour colour_of(const std::string& name) { return name == "x" ? kBlue : name == "y" ? kGreen : kViolet; }

/// Colours of the fits, which differ from each other and from those of the curves on which the fits lie.
Colour colour_of_fit(const std::string& name) {
  return name == "x" ? Colour{240, 130, 0} : name == "y" ? Colour{20, 20, 20} : Colour{230, 170, 0};
}

ChartLine straight(const std::string& label, Colour colour, const PsdLine& line, double from, double to) {
  return {label, colour, {{from, line(from), false}, {to, line(to), false}}, false, true};
}

void add_curve(ChartPanel& panel, const CurveReport& c) {
  const Colour colour = colour_of(c.curve.name);
  ChartLine line{c.curve.name == "radial" ? "radial" : "along " + c.curve.name, colour, {}, false, false};
  for (std::size_t k = 0; k < c.curve.frequency.size(); ++k) {
    // A logarithmic axis has no place for a density of zero.
    if (c.curve.density[k] > 0.0) line.points.push_back({c.curve.frequency[k], c.curve.density[k], false});
  }
  panel.lines.push_back(std::move(line));
  if (!c.fit) return;
  const PsdLineFit& fit = *c.fit;
  const std::string label = fmt::format("{}: {:.3g} {}", c.curve.name, fit.line.a, power_of_frequency(fit.line));
  panel.lines.push_back(straight(label, colour_of_fit(c.curve.name), fit.line, fit.from, fit.to));
}

void add_limit(ChartPanel& panel, const PsdLimitCheck& check, const PsdLimit& limit) {
  panel.lines.push_back(straight(fmt::format("limit {:.3g} {}", limit.line.a, power_of_frequency(limit.line)), kLimit,
                                 limit.line, check.from, check.to));
}

void add_bands(ChartPanel& panel, const std::vector<BandRms>& bands) {
  for (std::size_t k = 0; k < bands.size(); ++k) {
    const double from = std::isfinite(bands[k].longest) ? 1.0 / bands[k].longest : 0.0;
    const double to = bands[k].shortest > 0.0 ? 1.0 / bands[k].shortest : std::numeric_limits<double>::infinity();
    const Colour colour = k % 2 == 0 ? Colour{255, 255, 255} : Colour{244, 246, 232};
    const std::string value = bands[k].rms ? fmt::format("{:.3g} nm", *bands[k].rms) : "not resolved";
    panel.bands.push_back({bands[k].name + " " + value, from, to, colour});
  }
}

}  // namespace

std::string psd_picture(const MapReport& report, const std::string& title, FigureFormat format) {
  if (!report.spectrum) throw std::invalid_argument("psd_picture: no spectrum in the report");
  ChartPanel lines{"frequency [1/mm]", "PSD along a line [nm² mm]", {}};
  ChartPanel radial{"frequency [1/mm]", "radial PSD [nm² mm²]", {}};
  for (const CurveReport& c : report.spectrum->curves) add_curve(c.curve.name == "radial" ? radial : lines, c);
  for (ChartPanel* panel : {&lines, &radial}) add_bands(*panel, report.spectrum->split.bands);
  if (const auto& limit = report.spectrum->limit) {
    // The two line spectra share one limit: it is drawn once, over the longer of their ranges.
    const CurveReport* widest = nullptr;
    for (const CurveReport& c : report.spectrum->curves) {
      if (c.limit && c.limit->checked > 0 && (!widest || c.limit->from < widest->limit->from)) widest = &c;
    }
    if (widest) add_limit(limit->radial ? radial : lines, *widest->limit, *limit);
  }
  return draw_line_charts(title, "", {lines, radial}, format);
}

}  // namespace dwell
