#pragma once

#include <functional>

#include "core/motion/program.h"
#include "paths/feed/machine.h"

namespace dwell {

/// A motion that keeps the machine's limits as its tables hold it, with times and places in steps of the controller:
/// `make` is given the share of the accelerations to schedule (with_margins), less and less until the rounded table
/// keeps all of them, at the least half. What then is beyond a limit is said when the file is checked. Of a controller
/// without steps the first motion (kAccelerationShare). With `over_path` feeds that are linear over the path
/// (path_linear.h) must keep the limits in the motion's place, which takes a smaller share of the accelerations. Cost:
/// that of `make`, up to nine times.
Program motion_to_be_rounded(const Machine& machine, const std::function<Program(double acceleration_share)>& make,
                             bool over_path = false);

/// The motion as its tables hold it; as it is for a controller without steps.
Program rounded_motion(const Program& motion, const Machine& machine);

}  // namespace dwell
