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
/// Options travel as std::any: only the planner's own functions look into them.
struct PathRecord {
  std::string name;     // before the colon
  std::string usage;    // after the colon: "pitch=MM[,step=MM]..."
  std::string about;    // one line
  std::string spacing;  // the key that sets the distance of its tracks and must be given; empty if there is none
  /// Throws InputError as SpecText does.
  std::function<std::any(const SpecText&)> parse;
  /// All distances that must not be wider than the tool.
  std::function<std::vector<PathDistance>(const std::any&)> distances;
  std::function<ToolPath(const std::any&, const PathJob&)> plan;
  /// All after the colon is one value, the name of a file, which is not cut at commas.
  bool one_value = false;
};

/// Every planner, in the order of the documentation.
const std::vector<PathRecord>& path_catalogue();

/// Which planner, and its options, parsed once. Without a record it is no path yet.
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

/// The text that parse_path_spec makes the same path of; empty if none is given.
std::string to_string(const PathSpec& spec);

/// Runs the planner. A pitch, cell or step wider than the removal function is refused; moves longer than that with the
/// tool down are in the notes. A path from a file that comes nowhere within the TIF's reach of a valid pixel is
/// refused. Throws InputError as the planners do, std::logic_error if the path has no record, Interrupted.
ToolPath plan_path(const PathSpec& spec, const PathJob& job);

}  // namespace dwell
