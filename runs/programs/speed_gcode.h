#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/motion/program_frame.h"
#include "paths/feed/end_feed_blocks.h"
#include "runs/programs/gcode.h"
#include "runs/programs/speed_gcode_words.h"

namespace dwell {

/// The text of g293.nc or flin.mpf (docs/formats.md) for blocks in the part's coordinates: in ASCII, no line longer
/// than kLongestLine. Of `options` count the lift height, the maximum feed, which no F exceeds, the header, the block
/// numbers and the machine (letters, steps of its places; for FLIN its accelerations, which a comment says). Places
/// have 6 decimals, F 9 digits, never rounded up. A block shorter than the last decimal goes to the one before it.
/// Lifted ways are rapids. A speed that would read as rest (kFeedOfRest) is raised above it. Throws
/// InputError for an option out of range and where that would cost over 1 % of a block's time, std::logic_error if the
/// blocks are no chain or an even one is of G293. Cost O(blocks).
std::string speed_gcode_text(SpeedDialect dialect, const std::vector<EndFeedBlock>& blocks, const ProgramFrame& frame,
                             const GcodeOptions& options, const Progress& progress = {});

}  // namespace dwell
