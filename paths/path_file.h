#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/progress.h"
#include "core/motion/tool_path.h"

namespace dwell {

/// Reads dwell points in the order of the run from a CSV file (docs/formats.md, "Path files"): a header line that
/// names the columns x_mm and y_mm [mm] and possibly lift (0 or 1), in any order; other columns are ignored, as are
/// blank lines and lines that start with '#', unless they name another unit than mm, a scale or an origin. lift = 1:
/// the move that arrives at the point is lifted; the first point always counts as lifted. Kind "file".
///
/// Points that repeat the one before are accepted. Where a point coincides with both its neighbours, its stroke has no
/// length and is a halt. Throws InputError naming file, line, column, value and what is accepted. Cost O(bytes).
ToolPath read_path_file(const std::filesystem::path& file, const Progress& progress = {});

/// The same from the text of such a file; `name` begins error messages.
ToolPath parse_path_text(std::string_view text, const std::string& name, const Progress& progress = {});

}  // namespace dwell
