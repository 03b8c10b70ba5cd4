#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/tif/removal_function.h"
#include "core/tif/tif_pedestal.h"

namespace dwell {

/// A measured removal function as its file has it, and what has already been answered about it.
struct MeasuredTool {
  const HeightMap& rates;        // [nm/s] in the coordinates of the file, NaN = no data; before a pedestal was mended
  const RemovalFunction& tif;    // what was made of it, not yet turned
  bool axis_by_default = false;  // nobody said where the tool axis lies: the middle of the grid was taken
  std::optional<TifPedestal> pedestal;  // what was done about the rates at the rim
};

/// What is doubtful about a removal function.
struct ToolFinding {
  bool refused = false;  // not to be planned with; otherwise only said
  std::string text;      // a sentence with place, value, unit, and the option that answers it
};

/// The shares from which on a removal function is questioned.
namespace tool_limits {
inline constexpr double kGap = 0.01;               // of the peak: samples that count as footprint around a gap
inline constexpr double kRimSaid = 0.01;           // of the peak: the mean rate at the rim is said,
inline constexpr double kRimRefused = 0.05;        // and refused unless it was answered
inline constexpr double kRimReached = 0.05;        // of the peak at one place of the rim: as wide as its grid, said
inline constexpr double kAxisOff = 0.1;            // of the FWHM: axis by default off centroid and peak, refused
inline constexpr double kNegative = 0.01;          // of the peak: a negative rate beyond it and beyond
inline constexpr double kNegativeInScatters = 6;   // so many scatters of the rim is refused,
inline constexpr double kHeights = 0.1;            // and beyond this share of the peak whatever the scatter
inline constexpr double kFewestPixelsPerFwhm = 4;  // fewer are said
}  // namespace tool_limits

/// Everything that is doubtful about a measured removal function, what is refused first:
/// - samples without data within the footprint, which would count as zero: holes beside samples above a hundredth of
/// the
///   peak, and gaps open to the edge that have such samples on both sides on three of the four lines through them (row,
///   column, diagonals), which no place outside a convex footprint has. What lies outside stays zero without a word;
/// - a pedestal: the mean rate at the rim of the data;
/// - negative rates beyond noise, and values that look like heights;
/// - a tool axis that was taken at the middle of the grid and lies off the line between centroid and rounded top;
/// - a tool that reaches the edge of its grid; fewer than four samples a FWHM.
/// Cost O(samples).
std::vector<ToolFinding> question_tool(const MeasuredTool& tool);

/// Throws InputError with all refused findings, if there are any; returns the others.
std::vector<std::string> notes_of(const std::vector<ToolFinding>& findings);

}  // namespace dwell
