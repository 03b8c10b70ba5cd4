#include "runs/plan/rounded_motion.h"

#include <vector>

#include "paths/feed/cubic_check.h"
#include "paths/feed/end_feed_blocks.h"
#include "paths/feed/exported_motion.h"
#include "paths/feed/path_linear.h"
#include "runs/programs/pvt_table.h"

namespace dwell {

namespace {

/// Feeds linear over the path in the place of a motion keep the limits, with what is left to rounding.
bool keeps_limits_over_path(const Program& motion, const Machine& machine) {
  const Machine tight = with_margins(machine);
  const std::vector<EndFeedBlock> blocks =
      blocks_over_path(blocks_of_motion(motion), machine, least_piece_seconds(machine));
  return cubics_beyond_machine(motion_over_path(blocks, tight), tight).empty();
}

Program motion_to_be_run_over_path(const Machine& machine,
                                   const std::function<Program(double acceleration_share)>& make) {
  Program motion;
  for (const double share : {0.9, 0.85, 0.8, 0.75, 0.7, 0.65, 0.6, 0.5, 0.45}) {
    motion = make(share);
    if (keeps_limits_over_path(motion, machine)) break;
  }
  return motion;
}

}  // namespace

Program motion_to_be_rounded(const Machine& machine, const std::function<Program(double acceleration_share)>& make,
                             bool over_path) {
  if (over_path) return motion_to_be_run_over_path(machine, make);
  if (!machine.controller.is_coarse()) return make(kAccelerationShare);
  Program motion;
  for (const double share : {kAccelerationShare, 0.97, 0.9, 0.8, 0.65, 0.5}) {
    motion = make(share);
    if (cubics_beyond_machine(rounded_motion(motion, machine), machine).empty()) break;
  }
  return motion;
}

Program rounded_motion(const Program& motion, const Machine& machine) {
  if (!machine.controller.is_coarse()) return motion;
  Program rounded = program_of(pvt_table_of(motion, {}, pvt_steps_of(machine)), motion.file);
  rounded.fastest_feed = motion.fastest_feed;
  return rounded;
}

}  // namespace dwell
