#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/profile/line_profile.h"

namespace dwell {

/// What the user says of the file of a line profile; empty: the file says it.
struct ProfileReadOptions {
  std::string columns;  // "x,slope", "1,4": of the place and of the value, by name or by number from 1
  std::string unit;     // "mm,urad", "mm,-urad": of place and value; a minus turns the sign of the values
};

/// A profile as its file has it, in the units inside.
struct ProfileText {
  ProfileQuantity quantity = ProfileQuantity::Slope;
  std::vector<double> x;                   // increasing [mm]
  std::vector<double> values;              // [urad] or [nm]
  std::string place_column, value_column;  // by which they were taken, for messages: "x(mm)", "column 2"
  std::string place_unit, value_unit;      // "-urad" where the sign was turned
  bool turned = false;                     // x decreases in the file
};

/// Reads the text of a long-trace profiler, NOM or interferometer (docs/formats.md, Line profiles): comments and header
/// lines, then lines of numbers between blanks, tabs, semicolons or commas. `where` begins error messages. Throws
/// InputError naming line and column of what is no number, of no data, of places that do not run one way or stand
/// twice, and for units and columns that neither file nor options say, or that they say differently. Cost O(bytes).
ProfileText parse_profile_text(std::string_view text, const ProfileReadOptions& options, const std::string& where);

/// The profile as text with a header that names its units, measured quantity first, read back equal. `remark` becomes
/// its first line, a comment.
std::string profile_csv(const LineProfile& profile, const std::string& remark);

}  // namespace dwell
