#pragma once

#include <string>

#include "core/base/grid.h"

namespace dwell {

/// The pitch of square pixels, along x and along y [mm].
inline Point square_pitch(double mm) { return {mm, mm}; }

/// The pitch of the pixels for people, never one number for two: "0.5 mm" of square ones, else "0.5 x 0.25 mm", x
/// first. With six digits.
std::string pitch_text(const Grid& grid);

/// A pitch [mm] as options write it: "0.5" of square pixels, else "0.5,0.25", x first; reads back equal.
std::string pitch_option_text(const Point& pitch);

}  // namespace dwell
