#pragma once

#include <string>

#include "core/formats/profile_text.h"
#include "core/profile/line_profile.h"
#include "core/profile/profile_form.h"
#include "runs/base/input_file.h"
#include "runs/drawing/figure_format.h"

namespace dwell {

/// A line profile with and without the form of its mirror.
struct ProfileReport {
  InputFile input;
  ProfileText source;  // without places and values
  LineProfile measured;
  ProfileForm form;
  ProfileRest rest;
  ProfileFigures before, after;
  ProfileSpacing spacing;
};

/// Reads a file of a line profile (core/formats/profile_text.h) and takes the form out. Throws InputError.
ProfileReport read_profile(const std::string& file, const ProfileReadOptions& options, const ProfileForm& form);

/// Lines of text, each "name      value unit".
std::string profile_text(const ProfileReport& report);

/// The report as JSON text (docs/json.md), units in the keys.
std::string profile_json(const ProfileReport& report);

/// The rest as text that read_profile reads back.
std::string profile_rest_csv(const ProfileReport& report);

/// Slope and height of the rest against place, as a figure.
std::string profile_rest_picture(const ProfileReport& report, FigureFormat format = FigureFormat::Png);

}  // namespace dwell
