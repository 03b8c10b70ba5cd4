#include "runs/programs/xps_trajectory.h"

#include <fmt/format.h>

#include <iterator>
#include <vector>

#include "core/base/counted.h"
#include "core/base/number_text.h"
#include "core/base/poll.h"
#include "core/base/text_lines.h"
#include "runs/programs/number_text.h"
#include "runs/programs/pvt_place.h"

namespace dwell {
namespace {

constexpr std::string_view kXpsColumns = "dt, dx, vx, dy, vy";
constexpr std::size_t kXpsFields = 5;

}  // namespace

std::string xps_trajectory_text(const PvtTable& table, std::size_t first, std::size_t last) {
  fmt::memory_buffer text;
  for (std::size_t i = first + 1; i <= last; ++i) {
    const PvtRow &from = table.rows[i - 1], &to = table.rows[i];
    const Point way = to.place - from.place;
    fmt::format_to(std::back_inserter(text), "{}, {}, {}, {}, {}\n", seconds_text(to.seconds - from.seconds),
                   coordinate_text(way.x), coordinate_text(to.speed.x), coordinate_text(way.y),
                   coordinate_text(to.speed.y));
  }
  return fmt::to_string(text);
}

bool is_xps_trajectory(std::string_view text) {
  const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  const std::vector<std::string_view> fields = split(line, ',');
  if (fields.size() != 3 && fields.size() != kXpsFields && fields.size() != 7) return false;
  for (const std::string_view field : fields) {
    if (!finite_number(field)) return false;
  }
  return true;
}

PvtTable parse_xps_trajectory(std::string_view text, const std::string& file, std::optional<Point> start,
                              const Progress& progress) {
  PvtPlace at{file};
  if (!start) {
    at.fail(
        "is an XPS trajectory, whose places are relative and which says no beginning; required `start` X,Y in mm, or "
        "the list of trajectories that dwell writes beside it (xps.csv)");
  }
  PvtTable table;
  table.rows.push_back({0.0, *start, {}, true});
  Poll poll(progress);
  for (TextLines lines(text); lines.next();) {
    poll.step();
    at.number = lines.number();
    if (trim(lines.line()).empty()) continue;
    const std::vector<std::string_view> fields = split(lines.line(), ',');
    if (fields.size() != kXpsFields) {
      at.fail(fmt::format("{}; required {}: {} of two positioners, x first", counted(fields.size(), "column"),
                          kXpsFields, kXpsColumns));
    }
    const double seconds = at.within("dt", fields[0], ranges::kTime);
    const PvtRow& last = table.rows.back();
    const Point way{at.place("dx", fields[1]), at.place("dy", fields[3])};
    const PvtRow row{
        last.seconds + seconds, last.place + way, {at.speed("vx", fields[2]), at.speed("vy", fields[4])}, false};
    at.check_within("x", row.place.x, ranges::kPlace);
    at.check_within("y", row.place.y, ranges::kPlace);
    at.check_within("the time from the beginning", row.seconds, ranges::kTime);
    at.add(table, row);
  }
  at.number = 0;
  at.check_end(table);
  return table;
}

}  // namespace dwell
