#include "runs/reports/tool_sheet.h"

#include <fmt/format.h>

#include <cmath>

#include "core/tif/models/removal_models.h"
#include "runs/base/json_blocks.h"

namespace dwell {
namespace {

constexpr double kRounding = 1e-9;  // of a hundred percent

}  // namespace

std::string place_from_axis(Point p, double fwhm) {
  constexpr double kNothing = 1e-6;  // of the FWHM
  const auto shown = [fwhm](double v) { return std::abs(v) < kNothing * fwhm ? 0.0 : v; };
  return fmt::format("({:.4g}, {:.4g}) mm", shown(p.x), shown(p.y));
}

ToolSheet tool_sheet(const RemovalFunction& tif) {
  return {kind_of(tif), tif.radius, with_exact_figures(analyse_shape(removal_samples(tif)), tif), tif.file, tif.notes};
}

std::string tool_file_line(const std::string& head, const ToolSheet& sheet) {
  const TifFile& file = *sheet.file;
  const double share = 100.0 / file.peak;
  const std::string noise = fmt::format("noise {:.2g} %", share * file.noise);
  std::string rim =
      fmt::format("{:.2g} % of the peak, at most {:.2g} %, {}", share * file.rim, share * file.rim_largest, noise);
  if (file.mended) {
    const double used = 100.0 / file.mended->peak;
    // What is left of a mean that was taken off is rounding.
    const double mean = std::abs(used * file.mended->rim) < kRounding ? 0.0 : used * file.mended->rim;
    rim = fmt::format("{:.2g} % of the peak, at most {:.2g} %; in the file, before its pedestal was mended, {}", mean,
                      used * file.mended->rim_largest, rim);
  }
  return fmt::format("{:<9} axis at ({:.4g}, {:.4g}) mm of its file, {}; rate at the rim {}\n", head, file.axis.x,
                     file.axis.y, file.axis_from, rim);
}

std::string tool_lines(const ToolSheet& sheet) {
  const RemovalAnalysis& a = sheet.shape;
  constexpr double kOther = 0.01;  // relative: of a ring, or of a long tool
  const bool other = std::abs(a.fwhm_x - a.fwhm) > kOther * a.fwhm || std::abs(a.fwhm_y - a.fwhm) > kOther * a.fwhm;
  const char* const of_area = other ? " of equal area" : "";
  std::string text = fmt::format(
      "tool      {}, peak {:.4g} nm/s, volume {:.4g} nm mm^2/s, FWHM {:.4g} mm{} ({:.4g} along x, {:.4g} along "
      "y), radius {:.4g} mm\n"
      "          from its axis: centroid at {}, largest sample at {}; asymmetry {:.2g}\n",
      sheet.kind, a.peak, a.volume, a.fwhm, of_area, a.fwhm_x, a.fwhm_y, sheet.radius,
      place_from_axis(a.centroid, a.fwhm), place_from_axis(a.peak_at, a.fwhm), a.asymmetry);
  if (sheet.file) text += tool_file_line("", sheet);
  for (const std::string& note : sheet.notes) text += fmt::format("          {}\n", note);
  return text;
}

nlohmann::ordered_json tool_block(const ToolSheet& sheet) {
  const RemovalAnalysis& a = sheet.shape;
  nlohmann::ordered_json block = {{"kind", sheet.kind},
                                  {"peak_nm_per_s", a.peak},
                                  {"volume_nm_mm2_per_s", a.volume},
                                  {"fwhm_x_mm", a.fwhm_x},
                                  {"fwhm_y_mm", a.fwhm_y},
                                  {"centroid_mm", {a.centroid.x, a.centroid.y}},
                                  {"peak_at_mm", {a.peak_at.x, a.peak_at.y}},
                                  {"asymmetry", a.asymmetry}};
  if (sheet.file) {
    block["axis_in_file_mm"] = {sheet.file->axis.x, sheet.file->axis.y};
    block["axis_from"] = sheet.file->axis_from;
    block["rim_share_of_peak"] = sheet.file->rim / sheet.file->peak;
    block["rim_largest_share_of_peak"] = sheet.file->rim_largest / sheet.file->peak;
    if (const auto& mended = sheet.file->mended) {
      block["rim_share_of_peak_used"] = mended->rim / mended->peak;
      block["rim_largest_share_of_peak_used"] = mended->rim_largest / mended->peak;
    }
    block["noise_nm_per_s"] = sheet.file->noise;
  }
  block["notes"] = sheet.notes;
  return block;
}

}  // namespace dwell
