#include <fmt/format.h>

#include <cmath>

#include "runs/reports/map_report.h"

namespace dwell {
namespace {

std::string form_text(const MapReport& report) {
  const PolynomialFit& fit = report.form_fit;
  const PolynomialSpec& spec = *report.form;
  std::string text = fmt::format("form      {}, coefficients of {}\n", to_string(spec), fit.normalisation);
  if (spec.kind == PolynomialSpec::Kind::Terms || spec.kind == PolynomialSpec::Kind::Zernike) {
    text += fmt::format("          circle about ({:.6g}, {:.6g}) mm, radius {:.6g} mm\n", fit.domain.centre.x,
                        fit.domain.centre.y, fit.domain.radius);
  } else {
    text += fmt::format("          rectangle from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) mm\n", fit.domain.x0,
                        fit.domain.y0, fit.domain.x1, fit.domain.y1);
  }
  text += fmt::format("          {:<32}{:>14}{:>14}\n", "", "coefficient", "adds RMS");
  for (const PolynomialTerm& term : fit.terms) {
    if (term.dropped) {
      text += fmt::format("          {:<32}{:>14}\n", term.name, "dropped: depends on those before it");
    } else {
      text += fmt::format("          {:<32}{:>11.5g} nm{:>11.5g} nm\n", term.name, term.coefficient,
                          std::abs(term.contribution));
    }
  }
  return text + fmt::format("          condition {:.3g}; leaves PV {:.6g} nm{}, RMS {:.6g} nm\n", fit.condition,
                            report.form_residual.pv,
                            report.form_residual.pvr ? fmt::format(", PVr {:.6g} nm", *report.form_residual.pvr) : "",
                            report.form_residual.rms);
}

std::string short_name(const PsdCurve& curve) { return curve.name == "radial" ? "rad" : curve.name; }

std::string limit_text(const CurveReport& c) {
  const PsdLimitCheck& check = *c.limit;
  if (check.checked == 0)
    return fmt::format("limit {:<4}not checked: no frequency is resolved there\n", short_name(c.curve));
  const std::string where = fmt::format("from {:.4g} to {:.4g} /mm", check.from, check.to);
  const std::string name = short_name(c.curve);
  if (check.met()) {
    return fmt::format("limit {:<4}met {}: at most {:.3g} of it, at {:.4g} /mm ({:.4g} mm)\n", name, where,
                       check.worst_factor, check.worst_frequency, 1.0 / check.worst_frequency);
  }
  return fmt::format(
      "limit {:<4}EXCEEDED {}: up to {:.3g} times, at {:.4g} /mm ({:.4g} mm); {} of {} frequencies above, the first at "
      "{:.4g} /mm, the last at {:.4g} /mm\n",
      name, where, check.worst_factor, check.worst_frequency, 1.0 / check.worst_frequency, check.above, check.checked,
      check.runs.front().first, check.runs.back().second);
}

std::string bands_text(const SpectrumReport& s, double plain_rms) {
  std::string text;
  for (const BandRms& band : s.split.bands) {
    if (band.rms) {
      text += fmt::format("band {:<5}{:>10.4g} nm RMS at wavelengths {}{}\n", band.name, *band.rms,
                          wavelengths_text(band), band.note.empty() ? "" : " (" + band.note + ")");
    } else {
      text += fmt::format("band {:<5} wavelengths {} {}\n", band.name, wavelengths_text(band), band.note);
    }
  }
  text += fmt::format("     long {:>10.4g} nm RMS longer than the part resolves, > {:.4g} mm\n", s.split.longer,
                      s.longest_wavelength);
  if (s.split.shorter > 0.0) {
    text += fmt::format("     short{:>10.4g} nm RMS in the bands shorter than two pixels, along diagonals\n",
                        s.split.shorter);
  }
  return text + fmt::format(
                    "     all  {:>10.4g} nm RMS as the window sees the map, and so the bands (plain RMS {:.4g} nm, "
                    "every pixel "
                    "alike)\n",
                    s.rms, plain_rms);
}

/// `plain_rms`: of the map, every pixel counting the same [nm].
std::string spectrum_text(const SpectrumReport& s, double plain_rms) {
  std::string text =
      fmt::format("spectrum  window {}{}; wavelengths from {:.4g} to {:.4g} mm are resolved\n", to_string(s.window),
                  s.holes ? ", along the edge of the part" : "", s.shortest_wavelength, s.longest_wavelength);
  if (s.bridged > 0) text += fmt::format("          {} lost pixels bridged\n", s.bridged);
  for (const CurveReport& c : s.curves) {
    if (c.fit) {
      text += fmt::format("PSD {:<6}{:.4g} {} {} ({:.4g} to {:.4g} /mm; scatter of a factor {:.3g})\n",
                          short_name(c.curve), c.fit->line.a, power_of_frequency(c.fit->line), c.curve.unit,
                          c.fit->from, c.fit->to, std::pow(10.0, c.fit->scatter));
    } else {
      text += fmt::format("PSD {:<6}too few frequencies are resolved to fit a line\n", short_name(c.curve));
    }
  }
  text += bands_text(s, plain_rms);
  for (const CurveReport& c : s.curves) {
    if (c.limit) text += limit_text(c);
  }
  return text;
}

std::string dropped_text(const PolynomialFit& fit) {
  std::string names;
  for (const PolynomialTerm& term : fit.terms) {
    if (term.dropped) names += (names.empty() ? "" : ", ") + term.name;
  }
  return names.empty() ? "" : fmt::format("          not removed, since they depend on the others here: {}\n", names);
}

std::string robust_text(const MapReport& report) {
  if (!report.robust) {
    return fmt::format("PVr       too few pixels: {} with data, 36 Zernike terms\n", report.statistics.valid_pixels);
  }
  const RobustPv& robust = *report.robust;
  return fmt::format(
      "PVr       {:.6g} nm (36 Zernike terms {:.6g} nm PV + 3 x {:.6g} nm RMS of the rest: an estimate, which "
      "may be above the PV)\n",
      robust.pvr, robust.fit_pv, robust.residual_rms);
}

std::string slope_number(double slope) { return std::isfinite(slope) ? fmt::format("{:.6g} urad", slope) : "none"; }

std::string slope_text(const SlopeStatistics& slope) {
  if (!std::isfinite(slope.x) && !std::isfinite(slope.y)) {
    return "slope     none: no two pixels with data lie side by side\n";
  }
  return fmt::format("slope     {} RMS in x, {} in y, {} together, from pixel to pixel\n", slope_number(slope.x),
                     slope_number(slope.y), slope_number(slope.total));
}

}  // namespace

std::string map_report_text(const MapReport& report) {
  const std::string removed = to_string(report.removed);
  std::string text = fmt::format("PV        {:.6g} nm ({} removed)\n", report.statistics.pv, removed);
  text += robust_text(report);
  text += fmt::format("RMS       {:.6g} nm{} ({} removed)\n", report.statistics.rms, mean_in_words(report.statistics),
                      removed);
  text += slope_text(report.slope);
  text += dropped_text(report.removed_fit);
  if (report.form) text += form_text(report);
  if (report.spectrum) text += spectrum_text(*report.spectrum, report.statistics.rms_about_zero());
  text += verdict_lines(report.acceptance);
  return text;
}

}  // namespace dwell
