#pragma once

#include <optional>
#include <string>

#include "core/base/point.h"
#include "core/tif/removal_function.h"

namespace dwell {

/// "X,Y" [mm], both finite. Throws InputError naming the text and what is accepted.
Point parse_point(const std::string& text);
/// A text that reads back equal.
std::string to_string(const Point& point);

/// A pixel pitch [mm]: one number of square pixels, or "X,Y". Two whole numbers are refused, for the comma may be a
/// decimal one ("1,5"). Throws InputError naming the text and what is accepted.
Point parse_pitch(const std::string& text);

/// Where the tool axis lies in the file of a removal function: "middle", "centroid", "peak" or "X,Y" [mm]. Nothing for
/// "auto": then the file says it, or its kind. Throws InputError naming the text and what is accepted.
std::optional<TifCentre> parse_tif_centre(const std::string& text);
std::string to_string(const std::optional<TifCentre>& centre);

}  // namespace dwell
