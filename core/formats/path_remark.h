#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace dwell {

/// What a comment beside x and y that are mm in the system of the map seems to say otherwise: places in pixels, axes
/// that point elsewhere ("y axis down", "rotated by 90 deg"), a shift or a factor. Nothing of prose that says none of
/// these. For readers of paths and feed tables, whose coordinates have one meaning. Cost O(length).
std::optional<std::string> find_other_places(std::string_view comment);

/// The same of a machine program, whose comments are the prose of machine shops ("flip part", "spindle reversed", "z
/// top of stock"): only what says of the axes or coordinates themselves that they are exchanged, turned, mirrored or
/// scaled ("X AND Y SWAPPED", "axes rotated 90", "Y axis down"), or that places are in pixels. Cost O(length).
std::optional<std::string> find_other_axes(std::string_view comment);

}  // namespace dwell
