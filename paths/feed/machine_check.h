#pragma once

#include <string>
#include <vector>

#include "core/motion/program.h"
#include "paths/feed/machine.h"

namespace dwell {

/// What a program asks of a machine that it cannot do, a sentence each, with the first step (1-based) and how many
/// there are: places outside an axis's travel, feeds above what axes and path allow at work (the machine runs these
/// moves at its own limit), feeds below its least, steps shorter
/// than its block rate allows (short_blocks); of steps that say their speeds, what cubics_beyond_machine finds.
/// Places are those of the program's file (machine_on). Empty if there is nothing. Cost O(steps).
std::vector<std::string> beyond_machine(const Program& program, const Machine& machine);

}  // namespace dwell
