#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "paths/feed/motion_nodes.h"

namespace dwell {

/// The motion of a machine as text (docs/formats.md): a row for each node. `program` and `machine` are the names that
/// its header says. Throws Interrupted.
std::string motion_table_text(const std::vector<MotionNode>& nodes, const std::string& program,
                              const std::string& machine, const Progress& progress = {});

}  // namespace dwell
