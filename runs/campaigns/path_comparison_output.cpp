#include "runs/campaigns/path_comparison_output.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

#include "core/base/duration_text.h"
#include "core/base/utf8_text.h"
#include "runs/drawing/line_chart.h"
#include "runs/reports/figure_output.h"
#include "runs/reports/plan_files.h"

namespace dwell {
namespace {

using Json = nlohmann::ordered_json;

Json waves_json(const RippleSpectrum& spectrum) {
  Json peaks = Json::array();
  for (const RipplePeak& peak : spectrum.peaks) {
    peaks.push_back({{"wavelength_mm", peak.wavelength},
                     {"direction_deg", peak.direction_deg},
                     {"rms_nm", peak.rms},
                     {"share", peak.share}});
  }
  return {{"longest_mm", spectrum.resolved.longest},
          {"shortest_mm", spectrum.resolved.shortest},
          {"anisotropy", spectrum.anisotropy},
          {"peaks", peaks}};
}

/// Relative to the mean removal, because the depth of the patch is arbitrary.
Json ripple_json(const PathRipple& ripple) {
  const double depth = PathRippleOptions().depth;
  Json peaks = Json::array();
  for (const RipplePeak& peak : ripple.spectrum.peaks) {
    peaks.push_back({{"wavelength_mm", peak.wavelength},
                     {"direction_deg", peak.direction_deg},
                     {"rms_over_removal", peak.rms / depth},
                     {"share", peak.share}});
  }
  return {{"pvn", ripple.pvn},
          {"rms_over_removal", ripple.rms / depth},
          {"mid_rms_over_removal", ripple.spectrum.rms / depth},
          {"track_spacing_mm", ripple.spacing},
          {"anisotropy", ripple.spectrum.anisotropy},
          {"peaks", peaks}};
}

Json spacing_json(const PathSpacing& s) {
  return {{"least", s.min}, {"mean", s.mean}, {"deviation", s.deviation}, {"largest", s.max}, {"points", s.points}};
}

/// The figures of a path that its block "path" does not hold: how it covers the part.
Json metrics_json(const ComparedPath& p) {
  const PathMetrics& m = p.metrics;
  return {{"lifted_length_mm", m.lifted_length},
          {"point_length_mm", m.point_length},
          {"tree_length_mm", p.tree_length},
          {"reversals", m.reversals},
          {"sharpest_corner_deg", m.sharpest_corner},
          {"directions", m.directions},
          {"anisotropy", m.anisotropy},
          {"lattice_anisotropy", m.lattice_anisotropy},
          {"spacing_mm", spacing_json(p.spacing)},
          {"coverage", p.coverage}};
}

Json json_of(const ComparedPath& p) {
  Json json = {{"spec", p.listed.text}, {"folder", p.listed.name}};
  if (!p.failure.empty()) {
    json["failure"] = p.failure;
    return json;
  }
  json.update({{"front", p.on_front},
               {"path", path_block(p.kind, p.metrics, p.notes)},
               {"metrics", metrics_json(p)},
               {"solve", solve_block(p.solver)},
               {"dwell", dwell_block({p.dwell_total, p.dwell_min, p.dwell_max, p.step_rms})},
               {"program", program_block(p.program)},
               {"total_s", p.total_time},
               {"lift_s", p.lift_time},
               {"mid_rms_nm", finite_or_null(p.mid_rms())},
               {"residual_waves", p.residual_ripple ? waves_json(*p.residual_ripple) : Json(nullptr)},
               {"ripple", p.ripple ? ripple_json(*p.ripple) : Json{{"missing", p.no_ripple}}},
               {"limits", p.limits}});
  return json;
}

Colour colour_of(std::size_t k) {
  static constexpr Colour kColours[] = {{33, 102, 172}, {214, 96, 20},  {27, 120, 55}, {118, 42, 131},
                                        {200, 30, 90},  {140, 100, 20}, {0, 150, 160}, {90, 90, 90},
                                        {170, 170, 0},  {110, 60, 40},  {60, 60, 200}, {240, 130, 180}};
  return kColours[k % std::size(kColours)];
}

std::string comparison_picture(const PathComparison& comparison, FigureFormat format) {
  ChartPanel residual{"total time [s]", "residual RMS [nm]", {}}, mid{"total time [s]", "mid-band RMS [nm]", {}};
  for (std::size_t k = 0; k < comparison.paths.size(); ++k) {
    const ComparedPath& p = comparison.paths[k];
    if (!p.failure.empty()) continue;
    residual.lines.push_back({p.listed.name, colour_of(k), {{p.total_time, p.residual_rms, p.on_front}}});
    if (p.mid_rms()) mid.lines.push_back({p.listed.name, colour_of(k), {{p.total_time, *p.mid_rms(), p.on_front}}});
  }
  std::vector<ChartPanel> panels{residual};
  if (!mid.lines.empty()) panels.push_back(mid);
  return draw_line_charts("Paths: what they leave against what they take", "on the Pareto front", panels, format);
}

ChartLine spectrum_line(const std::string& label, Colour colour, const PsdCurve& curve) {
  ChartLine line{label, colour, {}, false, false};
  for (std::size_t k = 0; k < curve.frequency.size(); ++k) {
    if (curve.density[k] > 0.0) line.points.push_back({curve.frequency[k], curve.density[k], false});
  }
  return line;
}

std::string spectra_picture(const PathComparison& comparison, FigureFormat format) {
  ChartPanel panel{"frequency [1/mm]", "radial PSD [nm² mm²]", {}};
  panel.lines.push_back(spectrum_line("before", {24, 24, 24}, comparison.before));
  panel.lines.back().dashed = true;
  for (std::size_t k = 0; k < comparison.paths.size(); ++k) {
    const ComparedPath& p = comparison.paths[k];
    if (p.failure.empty()) panel.lines.push_back(spectrum_line(p.listed.name, colour_of(k), p.spectrum));
  }
  return draw_line_charts("Spectra before, and of what the simulated programs leave", "", {panel}, format);
}

/// A field of a CSV file.
std::string quote_field(const std::string& field) {
  std::string text = with_escaped_bytes(field);
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  for (std::size_t at = text.find('"'); at != std::string::npos; at = text.find('"', at + 2)) text.insert(at, 1, '"');
  return '"' + text + '"';
}

/// The band as the map resolves it.
std::string band_text(const PathComparison& comparison) {
  for (const ComparedPath& p : comparison.paths) {
    if (!p.residual_ripple) continue;
    const RippleBand& band = p.residual_ripple->resolved;
    return fmt::format("{:.4g} to {:.4g} mm, of 33 to 0.12 mm what the map resolves", band.longest, band.shortest);
  }
  return "33 to 0.12 mm, not resolved by the map";
}

struct Cell {
  const char* column;
  std::string text;
};

std::string number(double value) { return fmt::format("{}", value); }

/// The columns of paths.csv between the name and the failure, of a path that did not fail.
std::vector<Cell> cells_of(const ComparedPath& p) {
  const PathMetrics& m = p.metrics;
  const RippleSpectrum* waves = p.residual_ripple ? &*p.residual_ripple : nullptr;
  const PathRipple* ripple = p.ripple ? &*p.ripple : nullptr;
  return {{"front", p.on_front ? "yes" : "no"},
          {"residual_rms_nm", number(p.residual_rms)},
          {"residual_pv_nm", number(p.residual_pv)},
          {"residual_pvr_nm", p.residual_pvr ? number(*p.residual_pvr) : ""},
          {"mid_rms_nm", waves ? number(waves->rms) : ""},
          {"residual_anisotropy", waves ? number(waves->anisotropy) : ""},
          {"total_s", number(p.total_time)},
          {"dwell_s", number(p.dwell_total)},
          {"lift_s", number(p.lift_time)},
          {"step_rms_s", number(p.step_rms)},
          {"points", fmt::format("{}", m.points)},
          {"length_mm", number(m.length)},
          {"lifts", fmt::format("{}", m.lifts)},
          {"lifted_length_mm", number(m.lifted_length)},
          {"longest_jump_mm", number(m.longest_jump)},
          {"point_length_mm", number(m.point_length)},
          {"tree_length_mm", number(p.tree_length)},
          {"length_over_tree", p.tree_length > 0.0 ? number(m.point_length / p.tree_length) : ""},
          {"reversals", fmt::format("{}", m.reversals)},
          {"sharpest_corner_deg", number(m.sharpest_corner)},
          {"anisotropy", number(m.anisotropy)},
          {"lattice_anisotropy", number(m.lattice_anisotropy)},
          {"spacing_mean_mm", number(p.spacing.mean)},
          {"spacing_deviation_mm", number(p.spacing.deviation)},
          {"coverage", number(p.coverage)},
          {"ripple_pvn", ripple ? number(ripple->pvn) : ""},
          {"ripple_anisotropy", ripple ? number(ripple->spectrum.anisotropy) : ""},
          {"solver_status", to_string(p.solver.status)}};
}

}  // namespace

const ResultFiles& path_comparison_files() {
  static const ResultFiles kFiles{"path comparison", "paths.json", {"paths.csv"}, {"paths", "psd"}, &plan_files()};
  return kFiles;
}

std::string path_table_text(const PathComparison& comparison) {
  std::string text = "folder,path,";
  for (const Cell& cell : cells_of({})) text += fmt::format("{},", cell.column);
  text += "failure\n";
  for (const ComparedPath& p : comparison.paths) {
    text += fmt::format("{},{},", p.listed.name, quote_field(p.listed.text));
    for (const Cell& cell : cells_of(p)) text += (p.failure.empty() ? cell.text : "") + ",";
    text += quote_field(p.failure) + "\n";
  }
  return text;
}

std::string path_comparison_json(const PathComparison& comparison) {
  Json paths = Json::array();
  for (const ComparedPath& p : comparison.paths) paths.push_back(json_of(p));
  const SweepSheet& sheet = comparison.sheet;
  Json summary = json_of_command("paths");
  summary.update({{"map", sheet.map},
                  {"aim", sheet.aim},
                  {"tif", sheet.tif},
                  {"tool", sheet.tool},
                  {"pitch_mm", comparison.pitch},
                  {"pitch_given", comparison.pitch_given},
                  {"paths", paths},
                  {"limits", comparison.limits},
                  {"options", sheet.options},
                  {"inputs", sheet.inputs}});
  return json_text(std::move(summary));
}

std::string path_comparison_text(const PathComparison& comparison) {
  std::size_t widest = 4;
  for (const ComparedPath& p : comparison.paths) widest = std::max(widest, p.listed.name.size());
  const SweepSheet& sheet = comparison.sheet;
  std::string text =
      sheet.tool_lines + sheet.map_lines +
      fmt::format("before    {}; pitch {:.6g} mm where a path says none ({})\n", sheet.before, comparison.pitch,
                  comparison.pitch_given ? "given" : "a quarter of the removal function's FWHM");
  text += fmt::format("  {:<{}} {:>12} {:>11} {:>9} {:>13} {:>8} {:>11} {:>8} {:>10} {:>6} {:>9} {:>10}\n", "path",
                      widest, "residual[nm]", "mid RMS[nm]", "total[s]", "h:min:s", "lift[s]", "step RMS[s]", "points",
                      "length[mm]", "lifts", "ripple[%]", "anisotropy");
  std::string below;
  for (const ComparedPath& p : comparison.paths) {
    if (!p.failure.empty()) {
      below += fmt::format("{}: no plan: {}\n", p.listed.name, p.failure);
      continue;
    }
    text += fmt::format(
        "{} {:<{}} {:>12.4g} {:>11} {:>9.2f} {:>13} {:>8.2f} {:>11.4g} {:>8} {:>10.6g} {:>6} {:>9} {:>10.2f}\n",
        p.on_front  ? '*'
        : p.whole() ? ' '
                    : '!',
        p.listed.name, widest, p.residual_rms, p.mid_rms() ? fmt::format("{:.4g}", *p.mid_rms()) : "-", p.total_time,
        clock_text(p.total_time), p.lift_time, p.step_rms, p.metrics.points, p.metrics.length, p.metrics.lifts,
        p.ripple ? fmt::format("{:.3g}", 100.0 * p.ripple->pvn) : "-", p.metrics.anisotropy);
    if (!p.no_ripple.empty()) below += fmt::format("{}: no ripple: {}\n", p.listed.name, p.no_ripple);
    for (const std::string& note : p.notes) below += fmt::format("{}: {}\n", p.listed.name, note);
  }
  text += fmt::format(
      "* on the Pareto front of residual{}, mid-band RMS ({}) and total time; ! the solve did not converge.\n"
      "  Mid RMS: of those wavelengths alone, under a window, which weighs the middle of the part more than its edge: "
      "it "
      "may be above the residual's RMS over all pixels.\n"
      "  Ripple: peak to valley over the mean removal, at constant feed. Anisotropy of the path's directions: 1 = all "
      "parallel.\n",
      sheet.has_mean ? " (RMS about the mean)" : "", band_text(comparison));
  return text + below;
}

std::string write_path_comparison(const PathComparison& comparison, const OutputFolder& folder) {
  folder.write("paths.csv", path_table_text(comparison));
  const std::vector<FigureFormat>& figures = comparison.sheet.figures;
  write_figure(folder, figures, "paths", [&](FigureFormat format) { return comparison_picture(comparison, format); });
  write_figure(folder, figures, "psd", [&](FigureFormat format) { return spectra_picture(comparison, format); });
  std::string json = path_comparison_json(comparison);
  folder.write("paths.json", json);
  return json;
}

}  // namespace dwell
