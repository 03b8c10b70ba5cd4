#include <nlohmann/json.hpp>

#include <utility>

#include "runs/base/inputs_json.h"
#include "runs/reports/acceptance_report.h"
#include "runs/reports/map_report.h"
#include "runs/reports/surface_sheet.h"

namespace dwell {
namespace {

using Json = nlohmann::ordered_json;

/// The block of a form: polynomials and their coefficients.
Json form_block(const PolynomialSpec& spec, const PolynomialFit& fit) {
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
                     {"worst_factor", finite_or_null(c.limit->worst_factor)},
                     {"worst_frequency_per_mm", finite_or_null(c.limit->worst_frequency)},
                     {"above_per_mm", runs}};
  }
  return json;
}

Json spectrum_json(const SpectrumReport& s) {
  Json json = {{"window", to_string(s.window)},
               {"along_edge", s.holes},
               {"bridged_pixels", s.bridged},
               {"rms_nm", s.rms},
               {"resolved_wavelengths_mm", {s.shortest_wavelength, s.longest_wavelength}},
               {"bands", bands_json(s.split.bands)},
               {"longer_than_resolved_rms_nm", s.split.longer},
               {"shorter_than_resolved_rms_nm", s.split.shorter}};
  if (s.limit) json["limit"] = {{"radial", s.limit->radial}, {"a", s.limit->line.a}, {"b", s.limit->line.b}};
  for (const CurveReport& c : s.curves) json[c.curve.name] = curve_json(c);
  return json;
}

}  // namespace

std::string map_report_json(const MapReport& report, const MapFigures& map, const std::vector<InputFile>& inputs,
                            const MapProfile* profile) {
  Json json = json_of_command("map");
  json["map"] = map_block(map);
  json["figure"] = {{"pvr_nm", report.robust ? Json(report.robust->pvr) : Json(nullptr)},
                    {"slope_rms_urad", slope_json(report.slope)}};
  json["removed_form"] = form_block(report.removed, report.removed_fit);
  if (report.form) {
    json["form"] = form_block(*report.form, report.form_fit);
    json["form"]["residual"] = residual_block(to_string(*report.form), report.form_residual);
  }
  if (report.spectrum) json["spectrum"] = spectrum_json(*report.spectrum);
  if (profile) json["profile"] = {{"line", profile->name}, {"pv_nm", profile->pv()}, {"rms_nm", profile->rms()}};
  if (!report.acceptance.empty()) json["acceptance"] = acceptance_block(report.acceptance);
  json["limits"] = report.broken_limits();
  json["inputs"] = inputs_json(inputs);
  return json_text(std::move(json));
}

}  // namespace dwell
