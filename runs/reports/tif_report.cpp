#include "runs/reports/tif_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <utility>

#include "core/base/counted.h"
#include "runs/base/inputs_json.h"
#include "runs/base/json_blocks.h"
#include "runs/reports/tool_sheet.h"

namespace dwell {
namespace {

using Json = nlohmann::ordered_json;

std::string wave(const std::optional<double>& w) { return w ? fmt::format("{:.4g} mm", *w) : "none"; }

std::string spots_text(const SpotCalibration& c) {
  std::string text = fmt::format(
      "spots     {}, radius {:.4g} mm, noise cut {} {:.2g} % of the volume{}\n", c.spots.size(), c.radius,
      c.volume_cut < 0.0 ? "took negative rates and so added" : "took", 100.0 * std::abs(c.volume_cut),
      c.filled_pixels > 0 ? fmt::format(", {} without data filled", counted(c.filled_pixels, "pixel")) : "");
  double sum = 0.0, square = 0.0;
  for (const CalibratedSpot& s : c.spots) {
    text += fmt::format(
        "          at ({:.4f}, {:.4f}) mm: peak {:.4g} nm/s, volume {:.4g} nm mm^2/s, scatter around it {:.2g} "
        "nm/s\n",
        s.position.x, s.position.y, s.peak, s.volume, s.scatter);
    sum += s.volume, square += s.volume * s.volume;
  }
  const double n = static_cast<double>(c.spots.size());
  if (n > 1.0) {
    const double deviation = std::sqrt(std::max(0.0, (square - sum * sum / n) / (n - 1.0)));
    text += fmt::format("          volume from spot to spot: {:.2g} % (standard deviation)\n",
                        100.0 * deviation / (sum / n));
  }
  return text;
}

std::string trench_text(const TrenchCalibration& t) {
  const std::string fitted =
      t.fitted ? fmt::format("fitted {:.4g} +- {:.2g} deg", t.fitted->degrees, t.fitted->standard_error)
               : std::string("not checked: the map does not show it");
  return fmt::format(
      "trench    {:.4g} nm deep, mean from {:.4g} to {:.4g} mm along it, radius {:.4g} mm, scatter {:.2g} nm\n"
      "          along {:.6g} deg ({})\n"
      "          asymmetry across {:.2g} (0 = symmetric); taken as rotationally symmetric\n",
      t.depth, t.from, t.to, t.radius, t.scatter, t.direction, fitted, t.asymmetry);
}

std::string fit_text(const RemovalFit& f, double least_bic) {
  std::string text =
      fmt::format("fit       {}: RMS {:.4g} nm/s, R^2 {:.6f}, AIC {:.1f}, BIC {:.1f} ({:+.1f}){}\n", f.model, f.rms,
                  f.r_squared, f.aic, f.bic, f.bic - least_bic, f.converged ? "" : ", NOT converged");
  for (const FittedParameter& p : f.parameters) {
    const std::string error = p.held                   ? "held"
                              : std::isfinite(p.error) ? fmt::format("+- {:.2g}", p.error)
                                                       : "not determined";
    text +=
        fmt::format("            {:<12} {:.6g} {}{}({})\n", p.name, p.value, p.unit, p.unit.empty() ? "" : " ", error);
  }
  return text + fmt::format("            --tif {}\n", f.spec);
}

Json spots_json(const SpotCalibration& c) {
  auto spots = Json::array();
  for (const CalibratedSpot& s : c.spots) {
    spots.push_back({{"x_mm", s.position.x},
                     {"y_mm", s.position.y},
                     {"peak_nm_per_s", s.peak},
                     {"volume_nm_mm2_per_s", s.volume},
                     {"scatter_nm_per_s", s.scatter}});
  }
  double square = 0.0;
  for (const double v : c.deviation.values) square += v * v;
  return {{"radius_mm", c.radius},
          {"volume_cut_share", c.volume_cut},
          {"filled_pixels", c.filled_pixels},
          {"deviation_rms_nm_per_s", std::sqrt(square / static_cast<double>(c.deviation.values.size()))},
          {"each", spots}};
}

Json trench_json(const TrenchCalibration& t) {
  auto section = Json::array();
  for (const LineIntegral& s : t.section) section.push_back({s.offset, s.value});
  return {{"depth_nm", t.depth},
          {"radius_mm", t.radius},
          {"middle_mm", t.middle},
          {"from_mm", t.from},
          {"to_mm", t.to},
          {"scatter_nm", t.scatter},
          {"asymmetry", t.asymmetry},
          {"section_nm_mm_per_s", section},
          {"direction_deg", t.direction},
          {"fitted_direction_deg", t.fitted ? Json(t.fitted->degrees) : Json(nullptr)},
          {"fitted_direction_standard_error_deg", t.fitted ? finite_or_null(t.fitted->standard_error) : Json(nullptr)}};
}

Json waves_json(const RemovalAnalysis::Waves& w) {
  return {{"x", finite_or_null(w.x)}, {"y", finite_or_null(w.y)}, {"radial", finite_or_null(w.radial)}};
}

Json fit_json(const RemovalFit& f) {
  auto parameters = Json::array();
  for (const FittedParameter& p : f.parameters) {
    parameters.push_back({{"name", p.name},
                          {"unit", p.unit},
                          {"value", p.value},
                          {"standard_error", finite_or_null(p.error)},
                          {"held", p.held}});
  }
  return {{"model", f.model},
          {"parameters", parameters},
          {"rms_nm_per_s", f.rms},
          {"r_squared", f.r_squared},
          {"aic", f.aic},
          {"bic", f.bic},
          {"converged", f.converged},
          {"iterations", f.iterations},
          {"message", f.message},
          {"tif", f.spec}};
}

/// The sheet of the result, from the analysis that it already has.
ToolSheet sheet_of(const TifResult& r) { return {r.source, r.tif.radius, r.analysis, r.tif.file, r.tif.notes}; }

}  // namespace

std::string tif_text(const TifResult& r) {
  const RemovalAnalysis& a = r.analysis;
  const Grid& g = r.rates.grid;
  std::string text = fmt::format("tif       {}: {} (y) x {} columns (x), pitch {:.6g} x {:.6g} mm\n", r.source,
                                 counted(g.rows, "row"), g.cols, g.pitch_x, g.pitch_y);
  for (const InputFile& input : r.inputs)
    text += fmt::format("{:<9} {} (sha256 {})\n", input.role, input.file, input.sha256);
  if (r.spots) text += spots_text(*r.spots);
  if (r.trench) text += trench_text(*r.trench);
  text += fmt::format("peak      {:.6g} nm/s; the largest sample at {} from the tool axis\n", a.peak,
                      place_from_axis(a.peak_at, a.fwhm));
  text += fmt::format("volume    {:.6g} nm mm^2/s, 99 % of it within {:.4g} mm\n", a.volume, a.radius);
  text += fmt::format("FWHM      {:.4g} mm along x, {:.4g} mm along y, {:.4g} mm of equal area\n", a.fwhm_x, a.fwhm_y,
                      a.fwhm);
  const ToolSheet sheet = sheet_of(r);
  if (sheet.file) text += tool_file_line("file", sheet);
  text += fmt::format("centroid  {} from the tool axis\n", place_from_axis(a.centroid, a.fwhm));
  text += fmt::format(
      "symmetry  asymmetry {:.3g} (RMS off the mean over all directions / RMS); main axes {:.4g} x {:.4g} mm "
      "(sigma), the longer at {:.1f} deg\n",
      a.asymmetry, a.sigma_major, a.sigma_minor, a.angle);
  text += fmt::format("corrects  wavelengths down to {} at 10 % response (x {}, y {}); 50 % at {}\n",
                      wave(a.at_tenth.radial), wave(a.at_tenth.x), wave(a.at_tenth.y), wave(a.at_half.radial));
  for (const std::string& note : sheet.notes) text += fmt::format("note      {}\n", note);
  for (const RemovalFit& f : r.fits) text += fit_text(f, r.fits.front().bic);
  return text;
}

std::string tif_json(const TifResult& r) {
  const RemovalAnalysis& a = r.analysis;
  Json json = json_of_command("tif");
  json["tif"] = tif_block(r.tif, r.source, r.rates.history);
  json["tool"] = tool_block(sheet_of(r));
  json["grid"] = grid_block(r.rates.grid);
  json["analysis"] = {{"peak_at_mm", {a.peak_at.x, a.peak_at.y}},
                      {"fwhm_x_mm", a.fwhm_x},
                      {"fwhm_y_mm", a.fwhm_y},
                      {"radius_99_mm", a.radius},
                      {"centroid_mm", {a.centroid.x, a.centroid.y}},
                      {"sigma_mm", {a.sigma_major, a.sigma_minor}},
                      {"angle_deg", a.angle},
                      {"asymmetry", a.asymmetry},
                      {"wavelength_mm_at_50_percent", waves_json(a.at_half)},
                      {"wavelength_mm_at_10_percent", waves_json(a.at_tenth)}};
  if (r.spots) json["spots"] = spots_json(*r.spots);
  if (r.trench) json["trench"] = trench_json(*r.trench);
  auto fits = Json::array();
  for (const RemovalFit& f : r.fits) fits.push_back(fit_json(f));
  json["fits"] = fits;
  json["limits"] = unfinished_fits(r);
  json["inputs"] = inputs_json(r.inputs);
  return json_text(std::move(json));
}

}  // namespace dwell
