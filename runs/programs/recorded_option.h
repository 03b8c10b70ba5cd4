#pragma once

#include <string_view>

namespace dwell {

/// Whether a program's header states the option of this job-file key: those that change its removal, or the map that
/// the removal is subtracted from. The files themselves are stated as inputs.
bool is_recorded_option(std::string_view key);

/// Whether a comment is what our own programs say of their inputs ("input: tif spot.csv sha256=...") or options
/// ("option: map_unit = um"; "option+: ..." goes on with a long one): the units in it are not those of the program.
bool is_record(std::string_view comment);

}  // namespace dwell
