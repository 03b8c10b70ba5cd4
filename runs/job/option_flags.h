#pragma once

#include <string>

#include "core/base/errors.h"

namespace dwell {

/// The flag of an option that messages know by its plain name: "map pixel" is --map-pixel.
std::string flag_of(const std::string& plain_name);

/// The error as the user of the command line knows its options (core/base/errors.h).
InputError with_flags(const InputError& error);

}  // namespace dwell
