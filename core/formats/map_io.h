#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/errors.h"
#include "core/base/grid_limit.h"
#include "core/base/pitch.h"
#include "core/base/progress.h"
#include "core/base/staged_files.h"
#include "core/formats/map_rows.h"
#include "core/formats/matrix_table.h"
#include "core/formats/no_data.h"
#include "core/formats/wave_options.h"
#include "core/map/height_map.h"
#include "core/map/scattered_surface.h"

namespace dwell {

/// What a map file does not say about itself.
struct MapReadOptions {
  std::optional<Point> pitch;   // pixel pitch in x and y [mm], both > 0; required by files that carry none
  std::optional<Point> origin;  // centre of pixel (0, 0) [mm]; default (0, 0), or what the file says
  std::optional<double> scale;  // factor from the file's unit to nm (or nm/s); default: what it says, or 1
  std::string name = "map";     // what error messages call it: "map" or "tif"
  MapQuantity quantity = MapQuantity::Height;  // what the values are; a file that says otherwise is refused
  PixelLimit limit;                            // given, it also allows a packed file to unpack that far
  /// Whether places in the file's own coordinates count. Not for a removal function that is centred by its grid or its
  /// centroid: what only seems to say an origin is skipped then.
  bool origin_counts = true;
  WaveOptions waves;                     // of heights in waves, and of path differences
  std::optional<NoDataMarkers> no_data;  // numbers of the file that stand for no data, besides what it says
  std::optional<double> max_pv;          // the most that heights or rates may span [nm], [nm/s]; default 10 mm, 10 mm/s
  std::optional<MatrixTable> table;      // what the first row and column of a matrix as text are
  std::optional<MapRows> rows;           // at which edge the first row of a grid lies; default: as the format says
  std::optional<ScatterOptions> grid;    // points x y z are scattered: a surface is fitted to them
  int threads = 1;                       // for that fit
};

/// Neither the file nor an option says the pixel pitch.
class MissingPitch : public InputError {
 public:
  using InputError::InputError;
};

/// Reads a map by the file's content and extension (docs/formats.md). `file` may name one array of a file that holds
/// several, as `run.h5:/before` (core/formats/map_name.h). What an NPY array does not say is taken from its sidecar
/// (core/formats/npy_sidecar.h), if it has one. What was done on the way (marks for no data, a table's index, the
/// gridding of points) is in the map's history.
/// Throws InputError naming file, line or field, value, and what is accepted; Interrupted.
HeightMap read_map(const std::filesystem::path& file, const MapReadOptions& options = {},
                   const Progress& progress = {});

/// Writes a map, whole or not at all, in the format of the extension (core/formats/map_formats.h); an NPY array with
/// its sidecar. Values are written in nm (rates in nm/s) so that they read back equal.
void write_map(const std::filesystem::path& file, const HeightMap& map);

/// The same under temporary names, to be put in place with other files.
void stage_map(const std::filesystem::path& file, const HeightMap& map, StagedFiles& files);

}  // namespace dwell
