#include "runs/programs/pvt_place.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/utf8_text.h"
#include "core/formats/path_remark.h"
#include "core/map/unit_mention.h"
#include "runs/programs/number_text.h"
#include "runs/programs/recorded_option.h"

namespace dwell {

void PvtPlace::fail(const std::string& what) const {
  if (number == 0) throw InputError(fmt::format("{}: {}", file, what));
  throw InputError(fmt::format("{}, {} {}: {}", file, unit, number, what));
}

double PvtPlace::finite(std::string_view name, std::string_view text) const {
  const std::optional<double> value = finite_number(text);
  if (!value) fail(fmt::format("{} = {}; required a finite number", name, in_quotes(with_escaped_bytes(text))));
  return *value;
}

void PvtPlace::check_within(std::string_view name, double value, const ValueRange& range) const {
  if (!range.holds(value)) fail(fmt::format("{} = {}; required {}", name, value, range.text()));
}

double PvtPlace::within(std::string_view name, std::string_view text, const ValueRange& range) const {
  const double value = finite(name, text);
  check_within(name, value, range);
  return value;
}

double PvtPlace::place(std::string_view name, std::string_view text) const {
  return within(name, text, ranges::kPlace);
}
double PvtPlace::speed(std::string_view name, std::string_view text) const { return within(name, text, kPvtSpeeds); }

void PvtPlace::add(PvtTable& table, const PvtRow& row) const {
  if (table.rows.empty() && row.speed != Point{}) {
    fail(fmt::format("the program begins at a velocity of ({}, {}) mm/s; required 0,0: a machine begins at rest",
                     row.speed.x, row.speed.y));
  }
  if (!table.rows.empty()) {
    const PvtRow& last = table.rows.back();
    if (!(row.seconds > last.seconds)) {
      fail(fmt::format("the time {} s is not after that of the row before, {} s; required times that grow", row.seconds,
                       last.seconds));
    }
    if (row.lifted != last.lifted && table.rows.size() > 1 && last.speed != Point{}) {
      fail(
          fmt::format("the tool is {} before this row at a velocity of ({}, {}) mm/s; required 0,0: it rests meanwhile",
                      row.lifted ? "lifted" : "lowered", last.speed.x, last.speed.y));
    }
  }
  table.rows.push_back(row);
}

void PvtPlace::check_end(const PvtTable& table) const {
  if (table.rows.size() < 2) fail("no step; required two places at least");
  const Point speed = table.rows.back().speed;
  if (speed != Point{}) {
    fail(
        fmt::format("the program ends at a velocity of ({}, {}) mm/s; required 0,0: a machine ends at rest "
                    "(truncated?)",
                    speed.x, speed.y));
  }
}

void PvtPlace::check_comment(std::string_view comment) const {
  comment = trim(comment);
  if (is_record(comment)) return;
  std::string rest(comment);
  for (const std::string_view unit_here : {"mm/s", "[ms]", "PVT ms"}) {  // the units of such files
    for (std::size_t at = rest.find(unit_here); at != std::string::npos; at = rest.find(unit_here))
      rest.replace(at, unit_here.size(), "");
  }
  if (const auto other = find_other_unit(rest)) {
    fail(fmt::format("{} in the comment \"{}\" looks like another unit; accepted: {}, or the comment without a unit",
                     in_quotes(with_escaped_bytes(*other)), with_escaped_bytes(comment), kPvtUnits));
  }
  if (const auto other = find_other_places(comment)) {
    fail(fmt::format("the comment \"{}\" looks like {}; accepted: {}, or the comment left out",
                     with_escaped_bytes(comment), *other, kPvtUnits));
  }
}

std::optional<Point> stated_start(std::string_view text) {
  text = trim(text);
  const std::size_t blank = text.find(' ');
  if (!text.starts_with('X') || blank == std::string_view::npos) return std::nullopt;
  const std::string_view y = trim(text.substr(blank));
  if (!y.starts_with('Y')) return std::nullopt;
  const auto x_mm = finite_number(text.substr(1, blank - 1)), y_mm = finite_number(y.substr(1));
  if (!x_mm || !y_mm || !ranges::kPlace.holds(*x_mm) || !ranges::kPlace.holds(*y_mm)) return std::nullopt;
  return Point{*x_mm, *y_mm};
}

std::string start_text(Point start) {
  return fmt::format("X{} Y{}", coordinate_text(start.x), coordinate_text(start.y));
}

}  // namespace dwell
