#include "runs/figure/setup_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/base/duration_text.h"
#include "core/base/units.h"
#include "core/form/map_statistics.h"
#include "core/map/height_map.h"
#include "runs/drawing/map_figure.h"
#include "runs/drawing/plot_field.h"
#include "runs/job/program_style.h"
#include "runs/reports/program_record.h"

namespace dwell {
namespace {

constexpr Colour kToolColour{20, 150, 60}, kOriginColour{220, 30, 30}, kMarkColour{120, 40, 160};

std::string place_text(Point p) { return fmt::format("({:.3f}, {:.3f}) mm", p.x, p.y); }

Point highest_of(const HeightMap& figure) {
  Index at = -1;
  for (const Index i : finite_pixels(figure)) {
    if (at < 0 || figure.values[static_cast<std::size_t>(i)] > figure.values[static_cast<std::size_t>(at)]) at = i;
  }
  return figure.grid.centre(at);
}

struct Box {
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void hold(Point p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  std::string text() const {
    return fmt::format("x {:.3f} to {:.3f}, y {:.3f} to {:.3f} mm", low.x, high.x, low.y, high.y);
  }
};

std::string zero_line(const ProgramFrame& frame) {
  if (frame.is_of_part()) return "touch off at the origin of the map, axes as the map's";
  return fmt::format("touch off at {} of the part, turned by {:.6g} degrees{}", place_text(frame.zero()),
                     frame.degrees(), frame.swapped() ? ", x and y exchanged" : "");
}

/// What the program makes up for; empty where nothing was learnt.
std::string correction_line(const ProgramFrame& program, const ProgramFrame& as_set_up, Point middle) {
  if (program == as_set_up) return "";
  const Point told = as_set_up.to_part(program.to_program(middle)), way = told - middle;
  return fmt::format(
      "in the program already: it goes ({:+.3f}, {:+.3f}) mm and {:+.4g} degrees beside the part, since the machine "
      "removed that much off; set up as for run 1 and do not touch off at it",
      way.x, way.y, program.degrees() - as_set_up.degrees());
}

std::string tool_line(const PlannedJob& plan) {
  const RemovalFunction& tif = plan.part().tif;
  const JobOptions& o = plan.job.options;
  std::string text = fmt::format("{}: FWHM {:.4g} mm, peak {:.4g} nm/s", o.tif, tif.fwhm, tif.peak);
  if (o.tif_rate != 1.0 || o.tif_width != 1.0)
    text += fmt::format("; {:.4g} times its volume rate, {:.4g} times as wide as the removal function says", o.tif_rate,
                        o.tif_width);
  return text;
}

}  // namespace

std::string SetupSheet::text() const {
  std::string text = title + "\n";
  for (const auto& [what, value] : lines) text += fmt::format("{:<13} {}\n", what, value);
  return text;
}

SetupSheet setup_sheet(const PlannedJob& plan, const WrittenPlan& written, int run, const ProgramFrame& as_set_up) {
  const Part& part = plan.part();
  const ToolPath& path = plan.laid.path;
  const ProgramFrame frame = program_frame(plan.job.options);
  SetupSheet sheet;
  sheet.title = fmt::format("Run {}: {}", run, written.program.file);
  sheet.origin = as_set_up.to_part({});
  sheet.highest = highest_of(part.figure);
  const Stroke& first = plan.laid.strokes.front();
  sheet.start = first.start;
  Box of_part, of_tool;
  for (const Index i : finite_pixels(part.map)) of_part.hold(part.map.grid.centre(i));
  for (const Stroke& stroke : plan.laid.strokes) of_tool.hold(stroke.start), of_tool.hold(stroke.finish);
  const FeedSchedule& feed = plan.program.feed;
  sheet.lines = {
      {"program", fmt::format("{}, sha256 {}", written.program.file, short_hash(written.program_sha256))},
      {"part", fmt::format("{}; {} nm PV, {:.4g} nm RMS before", of_part.text(), fmt::format("{:.4g}", part.before.pv),
                           part.before.rms)},
      {"orientation", "+x to the right, +y up, seen from the tool; red is high and is to be removed"},
      {"check by", fmt::format("the highest place of the error, {} of the part, {} of the program",
                               place_text(sheet.highest), place_text(frame.to_program(sheet.highest)))},
      {"zero", zero_line(as_set_up)},
      {"first move", fmt::format("down at {} of the program, which is {} of the part",
                                 place_text(frame.to_program(sheet.start)), place_text(sheet.start))},
      {"tool", tool_line(plan)},
      {"tool travels", fmt::format("{} of the part ({})", of_tool.text(), path.kind)},
      {"feeds",
       fmt::format("{:.4g} to {:.4g} mm/min", units::mm_per_min(feed.min_speed), units::mm_per_min(feed.max_speed))},
      {"time",
       fmt::format("{}, of it dwell {}", duration_text(written.run_seconds), duration_text(plan.dwell.run_dwell()))},
      {"lift", fmt::format("{:.4g} mm above the work", plan.job.options.lift_height_mm)},
      {"machine", plan.job.machine ? plan.job.machine->name : std::string("not given: no limits but the fastest feed")},
      {"leaves", fmt::format("{} by simulation of the program", in_words(written.exact.statistics))}};
  const std::string correction = correction_line(frame, as_set_up, midpoint(of_part.low, of_part.high));
  if (!correction.empty()) sheet.lines.insert(sheet.lines.begin() + 5, {"correction", correction});
  return sheet;
}

namespace {

/// The error on a field that also holds the tool's way and the program's origin, if that is not far off.
HeightMap with_room(const HeightMap& figure, const PlannedJob& plan, Point origin) {
  const Grid& g = figure.grid;
  Box box;
  box.hold(g.centre(0, 0));
  box.hold(g.centre(g.rows - 1, g.cols - 1));
  const Point low = box.low, high = box.high;
  for (const Stroke& stroke : plan.laid.strokes) box.hold(stroke.start), box.hold(stroke.finish);
  const double radius = 0.5 * plan.part().tif.fwhm;  // the tool's circle at its first place shows whole
  const Point start = plan.laid.strokes.front().start;
  box.hold(start - Point{radius, radius});
  box.hold(start + Point{radius, radius});
  const double longer = std::max(g.width(), g.height());
  const bool is_near = origin.x > low.x - longer && origin.x < high.x + longer && origin.y > low.y - longer &&
                       origin.y < high.y + longer;
  if (is_near) box.hold(origin);
  const auto pixels = [](double way, double pitch) { return static_cast<Index>(std::ceil(way / pitch)) + 1; };
  const Index left = pixels(low.x - box.low.x, g.pitch_x), below = pixels(low.y - box.low.y, g.pitch_y);
  const Index right = pixels(box.high.x - high.x, g.pitch_x), above = pixels(box.high.y - high.y, g.pitch_y);
  Grid wide = g;
  wide.cols += left + right, wide.rows += below + above;
  wide.origin = {g.origin.x - g.pitch_x * static_cast<double>(left),
                 g.origin.y - g.pitch_y * static_cast<double>(below)};
  HeightMap map(wide);
  for (Index r = 0; r < g.rows; ++r) {
    for (Index c = 0; c < g.cols; ++c) map.at(r + below, c + left) = figure.at(r, c);
  }
  return map;
}

std::vector<PanelKey> key_of(const SetupSheet& sheet) {
  std::vector<PanelKey> key{{kToolColour, "the tool's FWHM at its first place, and its first moves"},
                            {kOriginColour, "where to touch off"},
                            {kMarkColour, "highest place of the error"}};
  constexpr double kRoom = 480.0;
  for (const auto& [what, value] : sheet.lines) {
    bool first = true;
    for (const std::string& line : break_into_lines(value, TextStyle{13.0}, kRoom)) {
      key.push_back({kInk, fmt::format("{}{}", first ? what + ": " : "      ", line), true});
      first = false;
    }
  }
  return key;
}

}  // namespace

std::string setup_picture(const SetupSheet& sheet, const PlannedJob& plan, FigureFormat format,
                          const Progress& progress) {
  const Part& part = plan.part();
  MapPanel panel;
  panel.field = field_of_map(with_room(part.figure, plan, sheet.origin), field_edges(1), progress);
  panel.colours = ColourMap::Diverging;
  panel.limits = colour_limits(part.figure.values, ColourMap::Diverging);
  panel.unit = "nm";
  const PlotField& field = panel.field;
  panel.over = [&](Sheet& page, const SheetBox& box) {
    const auto place = [&](Point p) {
      return Point{box.left + box.width * (p.x - field.left) / (field.right - field.left),
                   box.bottom() - box.height * (p.y - field.bottom) / (field.top - field.bottom)};
    };
    const auto cross = [&](Point p, Colour colour) {
      const Point at = place(p);
      for (const LineStyle& style : {LineStyle{kPaper, 4.5}, LineStyle{colour, 2.0}}) {
        page.line(at - Point{9.0, 0.0}, at + Point{9.0, 0.0}, style);
        page.line(at - Point{0.0, 9.0}, at + Point{0.0, 9.0}, style);
      }
    };
    constexpr int kCorners = 48;
    std::vector<Point> ring, way;
    for (int k = 0; k <= kCorners; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kCorners, radius = 0.5 * part.tif.fwhm;
      ring.push_back(place(sheet.start + radius * Point{std::cos(angle), std::sin(angle)}));
    }
    page.polyline(ring, {kToolColour, 2.0});
    constexpr std::size_t kFirstMoves = 12;
    for (std::size_t j = 0; j < std::min(kFirstMoves, plan.laid.strokes.size()); ++j)
      way.push_back(place(plan.laid.strokes[j].start));
    if (way.size() > 1) page.polyline(way, {kToolColour, 2.0});
    cross(sheet.origin, kOriginColour);
    cross(sheet.highest, kMarkColour);
  };
  panel.key = key_of(sheet);
  return draw_maps(sheet.title, {panel}, format).bytes;
}

}  // namespace dwell
