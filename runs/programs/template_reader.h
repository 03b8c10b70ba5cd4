#pragma once

#include <string>
#include <string_view>

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "runs/programs/program_template.h"

namespace dwell {

/// Reads a program that a template describes, line by line: comments are skipped, every other line must be one that the
/// template writes there. Throws InputError naming file, line, text and what would be accepted: a line of no block, a
/// block that breaks off, a move without time or with a time <= 0, a program without a move or without its footer.
/// `file` is the name for messages. Cost O(lines).
Program read_by_template(std::string_view text, const std::string& file, const ProgramTemplate& layout,
                         const Progress& progress = {});

}  // namespace dwell
