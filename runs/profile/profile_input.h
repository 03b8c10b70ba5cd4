#pragma once

#include <string>

#include "core/formats/profile_text.h"
#include "core/profile/line_profile.h"
#include "core/profile/profile_form.h"
#include "runs/base/input_file.h"

namespace dwell {

/// A line profile from its file, with and without the form of its mirror.
struct ProfileInput {
  InputFile input;
  ProfileText source;  // without places and values
  LineProfile measured;
  ProfileForm form;
  ProfileRest rest;
  ProfileFigures before, after;
  ProfileSpacing spacing;
};

/// Reads a file of a line profile (core/formats/profile_text.h) and takes the form out. Throws InputError.
ProfileInput read_profile(const std::string& file, const ProfileReadOptions& options, const ProfileForm& form);

}  // namespace dwell
