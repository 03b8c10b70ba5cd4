#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace dwell {

/// The words of a comment that say another unit than those of paths and programs: mm, mm/min and s (or ms, where
/// `milliseconds`). Nothing if there are none. So "coordinates in um", "x_um y_um", "(F in mm/s)", "units: inch",
/// "feed [mm/s]" and "imperial" are found. Not found are prose ("in the middle"), a number with its unit
/// ("a tool of 10 um"), and units of heights, rates and pressures, which no path has ("heights in nm").
///
/// For readers of files whose units are fixed: a comment that contradicts them is refused, never skipped. Units of
/// length and of rate are those of value_units.h. Cost O(length of the comment).
std::optional<std::string> find_other_unit(std::string_view comment, bool milliseconds = false);

}  // namespace dwell
