#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace dwell {

/// The units that a line gives to the columns x, y and z; empty = none.
struct XyzColumns {
  std::array<std::string, 3> units;
  bool unit_apart = false;  // one unit, after a blank behind z: "x, y, z [um]" may mean it of all three
};

/// Reads a line that names the columns, in a comment or not: "x y z", "x_mm y_mm z_nm", "X [mm], Y [mm], Z [um]",
/// "# x (m)  y (m)  height (m)", "x/mm y/mm z/nm". Nothing if it names anything else.
std::optional<XyzColumns> parse_xyz_columns(std::string_view line);

/// Whether a comment that parse_xyz_columns does not know names columns all the same: others, or in another order
/// ("y x z", "r theta z", "x y z weight"), or gives units without names ("mm mm um", "[um]").
bool names_other_columns(std::string_view line);

}  // namespace dwell
