#include "runs/programs/feed_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <stdexcept>

#include "core/base/errors.h"
#include "core/base/poll.h"
#include "core/base/units.h"
#include "core/base/utf8_text.h"
#include "paths/feed/plan_program.h"
#include "runs/programs/frame_text.h"
#include "runs/programs/number_text.h"

namespace dwell {
namespace {

std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return with_escaped_bytes(text);
}

double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

}  // namespace

FeedTable feed_table_of(const ToolPath& path, const std::vector<double>& dwell_s, Motion motion,
                        double max_feed_mm_per_min, const Progress& progress) {
  Poll poll(progress);
  const double max_feed = units::mm_per_s(max_feed_mm_per_min);
  program_of(path, dwell_s, motion, max_feed);  // throws for what cannot be run, before anything is rounded
  FeedTable table;
  table.path = path;
  table.path.lifted[0] = 1;
  table.motion = motion;
  table.max_feed_mm_per_min = max_feed_mm_per_min;
  for (Point& p : table.path.points) {
    poll.step();
    p = {number_of(coordinate_text(p.x)), number_of(coordinate_text(p.y))};
  }
  const std::vector<Stroke> strokes = strokes_of(table.path, motion);
  for (std::size_t j = 0; j < strokes.size(); ++j) {
    poll.step();
    const double length = strokes[j].length();
    double dwell = number_of(digits_nearest(dwell_s[j]));
    if (length > max_feed * dwell) dwell = number_of(digits_not_below(length / max_feed));
    double feed = motion == Motion::Stop ? max_feed_mm_per_min : 0.0;
    if (length > 0.0)
      feed = number_of(digits_not_above(std::min(units::mm_per_min(length / dwell), max_feed_mm_per_min)));
    table.dwell_s.push_back(dwell);
    table.feed_mm_per_min.push_back(feed);
  }
  return table;
}

std::string feed_table_text(const FeedTable& table, const Progress& progress) {
  const std::size_t n = table.path.size();
  if (table.path.lifted.size() != n || table.dwell_s.size() != n || table.feed_mm_per_min.size() != n) {
    throw std::logic_error("feed table: columns differ in size");
  }
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "# dwell {}\n", one_line(table.version));
  fmt::format_to(out, "# motion: {}\n", to_string(table.motion));
  fmt::format_to(out, "# max_feed_mm_per_min: {}\n", table.max_feed_mm_per_min);
  if (!table.path.kind.empty()) fmt::format_to(out, "# path: {}\n", one_line(table.path.kind));
  fmt::format_to(out, "# rows: {}\n", n);
  fmt::format_to(out, "# total_dwell_s: {:.12g}\n", total(table.dwell_s));
  fmt::format_to(out, "# units: {}\n", kFeedTableUnits);
  if (!table.frame.is_of_part()) fmt::format_to(out, "# machine_frame: {}\n", frame_text(table.frame));
  for (const auto& [name, hash] : table.inputs) {
    fmt::format_to(out, "# input: {} sha256={}\n", one_line(name), one_line(hash));
  }
  for (const auto& [key, value] : table.options) {
    fmt::format_to(out, "# option: {} = {}\n", one_line(key), one_line(value));
  }
  fmt::format_to(out, "sequence,x_mm,y_mm,dwell_s,feed_mm_per_min,lift\n");
  Poll poll(progress);
  for (std::size_t j = 0; j < n; ++j) {
    poll.step();
    const Point p = table.path.points[j];
    fmt::format_to(out, "{},{},{},{},{},{}\n", j + 1, coordinate_text(p.x), coordinate_text(p.y),
                   digits_nearest(table.dwell_s[j]), digits_not_above(table.feed_mm_per_min[j]),
                   table.path.lifted[j] ? 1 : 0);
  }
  return fmt::to_string(text);
}

Program program_of(const FeedTable& table) {
  Program program = program_of(table.path, table.dwell_s, table.motion, units::mm_per_s(table.max_feed_mm_per_min));
  program.frame = table.frame;
  return program;
}

}  // namespace dwell
