#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/progress.h"
#include "core/motion/axis_letters.h"
#include "runs/programs/feed_table.h"
#include "runs/programs/pvt_table.h"

namespace dwell {

/// The text of a PMAC motion program in PVT mode (Turbo PMAC Software Reference, PVT): absolute places, velocities for
/// Isx90 = 1000, which a comment states, times in ms to 1e-6, none above 4095 ms (longer steps are cut, on the same
/// cubic). A comment says where it begins, for the program itself does not. `first` and `last` are rows of the table
/// between which the tool is at work, `letters` the axes of x and y.
std::string pmac_program_text(const PvtTable& table, std::size_t first, std::size_t last, const FeedTable& made,
                              AxisLetters letters = {});

/// Whether a text is such a program: a line begins with PVT and a number before any word of G-code.
bool is_pmac_program(std::string_view text);

/// Reads one of the two axes `letters`. What it leaves open must be said: where it begins, by its comment "start: X...
/// Y..." or by `start`, which must agree; and Isx90, by "Isx90 = N", in a comment or not. Units are honoured: a
/// velocity counts for Isx90 ms. A velocity that is left out is 0, as the controller takes it. Throws InputError naming
/// file, line and what is accepted: any other word or axis, a step without one of the two, a step before ABS or INC and
/// PVT, times <= 0 or above 4096 ms, a last velocity that is not 0, another number of steps than its comment "steps: N"
/// says.
PvtTable parse_pmac_program(std::string_view text, const std::string& file, std::optional<Point> start,
                            const Progress& progress = {}, AxisLetters letters = {});

}  // namespace dwell
