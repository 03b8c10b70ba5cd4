#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dwell {

/// A column as a user names it: by its name in the file or its number, 1 = first, with its unit or none.
struct LogColumnName {
  std::string name, unit;
};

/// What a user says of a log beside its file.
struct LogReading {
  std::vector<LogColumnName> columns;  // time, x, y, or x, y alone where the period is given; none: by their names
  std::optional<double> period;        // of the sampling [s], where no column holds the time
};

/// Parses `TIME[:UNIT],X[:UNIT],Y[:UNIT]`, as in "Time:ms,PosX:um,PosY:um" or "1:samples,2:mm,3:mm". Throws InputError
/// naming the text and what is accepted.
std::vector<LogColumnName> parse_log_columns(std::string_view text);

/// Whether the text is a unit that a column of a log may have.
bool is_log_unit(std::string_view text);

/// Where a quantity stands in a log.
struct LogColumn {
  std::size_t index = 0;
  std::string name;        // for messages
  double factor = 1.0;     // to s or mm
  bool assumed = false;    // nothing says the unit
  bool from_user = false;  // the user says it
};

struct LogColumns {
  std::optional<LogColumn> time;  // none: the samples follow each other by the period
  LogColumn x, y;
};

/// Finds the columns of time, x and y among `count` columns with these names (empty: they have none). A name may hold
/// its unit: t_ms, "Time [s]", "x (um)", y/mm. Without names, three columns are taken as t, x, y, and two as x, y where
/// the period is given. Throws InputError naming the column, its unit and what is accepted: one that is not there, is
/// there twice, or has a unit of something else.
LogColumns find_log_columns(const std::vector<std::string>& names, std::size_t count, const LogReading& reading,
                            const std::string& where);

}  // namespace dwell
