#include "runs/reports/tif_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "runs/drawing/colour_map.h"
#include "runs/drawing/line_chart.h"
#include "runs/drawing/map_figure.h"
#include "runs/drawing/picture.h"
#include "runs/drawing/plot_field.h"

namespace dwell {
namespace {

MapPanel panel_of(const HeightMap& map, ColourMap colours, std::optional<double> lower, std::optional<double> upper,
                  const std::string& title) {
  return {field_of_map(map, field_edges(3)), colours, colour_limits(map.values, colours, lower, upper), title, "nm/s"};
}

/// The response from long waves down to where it is last 1 %, at 120 wavelengths in equal ratios.
ChartLine curve(const TransferFunction& t, const std::vector<double>& response, const char* label, Colour colour) {
  constexpr int kPoints = 120;
  constexpr double kLeast = 0.01;
  ChartLine line{label, colour, {}, false, false};
  std::size_t last = 1;
  for (std::size_t k = 1; k < response.size(); ++k) {
    if (response[k] >= kLeast) last = k;
  }
  const double shortest = 1.0 / t.frequency[last], longest = 1.0 / t.frequency[1];
  for (int k = 0; k <= kPoints; ++k) {
    const double wave = longest * std::pow(shortest / longest, static_cast<double>(k) / kPoints);
    const double place = 1.0 / (wave * t.frequency[1]);
    const std::size_t i = std::min(static_cast<std::size_t>(place), response.size() - 2);
    const double v = response[i] + (place - static_cast<double>(i)) * (response[i + 1] - response[i]);
    line.points.push_back({wave, std::max(v, kLeast), false});
  }
  return line;
}

void mark(ChartLine& line, const std::optional<double>& wave, double share) {
  if (!wave) return;
  const auto after =
      std::find_if(line.points.begin(), line.points.end(), [&](const ChartPoint& p) { return p.x < *wave; });
  line.points.insert(after, {*wave, share, true});
}

enum class Section { AlongX, AlongY };

ChartLine section_of(const HeightMap& map, Section section, const std::string& label, Colour colour, bool dashed) {
  const Grid& g = map.grid;
  ChartLine line{label, colour, {}, false, dashed};
  const bool along_x = section == Section::AlongX;
  const double axis = along_x ? -g.origin.y / g.pitch_y : -g.origin.x / g.pitch_x;
  const auto last = static_cast<double>((along_x ? g.rows : g.cols) - 1);
  const auto at = static_cast<Index>(std::lround(std::clamp(axis, 0.0, last)));
  for (Index k = 0; k < (along_x ? g.cols : g.rows); ++k)
    line.points.push_back({along_x ? g.x(k) : g.y(k), along_x ? map.at(at, k) : map.at(k, at), false});
  return line;
}

ChartPanel section_panel(const TifResult& result, Section section) {
  constexpr std::array kColours{Colour{214, 39, 40}, Colour{31, 119, 180}, Colour{44, 160, 44}};
  ChartPanel panel{section == Section::AlongX ? "x [mm], through the tool axis" : "y [mm], through the tool axis",
                   "rate [nm/s]",
                   {section_of(result.rates, section, result.source, {32, 32, 32}, false)},
                   AxisScale::Linear,
                   AxisScale::Linear};
  for (std::size_t k = 0; k < std::min(result.fits.size(), kColours.size()); ++k)
    panel.lines.push_back(
        section_of(result.fits[k].fitted, section, "fit: " + result.fits[k].model, kColours[k], true));
  return panel;
}

}  // namespace

std::string section_picture(const TifResult& result, FigureFormat format) {
  return draw_line_charts("Sections of the removal function", "",
                          {section_panel(result, Section::AlongX), section_panel(result, Section::AlongY)}, format);
}

std::string tif_picture(const TifResult& result, FigureFormat format) {
  const RemovalAnalysis& a = result.analysis;
  const std::string title =
      fmt::format("Removal function ({}): peak {:.4g} nm/s, FWHM {:.4g} mm, corrects down to {}", result.source, a.peak,
                  a.fwhm, a.at_tenth.radial ? fmt::format("{:.3g} mm", *a.at_tenth.radial) : "-");
  return map_picture(result.rates, {title, "nm/s", false, {}, {}}, format);
}

std::string fit_picture(const TifResult& result, FigureFormat format) {
  const RemovalFit& fit = result.fits.front();
  const auto [least, most] = std::minmax_element(result.rates.values.begin(), result.rates.values.end());
  const double lower = std::min(0.0, *least),
               upper = std::max(*most, *std::max_element(fit.fitted.values.begin(), fit.fitted.values.end()));
  return draw_maps(
             fmt::format("Fit of the removal function ({})", result.source),
             {panel_of(result.rates, ColourMap::Sequential, lower, upper, "as measured"),
              panel_of(fit.fitted, ColourMap::Sequential, lower, upper, "fit: " + fit.model),
              panel_of(fit.residual, ColourMap::Diverging, {}, {}, fmt::format("residual: RMS {:.3g} nm/s", fit.rms))},
             format)
      .bytes;
}

std::string transfer_picture(const TifResult& result, FigureFormat format) {
  const RemovalAnalysis& a = result.analysis;
  const TransferFunction& t = a.transfer;
  const auto line = [&](const std::vector<double>& response, const char* label, Colour colour,
                        const std::optional<double>& half, const std::optional<double>& tenth, bool dashed) {
    ChartLine drawn = curve(t, response, label, colour);
    mark(drawn, half, 0.5);
    mark(drawn, tenth, 0.1);
    drawn.dashed = dashed;
    return drawn;
  };
  return draw_line_charts("Transfer function", "50 % and 10 %",
                          {{"wavelength [mm] along x, along y",
                            "response",
                            {line(t.along_x, "along x", {31, 119, 180}, a.at_half.x, a.at_tenth.x, false),
                             line(t.along_y, "along y", {214, 39, 40}, a.at_half.y, a.at_tenth.y, true)}},
                           {"wavelength [mm], mean over all directions",
                            "response",
                            {line(t.radial, "mean", {32, 32, 32}, a.at_half.radial, a.at_tenth.radial, false)}}},
                          format);
}

}  // namespace dwell
