#include <nlohmann/json.hpp>

#include <cmath>

#include "core/base/version.h"
#include "runs/base/inputs_json.h"
#include "runs/reports/map_report.h"

namespace dwell {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has neither infinity nor NaN: null.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json fit_json(const PolynomialSpec& spec, const PolynomialFit& fit) {
  Json terms = Json::array();
  for (const PolynomialTerm& term : fit.terms) {
    terms.push_back({{"name", term.name},
                     {"coefficient_nm", term.coefficient},
                     {"contribution_nm", term.contribution},
                     {"dropped", term.dropped}});
  }
  Json json = {{"polynomials", to_string(spec)}, {"normalisation", fit.normalisation}};
  if (spec.kind == PolynomialSpec::Kind::Terms || spec.kind == PolynomialSpec::Kind::Zernike) {
    json["centre_mm"] = {fit.domain.centre.x, fit.domain.centre.y};
    json["radius_mm"] = fit.domain.radius;
  } else {
    json["rectangle_mm"] = {fit.domain.x0, fit.domain.y0, fit.domain.x1, fit.domain.y1};
  }
  json["condition"] = fit.condition;
  json["terms"] = terms;
  return json;
}

Json curve_json(const CurveReport& c) {
  const std::string density = c.curve.name == "radial" ? "density_nm2_mm2" : "density_nm2_mm";
  Json json = {{"frequency_per_mm", c.curve.frequency},
               {density, c.curve.density},
               {"resolved_per_mm", {c.curve.resolved_from, c.curve.resolved_to}}};
  if (c.fit) {
    json["fit"] = {{"a", c.fit->line.a},
                   {"b", c.fit->line.b},
                   {"range_per_mm", {c.fit->from, c.fit->to}},
                   {"scatter_log10", c.fit->scatter}};
  }
  if (c.limit) {
    Json runs = Json::array();
    for (const auto& [first, last] : c.limit->runs) runs.push_back({first, last});
    json["limit"] = {{"met", c.limit->met()},
                     {"range_per_mm", {c.limit->from, c.limit->to}},
                     {"checked", c.limit->checked},
                     {"above", c.limit->above},
                     {"worst_factor", number(c.limit->worst_factor)},
                     {"worst_frequency_per_mm", number(c.limit->worst_frequency)},
                     {"above_per_mm", runs}};
  }
  return json;
}

Json spectrum_json(const SpectrumReport& s) {
  Json bands = Json::array();
  for (const BandRms& band : s.split.bands) {
    bands.push_back({{"name", band.name},
                     {"longest_mm", number(band.longest)},
                     {"shortest_mm", band.shortest},
                     {"rms_nm", band.rms ? Json(*band.rms) : Json(nullptr)},
                     {"note", band.note}});
  }
  Json json = {{"window", to_string(s.window)},
               {"along_edge", s.holes},
               {"bridged_pixels", s.bridged},
               {"rms_nm", s.rms},
               {"resolved_wavelengths_mm", {s.shortest_wavelength, s.longest_wavelength}},
               {"bands", bands},
               {"longer_than_resolved_rms_nm", s.split.longer},
               {"shorter_than_resolved_rms_nm", s.split.shorter}};
  if (s.limit) json["limit"] = {{"radial", s.limit->radial}, {"a", s.limit->line.a}, {"b", s.limit->line.b}};
  for (const CurveReport& c : s.curves) json[c.curve.name] = curve_json(c);
  return json;
}

}  // namespace

std::string map_report_json(const MapReport& report, const HeightMap& map, const std::vector<InputFile>& inputs) {
  const Grid& g = map.grid;
  Json json = {{"schema", 1}, {"version", version()}, {"inputs", inputs_json(inputs)}};
  json["map"] = {{"rows", g.rows},
                 {"columns", g.cols},
                 {"pixel_mm", {g.pitch_x, g.pitch_y}},
                 {"origin_mm", {g.origin.x, g.origin.y}},
                 {"valid_pixels", report.statistics.valid_pixels},
                 {"history", map.history}};
  json["removed"] = fit_json(report.removed, report.removed_fit);
  json["pv_nm"] = report.statistics.pv;
  json["pvr_nm"] = report.robust ? Json(report.robust->pvr) : Json(nullptr);
  json["rms_nm"] = report.statistics.rms;
  json["slope_rms_urad"] = {
      {"x", number(report.slope.x)}, {"y", number(report.slope.y)}, {"total", number(report.slope.total)}};
  if (report.form) {
    json["form"] = fit_json(*report.form, report.form_fit);
    json["form"]["residual_pv_nm"] = report.form_residual.pv;
    json["form"]["residual_rms_nm"] = report.form_residual.rms;
  }
  if (report.spectrum) json["spectrum"] = spectrum_json(*report.spectrum);
  return json.dump(2) + "\n";
}

}  // namespace dwell
