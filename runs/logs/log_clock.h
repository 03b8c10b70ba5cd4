#pragma once

#include "runs/logs/motion_log.h"

namespace dwell {

/// Puts the clock of a log right, and says in its notes what it found:
///   repeated  samples with the time of the one before. The same place again is dropped; another place counts instead
///             of the earlier one.
///   jumps     the clock goes back, or goes ahead by more than three periods although the tool is only as much farther
///             as in one period: the samples were taken one after the other, so the time between counts as one period.
///   dropped   the clock goes ahead by more than one and a half periods and the tool with it, or it rests: samples are
///             missing there. The tool is taken to run straight between (`gaps`).
/// Throws InputError for fewer than three samples, for a clock that stands still for more than a tenth of them, and
/// for one that jumps more than once in a hundred samples. Cost O(samples).
void settle_clock(MotionLog& log);

}  // namespace dwell
