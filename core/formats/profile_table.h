#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/formats/profile_columns.h"

namespace dwell {

/// The numbers of a text table below a header, and what the header says.
struct ProfileTable {
  std::size_t columns = 0;
  std::vector<std::vector<double>> rows;  // NaN: no number
  std::vector<long> lines;                // of the rows
  std::vector<ProfileColumn> names;       // empty: the header names none
  long names_line = 0;
  std::optional<std::string> place_unit, value_unit;  // of a statement "units: mm, urad"
  std::vector<std::string> unclear;  // what may be a unit or a factor, a message each, unless the user gives the unit
};

/// Reads the lines; the table begins at the first line of two or more numbers. Throws InputError naming the line of
/// another number of fields, of a field that is no number, of no data, of decimal commas, and of a statement about
/// missing values. Cost O(bytes).
ProfileTable read_profile_table(std::string_view text, const std::string& where);

}  // namespace dwell
