#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "paths/feed/end_feed_blocks.h"
#include "paths/feed/machine.h"

namespace dwell {

// Feeds that are linear over the path (FLIN of Siemens 840D): between two speeds v0 and v1 over a length L the machine
// runs at v = v0 + (v1 - v0) s / L, in L ln(v1 / v0) / (v1 - v0), with an acceleration of at most max(v0, v1)
// |v1 - v0| / L. It can neither leave rest so nor come to it.

/// The time of a length run linearly over the path between two speeds > 0 [s].
double path_linear_seconds(double length, double speed_in, double speed_out);

/// Blocks linear over the path in the place of blocks linear over time, each of which they replace in its time, with
/// its speeds at its ends. One between two speeds becomes several, whose speeds between its ends are those of constant
/// acceleration, all times the factor that holds the time, or less where the machine's acceleration binds: then it
/// takes longer, by 1 % at most unless one speed is far below the other. One that leaves rest becomes an even block and
/// three at most after it, whose ends lie on the motion of constant acceleration: rest is left at the machine's own
/// acceleration, and the even block is so long that it gains the time that the others lose. One that comes to rest is
/// the mirror image. `machine` is the one that runs them, `least_seconds` the shortest block to be made where there is
/// a choice. Cost O(blocks).
std::vector<EndFeedBlock> blocks_over_path(const std::vector<EndFeedBlock>& blocks, const Machine& machine,
                                           double least_seconds);

/// The motion of a block that is run linearly over the path, or even with `acceleration` at ends at rest: cubics of
/// time within 1e-6 mm of it, with its velocities at their ends. An even block must have room for its accelerations. Of
/// a halt, one step.
std::vector<ProgramStep> steps_over_path(const EndFeedBlock& block, double acceleration);

/// Whether an even block reaches its feed within its length.
bool has_room(const EndFeedBlock& block, double acceleration);

/// The motion of all blocks on a machine, lifted ways without their time.
Program motion_over_path(const std::vector<EndFeedBlock>& blocks, const Machine& machine);

}  // namespace dwell
