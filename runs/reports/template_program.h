#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "runs/job/planned_job.h"

namespace dwell {

/// The text of a plan's program by the template of its job: its feeds, or its motion where the template says
/// velocities. Where the template's numbers are so coarse that the machine's limits would not hold in the file, the
/// motion is made once more for lower accelerations and longer pieces, 0.97 to 0.7 of the machine's, with the same time
/// for every stroke as far as that goes, and the one that comes nearest to the time of all strokes is taken; if none
/// keeps the limits, the first text is returned, whose faults show when it is read back.
/// `comments` as TemplateWriting. Throws InputError as text_by_template. Cost: a schedule for every trial.
std::string template_program_text(const PlannedJob& plan, const FeedTable& table,
                                  const std::vector<std::string>& comments, const Progress& progress = {});

}  // namespace dwell
