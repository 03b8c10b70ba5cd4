#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/point.h"
#include "core/base/value_range.h"
#include "runs/programs/pvt_table.h"

namespace dwell {

/// Where a reader of positions, velocities and times is in its file, for messages, and the rules that all of these
/// formats share.
struct PvtPlace {
  std::string file;
  std::string unit = "line";  // of the number
  long number = 0;            // 0: of the whole file

  [[noreturn]] void fail(const std::string& what) const;

  /// The numbers of a field. Throw InputError naming file, line, field, value and what is accepted.
  double finite(std::string_view name, std::string_view text) const;
  double within(std::string_view name, std::string_view text, const ValueRange& range) const;
  double place(std::string_view name, std::string_view text) const;
  double speed(std::string_view name, std::string_view text) const;

  /// A number that a file holds as one.
  void check_within(std::string_view name, double value, const ValueRange& range) const;

  /// Appends a row. Throws InputError unless it comes later than the one before it, and the first is at rest.
  void add(PvtTable& table, const PvtRow& row) const;

  /// Throws InputError unless there are two rows, the last one at rest.
  void check_end(const PvtTable& table) const;

  /// Throws InputError for a comment that says another unit, or other axes, than those that the numbers have.
  void check_comment(std::string_view comment) const;
};

inline constexpr ValueRange kPvtSpeeds{-1e6, 1e6, "mm/s"};

/// The place that a comment or option states: "X-1.000000 Y2.500000" of a comment; nothing if it is none.
std::optional<Point> stated_start(std::string_view text);
std::string start_text(Point start);

}  // namespace dwell
