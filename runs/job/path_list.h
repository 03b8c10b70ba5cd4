#pragma once

#include <string>
#include <vector>

namespace dwell {

/// A path of a list of them.
struct ListedPath {
  std::string text;  // as parse_path_spec reads it
  std::string name;  // of its folder: the kind, numbered where a kind comes more than once ("raster-2")
};

/// Paths as a user lists them: "raster,spiral:pitch=2,from=edge,hilbert", each with the options of --path. A word
/// without "=", or with a ":" before it, begins the next path; a list with semicolons is cut at those alone (for names
/// of files with commas). A path whose kind needs a pitch (cell) and says none gets `pitch` [mm]. Throws InputError
/// naming the list, or as parse_path_spec does.
std::vector<ListedPath> parse_path_list(const std::string& list, double pitch);

}  // namespace dwell
