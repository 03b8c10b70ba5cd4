#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "runs/programs/program_template.h"

namespace dwell {

/// What a program by a template says beside its steps.
struct TemplateWriting {
  double lift_height_mm = 10.0;
  double max_feed_mm_per_min = 0.0;   // > 0; no feed that is written exceeds it
  std::vector<std::string> comments;  // as program_comments; cut to the longest line
};

/// A program in a template's layout: its header, comments and begin; for every stretch with the tool down travel,
/// lower, its moves and halts, lift; its footer. Places are those of the program's frame, which a comment states.
/// Differences (dx, dy, t) are those of rounded places and times, so that no error adds up; feeds are those of rounded
/// places. A move that is shorter than the last decimal is a halt, a halt that is shorter is left out, its time going
/// to the next one. Throws InputError for a line longer than the template allows, more lines than that, a feed that is
/// 0 in the template's decimals, a halt where it has no block for them, a step that says velocities if the template
/// does not (the program would be another) or the reverse; std::logic_error if the program is no chain. Cost O(steps).
std::string text_by_template(const Program& program, const ProgramTemplate& layout, const TemplateWriting& writing,
                             const Progress& progress = {});

/// What a program's motion is in the times of a template: its table on the template's grid of times, where that is
/// coarser than the table's, each place and velocity being that of the motion at the moved time; rests stay where they
/// are. Steps above the template's longest are cut before. Throws InputError as pvt_table_of.
Program motion_for_template(const Program& motion, const ProgramTemplate& layout, const Progress& progress = {});

}  // namespace dwell
