#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/progress.h"
#include "core/motion/motion.h"
#include "core/motion/program.h"
#include "core/motion/tool_path.h"

namespace dwell {

/// The units of a feed table, as its header says them.
inline constexpr std::string_view kFeedTableUnits = "x_mm and y_mm mm, dwell_s s, feed_mm_per_min mm/min";

/// What feed.csv holds (docs/formats.md): dwell points in the order of the run, each with its dwell and feed.
struct FeedTable {
  ToolPath path;
  std::vector<double> dwell_s;
  std::vector<double> feed_mm_per_min;  // Moving: stroke length / dwell, 0 for halts; Stop: maximum feed
  Motion motion = Motion::Moving;
  double max_feed_mm_per_min = 0.0;
  ProgramFrame frame;                                        // of program.nc; the table is in the part's coordinates
  std::string version;                                       // of the program that wrote the table
  std::vector<std::pair<std::string, std::string>> inputs;   // ("map mirror.csv", SHA-256 in hexadecimal)
  std::vector<std::pair<std::string, std::string>> options;  // that the removal hangs on: ("tif_centre", "centroid")
};

/// A table whose every number is what feed.csv will hold, so that it reads back equal: coordinates rounded to 1e-6 mm,
/// dwells to 9 significant digits (up where the rounded stroke would else be faster than the maximum feed), feeds
/// computed from these and rounded down. lifted[0] is set. `version`, `inputs` and `options` are left to the caller.
/// Throws InputError as program_of(path, dwell_s, motion, max_feed) does.
FeedTable feed_table_of(const ToolPath& path, const std::vector<double>& dwell_s, Motion motion,
                        double max_feed_mm_per_min, const Progress& progress = {});

/// The text of feed.csv. A control character in a header field is written as '?'. Throws std::logic_error if the
/// columns differ in size or a number is not finite.
std::string feed_table_text(const FeedTable& table, const Progress& progress = {});

/// Reads feed.csv. Throws InputError naming file, line, value and what is accepted: a missing header line, one given
/// twice or of another name about units, feeds, times and the like (others are skipped), another
/// number of rows or another total than the header says, a gap in the sequence, a number that is not finite, a negative
/// dwell, a feed above the maximum or one that is not stroke length / dwell (within 1e-6 relative and 4e-6 mm).
FeedTable read_feed_table(const std::filesystem::path& file, const Progress& progress = {});

/// The same from the text of a table; `file` is the name for messages.
FeedTable parse_feed_table(std::string_view text, const std::string& file, const Progress& progress = {});

/// The steps of a table, as program_of(path, dwell_s, motion, max_feed).
Program program_of(const FeedTable& table);

}  // namespace dwell
