#pragma once

#include <any>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/base/spec_text.h"
#include "core/motion/tool_path.h"
#include "paths/domain/path_distance.h"
#include "paths/domain/path_job.h"

namespace dwell {

/// What is known of a planner. One table of these records feeds the parser, the command line's list and shorthand, the
/// documentation and the tests that run over all planners: a new planner is its two files and its row (docs/adding.md).
/// Options are passed as std::any, and only the planner's own functions look into them.
struct PathRecord {
  std::string name;     // before the colon
  std::string usage;    // after the colon: "pitch=MM[,step=MM]..."
  std::string about;    // one line
  std::string spacing;  // the key that sets the distance of its tracks and must be given; empty if there is none
  /// Throws InputError as SpecText does.
  std::function<std::any(const SpecText&)> parse;
  /// All distances that must not exceed the width of the tool.
  std::function<std::vector<PathDistance>(const std::any&)> distances;
  std::function<ToolPath(const std::any&, const PathJob&)> plan;
  /// Whether all after the colon is one value, the name of a file, which is not split at commas.
  bool one_value = false;
};

/// Every planner, in the order of the documentation.
const std::vector<PathRecord>& path_catalogue();

/// A planner and its options, parsed once. Without a record, no path has been chosen yet.
struct PathSpec {
  const PathRecord* record = nullptr;  // of path_catalogue()
  std::string text;                    // as it was parsed
  std::any options;

  bool given() const { return record != nullptr; }
  /// The options if they are of that type, else null.
  template <class Options>
  const Options* get_if() const {
    return std::any_cast<Options>(&options);
  }
};

/// The options of a path whose planner takes this type. Throws std::bad_any_cast for another planner.
template <class Options>
Options options_of(const PathSpec& spec) {
  return std::any_cast<Options>(spec.options);
}

/// A path that the user brings (docs/formats.md, "Path files").
struct PathFromFile {
  std::filesystem::path file;
};

/// Parses "kind:key=value,..." as the catalogue says; "file:PATH.csv": all after the colon is the name. Throws
/// InputError naming the text, the key or kind that is unknown or missing, and those accepted. Ranges are checked where
/// the path is planned.
PathSpec parse_path_spec(const std::string& text);

/// The text from which parse_path_spec makes the same path; empty if none is given.
std::string to_string(const PathSpec& spec);

/// Runs the planner. Refuses a pitch, cell or step wider than the removal function, and a path from a file that nowhere
/// comes within the TIF's reach of a valid pixel. The notes name moves that are longer than the removal function is
/// wide and made with the tool down. Throws InputError as the planners do, std::logic_error if the path has no record,
/// Interrupted.
ToolPath plan_path(const PathSpec& spec, const PathJob& job);

}  // namespace dwell
