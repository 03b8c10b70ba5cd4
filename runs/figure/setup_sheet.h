#pragma once

#include <string>
#include <vector>

#include "core/base/point.h"
#include "runs/drawing/figure_format.h"
#include "runs/job/planned_job.h"
#include "runs/reports/written_plan.h"

namespace dwell {

/// What whoever sets up the machine for a run needs to know, on one page.
struct SetupSheet {
  std::string title;                                       // "Run 2: program.nc"
  Point start;                                             // of the first move at work [mm], on the part
  Point origin;                                            // of the program, on the part [mm]
  Point highest;                                           // of the error: a mark to check the orientation by [mm]
  std::vector<std::pair<std::string, std::string>> lines;  // what, and its value with units

  std::string text() const;
};

/// The sheet of a plan that is written: program and its hash, part, orientation and zero, first move, tool, feeds and
/// times, what it leaves. `as_set_up` is the frame by which the part lies on the machine, that of the first run: what
/// the program's own frame has learnt beyond it makes up for where the machine removed. Cost O(pixels).
SetupSheet setup_sheet(const PlannedJob& plan, const WrittenPlan& written, int run, const ProgramFrame& as_set_up);

/// The sheet as a figure: the part's error with the program's origin, the tool at its first place and the first moves,
/// and the lines below. Throws Interrupted.
std::string setup_picture(const SetupSheet& sheet, const PlannedJob& plan, FigureFormat format,
                          const Progress& progress = {});

}  // namespace dwell
