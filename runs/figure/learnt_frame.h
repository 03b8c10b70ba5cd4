#pragma once

#include <string>

#include "core/base/point.h"
#include "runs/figure/tool_lesson.h"
#include "runs/job/job_options.h"

namespace dwell {

/// The options of a plan with what a lesson has taught: tool rate and width, and a frame of the program that makes up
/// for where the machine removed. A machine that removes at R(p), told p, is told R^-1(p): with the frame q = S T (p -
/// zero) before, zero' = R(zero) and T' = T R^-1. `about` is the centre of the lesson's rotation [mm].
JobOptions with_learnt(JobOptions options, const ToolLesson& lesson, Point about);

/// Why the frame of the programs of these options cannot be changed; empty if it can. Programs of positions,
/// velocities and times say places of the part.
std::string why_frame_is_fixed(const JobOptions& options);

}  // namespace dwell
