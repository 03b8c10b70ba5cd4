#include "runs/plan/rounded_motion.h"

#include "paths/feed/cubic_check.h"
#include "paths/feed/exported_motion.h"
#include "runs/programs/pvt_table.h"

namespace dwell {

Program motion_to_be_rounded(const Machine& machine, const std::function<Program(double acceleration_share)>& make) {
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
