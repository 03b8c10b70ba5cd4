#pragma once

#include <string>

#include "runs/drawing/figure_format.h"
#include "runs/profile/profile_input.h"

namespace dwell {

/// Lines of text, each "name      value unit".
std::string profile_text(const ProfileInput& profile);

/// The same as JSON text (docs/json.md), units in the keys.
std::string profile_json(const ProfileInput& profile);

/// The rest as text that read_profile reads back.
std::string profile_rest_csv(const ProfileInput& profile);

/// Slope and height of the rest against place, as a figure.
std::string profile_rest_picture(const ProfileInput& profile, FigureFormat format = FigureFormat::Png);

}  // namespace dwell
