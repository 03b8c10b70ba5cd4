#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "core/map/height_map.h"
#include "core/motion/tool_path.h"
#include "core/tif/removal_function.h"
#include "paths/curves/circles.h"
#include "paths/curves/fibonacci.h"
#include "paths/curves/spiral.h"
#include "paths/lattice/hilbert.h"
#include "paths/lattice/peano.h"
#include "paths/lattice/random_path.h"
#include "paths/lines/cross_hatch.h"
#include "paths/lines/multi_pitch.h"
#include "paths/lines/random_raster.h"
#include "paths/lines/raster.h"
#include "paths/tours/nearest_neighbour.h"

namespace dwell {

/// A path that the user brings (docs/formats.md, "Path files").
struct PathFromFile {
  std::filesystem::path file;
};

/// Which planner, and its options.
using PathSpec = std::variant<RasterOptions, CrossHatchOptions, RandomRasterOptions, MultiPitchOptions, SpiralOptions,
                              CirclesOptions, FibonacciOptions, RandomOptions, HilbertOptions, PeanoOptions,
                              NearestOptions, PathFromFile>;

/// A kind of path as a user names it.
struct PathKind {
  std::string name;   // before the colon
  std::string usage;  // after the colon: "pitch=MM[,step=MM]..."
  std::string about;  // one line
  /// The key that sets the distance of its tracks and must be given; empty if there is none.
  std::string spacing = "pitch";
};

/// Every kind that parse_path_spec accepts, in the order of the documentation.
const std::vector<PathKind>& path_kinds();

/// Parses "kind:key=value,..." as path_kinds says; "file:PATH.csv": all after the colon is the name. Throws InputError
/// naming the text, the key or kind that is unknown or missing, and those accepted. Ranges are checked where the path
/// is planned.
PathSpec parse_path_spec(const std::string& text);

/// What a path is planned for. Refers to what it was made of.
struct PathJob {
  const HeightMap& target;                                    // removal wanted [nm], NaN = outside
  const RemovalFunction& tif;                                 // its radius is the default overrun
  double max_feed = std::numeric_limits<double>::infinity();  // [mm/s]
  /// Whether notes say what has to be worked out besides the path: the feed by depth of a multi-pitch raster, which
  /// takes as long as planning it.
  bool estimates = false;
  /// Asked now and then by the improvement of paths, which takes long; true ends it with what has been reached.
  std::function<bool()> stop{};
};

/// Runs the planner. A pitch, cell or step wider than the removal function is refused; moves longer than that with the
/// tool down are in the notes. A path from a file that comes nowhere within the TIF's reach of a valid pixel is
/// refused. Throws InputError as the planners do.
ToolPath plan_path(const PathSpec& spec, const PathJob& job);

}  // namespace dwell
