#include "runs/reports/surface_sheet.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/form/map_statistics.h"
#include "core/spectra/psd.h"
#include "runs/acceptance/surface_limits.h"
#include "runs/base/json_blocks.h"

namespace dwell {
namespace {

using Json = nlohmann::ordered_json;

SurfaceFigures figures_of(HeightMap map, const std::vector<double>& edges, int threads) {
  PsdOptions options;
  options.threads = threads;
  const SlopeStatistics slope = slope_statistics(map, threads);
  // A mean, where it counts, would leak through the window into the bands.
  const double mean = map_statistics(map, {}, threads).mean;
  for (double& value : map.values) value -= mean;
  BandSplit split = band_rms(areal_psd(map, options), edges);
  return {slope, std::move(split.bands), split.longer};
}

std::string slope_of(double urad) { return std::isfinite(urad) ? fmt::format("{:.4g} urad", urad) : "none"; }

Json figures_json(const SurfaceFigures& figures) {
  return {{"slope_rms_urad", slope_json(figures.slope)},
          {"bands", bands_json(figures.bands)},
          {"longer_than_resolved_rms_nm", figures.longer}};
}

}  // namespace

SurfaceSheet surface_sheet(const HeightMap& before, const HeightMap& after, double fwhm, int threads,
                           const Progress& progress) {
  const std::vector<double> edges = tool_band_edges(fwhm);
  progress.step("slopes and bands before");
  SurfaceSheet sheet;
  sheet.before = figures_of(before, edges, threads);
  progress.step("slopes and bands after");
  sheet.after = figures_of(after, edges, threads);
  return sheet;
}

std::string surface_lines(const SurfaceSheet& sheet) {
  std::string text = fmt::format("slope     {} RMS before, {} after, from pixel to pixel\n",
                                 slope_of(sheet.before.slope.total), slope_of(sheet.after.slope.total));
  for (std::size_t k = 0; k < sheet.before.bands.size(); ++k) {
    const BandRms &before = sheet.before.bands[k], &after = sheet.after.bands[k];
    text += before.rms && after.rms
                ? fmt::format("band      {:.4g} nm RMS before, {:.4g} nm after, wavelengths {}{}\n", *before.rms,
                              *after.rms, wavelengths_text(before), before.note.empty() ? "" : " (" + before.note + ")")
                : fmt::format("band      wavelengths {} {}\n", wavelengths_text(before), before.note);
  }
  text += fmt::format("          {:.4g} nm RMS before, {:.4g} nm after in waves longer than the part\n",
                      sheet.before.longer, sheet.after.longer);
  text += "          (bands under a Hann window, which weighs the middle of the part more than its edge)\n";
  return text;
}

Json surface_block(const SurfaceSheet& sheet) {
  return {{"before", figures_json(sheet.before)}, {"after", figures_json(sheet.after)}};
}

Json slope_json(const SlopeStatistics& slope) {
  return {{"x", finite_or_null(slope.x)}, {"y", finite_or_null(slope.y)}, {"total", finite_or_null(slope.total)}};
}

Json bands_json(const std::vector<BandRms>& bands) {
  Json json = Json::array();
  for (const BandRms& band : bands) {
    json.push_back({{"name", band.name},
                    {"longest_mm", finite_or_null(band.longest)},
                    {"shortest_mm", band.shortest},
                    {"rms_nm", band.rms ? Json(*band.rms) : Json(nullptr)},
                    {"note", band.note}});
  }
  return json;
}

}  // namespace dwell
