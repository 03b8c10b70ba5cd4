#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/map/aperture.h"
#include "core/map/height_map.h"
#include "runs/base/input_file.h"

namespace dwell {

/// The weights of --weight: terms separated by semicolons, each `edge:width=MM,weight=W`, `centre=W`
/// (runs/plan/pixel_weights.h) or the name of a file, and multiplied with each other. Throws InputError naming the term
/// and what is accepted; files are not looked at.
void check_pixel_weights(const std::string& text);

/// The same with other names for the files: what `name` makes of each.
std::string renamed_pixel_weights(const std::string& text, const std::function<std::string(const std::string&)>& name);

std::vector<std::string> pixel_weight_files(const std::string& text);

/// One weight a pixel of the map, which `aperture` has cut, 0 outside of the clear aperture; empty if all would be 1. A
/// file holds numbers >= 0 without a unit on the map's grid, NaN counting as 0; those that are read are appended to
/// `inputs`. `map_file` is named in what is refused. Throws InputError.
std::vector<double> load_pixel_weights(const std::string& text, const Aperture& clear, const HeightMap& map,
                                       const std::string& map_file, int threads, std::vector<InputFile>& inputs);

}  // namespace dwell
