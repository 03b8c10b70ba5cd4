#pragma once

#include <string>
#include <vector>

#include "runs/programs/feed_table.h"

namespace dwell {

/// What a plan's programs say of how they were made (docs/formats.md): "input: ROLE FILE sha256=HASH" for every file
/// read, "option: KEY = VALUE" for the options that the removal hangs on. Without what begins a comment; control
/// characters as '?'.
std::vector<std::string> record_lines(const FeedTable& table);

}  // namespace dwell
