#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dwell {

/// Whether a word under a name as "orientation", "row order" or "flip" says what this program does anyway: nothing is
/// turned, and the first row is that of the smallest y ("none", "bottom-up", "lower left", "0"). Of a name along an
/// `axis`, 'x' or 'y' ("y_axis", "x sign"), also that x points to the right or y up; 0 is no axis.
bool is_usual_orientation(std::string_view text, char axis);
/// The same of a number: 0, and 1 of an axis.
bool is_usual_orientation(double number, char axis);

/// Whether a name along an axis says where that points ("y_axis", "x sign"), and not what was done to it ("FLIPY").
bool names_a_direction(std::string_view name);

/// Whether the value of "mirror" is a direction in which the map was mirrored ("x", "left-right", "yes"), and not which
/// mirror it is.
bool names_a_mirroring(std::string_view text);

/// What a statement says whose name is a claim of where an axis points and whose value affirms or denies it: "y_up =
/// false", "x axis left: no". Usual: x to the right, y and z up.
struct AxisClaim {
  char axis;
  bool usual;
};

/// Nothing if the name is no such claim, or the value neither affirms nor denies it. Cost O(length).
std::optional<AxisClaim> read_axis_claim(std::string_view name, std::string_view value);

/// What a statement of the order of the axes says: "dims = y x", "order = F".
enum class AxisOrder { RowsFirst, ColumnsFirst, Unknown };

/// Reads texts ("y", "x"), one text ("(y, x)", "C", "column-major") or numbers (0, 1) that name the axes of an array,
/// the first index first. Nothing named is RowsFirst. Cost O(length).
AxisOrder read_axis_order(const std::vector<std::string>& texts, const std::vector<double>& numbers);

}  // namespace dwell
