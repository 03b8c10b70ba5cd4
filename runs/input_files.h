#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/height_map.h"
#include "core/removal_function.h"
#include "runs/job_options.h"

namespace dwell {

/// Factor from a unit of height ("nm", "um", "mm", "m") to nm. Throws InputError naming the accepted ones.
double height_unit_nm(const std::string& unit);
/// Factor from a unit of removal rate ("nm/s", "um/s", "um/min", "m/s") to nm/s.
double rate_unit_nm_per_s(const std::string& unit);
/// "middle", "centroid" or "X,Y" [mm].
TifCentre parse_tif_centre(const std::string& text);
/// "X,Y" [mm], both finite.
Point parse_point(const std::string& text);

/// A file that a run has read, as the user named it, with what it is and its SHA-256.
struct InputFile {
  std::string role;  // "map", "tif", "path", "program"
  std::string file;
  std::string sha256;
};

/// Reads the map of a job and appends the file to `inputs`. Throws InputError.
HeightMap load_map(const JobOptions& options, std::vector<InputFile>& inputs);

/// Reads or makes the removal function of a job; a file is appended to `inputs`. Throws InputError.
RemovalFunction load_removal_function(const JobOptions& options, std::vector<InputFile>& inputs);

/// Throws InputError if the tool is wider than the map both ways: nearly always a wrong pitch or unit of length.
void check_tool_fits(const RemovalFunction& tif, const Grid& map);

}  // namespace dwell
