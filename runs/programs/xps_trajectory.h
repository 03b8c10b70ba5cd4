#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/progress.h"
#include "runs/programs/pvt_table.h"

namespace dwell {

/// The text of a Newport XPS trajectory file: a line a step, "dt, dx, vx, dy, vy" with relative time [s], relative
/// displacement [mm] and the velocity at the end [mm/s]. Displacements are differences of rounded places, so that the
/// end does not drift. `first` and `last` are rows of the table between which the tool is at work.
std::string xps_trajectory_text(const PvtTable& table, std::size_t first, std::size_t last);

/// Whether a text is such a file: its first line is three, five or seven numbers with commas between.
bool is_xps_trajectory(std::string_view text);

/// Reads one of two positioners, x first. The file says no absolute place: `start` does. Throws InputError naming file,
/// line, field, value and what is accepted: no start, a line of another number of columns, dt <= 0, a last velocity
/// that is not 0.
PvtTable parse_xps_trajectory(std::string_view text, const std::string& file, std::optional<Point> start,
                              const Progress& progress = {});

}  // namespace dwell
