#include "core/tif/tool_questions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/grid_limit.h"
#include "core/tif/footprint_gaps.h"
#include "core/tif/rate_rim.h"
#include "core/tif/removal_apex.h"

namespace dwell {
namespace {

using Findings = std::vector<ToolFinding>;

std::string place_text(const Grid& grid, Index row, Index col) {
  const Point p = grid.centre(row, col);
  return fmt::format("row {}, column {} (counted from 1; at {:.4g}, {:.4g} mm)", row + 1, col + 1, p.x, p.y);
}

double in_percent(double part, double whole) { return 100.0 * part / whole; }

void question_gaps(const MeasuredTool& tool, const RateRim& rim, Findings& findings) {
  const double peak = tool.tif.peak;
  const double noise = std::min(tool_limits::kNegativeInScatters * rim.scatter, tool_limits::kHeights * peak);
  const double level = std::max(tool_limits::kGap * peak, noise);
  const FootprintGaps gaps = footprint_gaps(tool.rates, level);
  if (gaps.samples == 0) return;
  findings.push_back(
      {true, fmt::format("{} sample{} without data within the tool's footprint would count as 0 nm/s, at {} beside "
                         "{:.3g} nm/s, {:.3g} % of the peak; `tif steps` {} fills {}",
                         gaps.samples, gaps.samples > 1 ? "s" : "", place_text(tool.rates.grid, gaps.row, gaps.col),
                         gaps.beside, in_percent(gaps.beside, peak), gaps.open ? "fill:harmonic,all" : "fill:harmonic",
                         gaps.samples > 1 ? "them" : "it")});
}

void question_pedestal(const MeasuredTool& tool, const RateRim& rim, Findings& findings) {
  double peak = 0.0;  // before the rim was taken off
  for (const double v : tool.rates.values) peak = v > peak ? v : peak;
  const double share = std::abs(rim.mean) / peak;
  const std::string what = fmt::format("the mean rate at the rim of the file is {:.3g} nm/s, {:.3g} % of the peak",
                                       rim.mean, in_percent(rim.mean, peak));
  if (tool.pedestal) {
    const char* done = *tool.pedestal == TifPedestal::Subtract ? "taken off all samples"
                       : *tool.pedestal == TifPedestal::Taper  ? "taken to zero by a cosine over the outer samples"
                                                               : "accepted as it is";
    findings.push_back({false, fmt::format("{}: {}", what, done)});
  } else if (share >= tool_limits::kRimRefused) {
    findings.push_back(
        {true, fmt::format("{}, where it should remove nothing: an offset of the measurement, or a file that cuts the "
                           "tool off; `tif pedestal` subtract takes it off, taper takes the outer part to zero, accept "
                           "leaves it",
                           what)});
  } else if (share >= tool_limits::kRimSaid) {
    findings.push_back({false, what + ", where it should remove nothing (`tif pedestal`)"});
  }
}

void question_sign(const MeasuredTool& tool, const RateRim& rim, Findings& findings) {
  const HeightMap& rates = tool.tif.samples;
  const auto lowest = std::min_element(rates.values.begin(), rates.values.end());
  const double depth = -*lowest, peak = tool.tif.peak;
  const bool like_heights = depth > tool_limits::kHeights * peak;
  const bool beyond_noise =
      depth > std::max(tool_limits::kNegative * peak, tool_limits::kNegativeInScatters * rim.scatter);
  if (!like_heights && !beyond_noise) return;
  const Index i = lowest - rates.values.begin();
  const std::string what = fmt::format("the rate at {} is {:.4g} nm/s, {:.3g} % of the peak",
                                       place_text(tool.rates.grid, i / rates.grid.cols, i % rates.grid.cols), *lowest,
                                       in_percent(*lowest, peak));
  findings.push_back(
      {true,
       like_heights
           ? what + ": a removal function removes everywhere; is this a map of heights, or of what is left?"
           : what + fmt::format(", beyond the noise of its rim ({:.2g} nm/s): a removal function removes "
                                "everywhere; take an offset off by `tif pedestal` subtract, or leave such samples "
                                "out by `tif steps` drop:AREA or keep:AREA",
                                rim.scatter)});
}

/// Distance from the origin to the line from a to b.
double distance_from_line(Point a, Point b) {
  const Point along = b - a;
  const double square = dot(along, along);
  const double place = square > 0.0 ? std::clamp(-dot(a, along) / square, 0.0, 1.0) : 0.0;
  return length(a + place * along);
}

/// The centroid of the samples, about the axis.
Point centroid_of(const HeightMap& rates) {
  double sum = 0.0;
  Point moment;
  for (Index i = 0; i < rates.grid.size(); ++i) {
    const double v = rates.values[static_cast<std::size_t>(i)];
    sum += v, moment = moment + v * rates.grid.centre(i);
  }
  return (1.0 / sum) * moment;
}

void question_axis(const MeasuredTool& tool, Findings& findings) {
  if (!tool.axis_by_default) return;
  const HeightMap& rates = tool.tif.samples;
  const Point centroid = centroid_of(rates);
  const auto top =
      rounded_apex(rates, tool.tif.peak, middle_of(rates.grid), std::hypot(rates.grid.width(), rates.grid.height()));
  const double off = distance_from_line(centroid, top.value_or(centroid));
  if (off <= tool_limits::kAxisOff * tool.tif.fwhm) return;
  findings.push_back(
      {true,
       fmt::format("where is the tool axis? By default it is the middle of the grid, but the centroid lies "
                   "({:.3g}, {:.3g}) mm from there{}, and the FWHM is {:.4g} mm; required from {:.2g} of that on: "
                   "`tif centre` middle, centroid, peak or X,Y",
                   centroid.x, centroid.y,
                   top ? fmt::format(" and the apex of its rounded top, which peak means here, ({:.3g}, {:.3g}) mm",
                                     top->x, top->y)
                       : std::string(),
                   tool.tif.fwhm, tool_limits::kAxisOff)});
}

void question_sampling(const MeasuredTool& tool, const RateRim& rim, Findings& findings) {
  const Grid& g = tool.rates.grid;
  const bool taken_off = tool.pedestal == TifPedestal::Subtract, tapered = tool.pedestal == TifPedestal::Taper;
  const double left = rim.largest - (taken_off ? rim.mean : 0.0);
  if (!tapered && left >= tool_limits::kRimReached * tool.tif.peak) {
    findings.push_back(
        {false, fmt::format("the tool is as wide as its file: {:.3g} % of the peak at its rim, at ({:.4g}, "
                            "{:.4g}) mm; what lies beyond is taken as 0",
                            in_percent(left, tool.tif.peak), rim.largest_at.x, rim.largest_at.y)});
  }
  const double pixels = tool.tif.fwhm / std::max(g.pitch_x, g.pitch_y);
  if (pixels < tool_limits::kFewestPixelsPerFwhm) {
    findings.push_back({false, fmt::format("its FWHM of {:.4g} mm is sampled by {:.2g} pixels only; from {:g} on its "
                                           "shape is known well enough",
                                           tool.tif.fwhm, pixels, tool_limits::kFewestPixelsPerFwhm)});
  }
}

}  // namespace

std::vector<ToolFinding> question_tool(const MeasuredTool& tool) {
  const RateRim rim = rate_rim(tool.rates);
  Findings findings;
  question_sign(tool, rim, findings);
  question_gaps(tool, rim, findings);
  question_pedestal(tool, rim, findings);
  question_axis(tool, findings);
  question_sampling(tool, rim, findings);
  std::stable_sort(findings.begin(), findings.end(),
                   [](const ToolFinding& a, const ToolFinding& b) { return a.refused && !b.refused; });
  return findings;
}

std::vector<std::string> notes_of(const std::vector<ToolFinding>& findings) {
  std::vector<std::string> notes;
  std::string refused;
  for (const ToolFinding& finding : findings) {
    if (!finding.refused) notes.push_back(finding.text);
    if (finding.refused) refused += (refused.empty() ? "" : "; besides, ") + finding.text;
  }
  if (!refused.empty()) throw InputError("removal function: " + refused);
  return notes;
}

}  // namespace dwell
