#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "runs/programs/pvt_place.h"

namespace dwell {

/// The bytes of a file that lies beside the list. Throws InputError if it cannot be read.
using ReadBeside = std::function<std::string(const std::string& name)>;

/// The bytes of a file that a list at `at` names beside itself. Throws InputError for a name that leads elsewhere, and
/// for a file that has another SHA-256 than the list states.
std::string listed_bytes(const PvtPlace& at, std::string_view name, std::string_view sha256, const ReadBeside& beside);

}  // namespace dwell
